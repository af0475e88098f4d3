# n of silver (Ag-McPeak) up by 1 %
# file: materials/tables/Ag-McPeak.csv
BEGIN { FS = OFS = "," }
/^[0-9]/ { $2 = sprintf("%.9g", $2 * 1.01) }
{ print }
