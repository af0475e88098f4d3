# n of copper (Cu-McPeak) up by 1 %
# file: materials/tables/Cu-McPeak.csv
BEGIN { FS = OFS = "," }
/^[0-9]/ { $2 = sprintf("%.9g", $2 * 1.01) }
{ print }
