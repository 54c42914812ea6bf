# Runs in which stages remove, add and change material go on with the same bits from a
# checkpoint within a stage, while forces fade, and from one at the end of a stage; so do
# undrained soil, loads that are raised, and loaded sides of explicit runs.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

without_times() {  # TABLE
  awk -F, 'NR == 1 {for (i = 1; i <= NF; ++i) if ($i ~ /CPU time/) t = i} {if (t) $t = ""; print}' "$1"
}

resumed() {  # NAME FILE SETTINGS...
  name=$1 file=$2 && shift 2
  arguments=()
  for setting; do arguments+=(--set "$setting"); done
  "$program" "$root/prm/stages/$file" --quiet --output "$name" --set 'Checkpoint/Every steps = 1' \
    --set 'Output/Pictures = false' --set 'Output/Fields = false' "${arguments[@]}"
  rm "$(ls -v "$name"/checkpoint-*.h5 | tail -1)"
  cp "$name/statistics.csv" "$name.csv"
  "$program" --resume "$name" --quiet
  grep -q "resumed at t" "$name/log.txt"
  cmp <(without_times "$name.csv") <(without_times "$name/statistics.csv")
}

resumed dug_within excavated_column.prm
resumed dug_before excavated_column.prm 'Loading/dig/Step size = 1'
resumed built_within built_column.prm
resumed built_before built_column.prm 'Loading/build 4/Step size = 1'
resumed changed_within improved_column.prm
resumed changed_before improved_column.prm 'Loading/Stages = weight, grout' \
  'Output/Expectations =' 'Exact solution/Displacement y = 1'
resumed points_dug_within excavated_column_mpm.prm
resumed points_dug_before excavated_column_mpm.prm 'Loading/dig/Step size = 1e6'
resumed points_built_within built_column_mpm.prm
resumed points_built_before built_column_mpm.prm 'Loading/build 4/Step size = 1e6'
# Excess pore pressures, the way of loads that are raised, and sides that move and absorb.
resumed undrained ../undrained/biaxial.prm
resumed raised ../raised/softening_square.prm
resumed sides ../../tests/explicit/traction_wave-01.prm 'Loading/shake/Duration = 0.2' \
  'Output/Report for tests = none' 'Output/Expectations ='
# A grid that follows a side.
resumed following ../../tests/mpm/following_grid-01.prm 'Output/Report for tests = none' \
  'Output/Expectations ='
