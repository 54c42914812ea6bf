# A footing that acts from the second stage on has the loads of one that is put on the state of
# another run, and no load before; its curve begins at zero displacement. A run that is killed in
# the first or the second stage goes on with the same bits.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
scene=$root/tests/stages/footing.prm

"$program" "$scene" --quiet --output both --set 'Checkpoint/Every steps = 1' \
  --set 'Checkpoint/Keep = 100'
"$program" "$scene" --quiet --output first --set 'Checkpoint/Every steps = 1' \
  --set 'Loading/Stages = surcharge' --set 'Boundary conditions/footing/Active in =' \
  --set 'Boundary conditions/Names = bottom, sides' --set 'Observation/Conditions = bottom'
"$program" "$scene" --quiet --output second --set 'Initial stress/Run = first' \
  --set 'Loading/Stages = push' --set 'Tractions/surcharge/Traction y = -3000'
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) n[$i] = i; next }
         { print $n["displacement (m)"], $n["load (N/m)"] }' both/statistics.csv > both.txt
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) n[$i] = i; next }
         { print $n["displacement (m)"], $n["load (N/m)"] }' second/statistics.csv > second.txt
head -2 both.txt | awk '$2 != 0 { print "a load before the footing acts:", $0; exit 1 }'
tail -n +3 both.txt | paste - second.txt | awk '
  function off(a, b) { return a > b ? a - b : b - a }
  NF != 4 || off($1, $3) > 1e-12 || off($2, $4) > 1e-6 * $4 { print "other than alone:", $0; bad = 1 }
  END { exit bad || NR != 5 }'

cp both/statistics.csv whole.csv
for step in 1 3; do
  cp -r both resumed
  for file in $(ls -v resumed/checkpoint-*.h5 | tail -n +$((step + 1))); do rm "$file"; done
  "$program" --resume resumed --quiet
  cmp whole.csv resumed/statistics.csv
  rm -rf resumed
done
