# A table of boreholes becomes a scene of layers, one of which thins out, and of water.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cat >table.csv <<'CSV'
borehole, x, top, soil
B2, 20, 4, clay
B2, 20, -2, sand
B2, 20, -8, end
B1, 0, 8, fill
B1, 0, 4, clay
B1, 0, 1, water
B1, 0, -3, sand
B1, 0, -10, end
B3, 40, 4, clay
B3, 40, 0, water
B3, 40, -2, sand
B3, 40, -8, end
CSV
export PYTHONPATH=$root/python
boreholes() {
  /usr/bin/python3 -B -m geocone boreholes "$@"
}
boreholes table.csv scene.prm
for line in 'Polygon = 0, -10; 40, -10; 40, 4; 20, 4; 0, 8' 'Names = fill, clay, sand' \
  'Region below = 0, 4; 20, 4; 40, 4' 'Region below = 0, -3; 20, -2; 40, -2' 'Table = 0, 1; 40, 0'; do
  grep -qF "$line" <(tr -s ' ' <scene.prm) || { cat scene.prm; exit 1; }
done
"$program" scene.prm --dry-run --picture --quiet --output model \
  --set 'Analysis/Kind = steps' --set 'Discretisation/Method = FEM' \
  --set 'Loading/Stages = weight' --set 'Loading/weight/Duration = 1'
grep -q '"sand"' model/model.json
# Below the end of a borehole its last soil goes on to the bottom.
sed '/B3, 40, -2, sand/d;s/B3, 40, -8, end/B3, 40, -5, end/' table.csv >short.csv
boreholes short.csv short.prm
for line in 'Region below = 0, 4; 20, 4; 40, 4' 'Region below = 0, -3; 20, -2; 40, -10'; do
  grep -qF "$line" <(tr -s ' ' <short.prm) || { cat short.prm; exit 1; }
done
# Refused, and nothing is written.
refused() { # TABLE WORDS
  if boreholes "$1" none.prm 2>said; then exit 1; fi
  grep -q "$2" said || { cat said; exit 1; }
  [ ! -e none.prm ]
}
grep -v 'B3.*end' table.csv >no_end.csv
refused no_end.csv "no soil above the row 'end'"
sed 's/^B3, 40, 4, clay/B3, 40, -4, clay/' table.csv >order.csv
refused order.csv 'different orders'
grep -v 'B[23]' table.csv >one.csv
refused one.csv 'two or more'
sed 's/, 8, fill/, eight, fill/' table.csv >word.csv
refused word.csv "line 5 of 'word.csv' has x = '0' and top = 'eight'"
sed 's/fill/"fill\nend"/' table.csv >name.csv
refused name.csv 'may not be called'
sed 's/, 8, fill/, 8,5, fill/' table.csv >comma.csv
refused comma.csv "line 5 of 'comma.csv' has 5 values"
grep -q 'decimal points' said
sed 's/, 8, fill/, fill/' table.csv >missing.csv
refused missing.csv "line 5 of 'missing.csv' has 3 values"
tr , ';' <table.csv >semicolons.csv
refused semicolons.csv 'separate values by commas'
sed 's/fill/Names/' table.csv >names.csv
refused names.csv "not 'Names'"
sed 's/fill/Clay/' table.csv >capitals.csv
refused capitals.csv "line 5 of 'capitals.csv': 'Clay' differs from 'clay' only in capitals"
sed 's/B3, 40, -8, end/B3, 40, -1, end/' table.csv >below.csv
refused below.csv "'B3' has a soil below the row 'end'"
# Rows without text are skipped; water may be below the depth that was reached; a soil that is
# met at this depth counts, before and after its row.
{ sed 's/B3, 40, 0, water/B3, 40, -9, water/' table.csv; echo; echo ' , ,,'; } >dry.csv
boreholes dry.csv dry.prm
grep -qF 'Table = 0, 1; 40, -9' dry.prm
for rows in 'B3, 40, -2, sand\nB3, 40, -2, end' 'B3, 40, -2, end\nB3, 40, -2, sand'; do
  { grep -v 'B3, 40, -' table.csv; printf "$rows\n"; } >met.csv
  rm -f met.prm
  boreholes met.csv met.prm
  grep -qF '0, -3; 20, -2; 40, -2' met.prm
done
# What cannot be written is an error in a line.
if boreholes table.csv nowhere/new.prm 2>said; then exit 1; fi
grep -q '^error: .*nowhere' said
[ "$(wc -l <said)" = 1 ]
