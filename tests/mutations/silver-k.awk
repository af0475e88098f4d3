# k of silver (Ag-McPeak) up by 1 %
# file: materials/tables/Ag-McPeak.csv
BEGIN { FS = OFS = "," }
/^[0-9]/ { $3 = sprintf("%.9g", $3 * 1.01) }
{ print }
