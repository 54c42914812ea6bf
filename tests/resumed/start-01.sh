# A run begins with the points of another one: the strength of slopes whose weight was put
# on before is divided to the factor of one run that does both. What has no checkpoint, and
# another mesh, are refused.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

run() {  # FOLDER FILE SETTINGS...
  name=$1 file=$2 && shift 2
  arguments=()
  for setting; do arguments+=(--set "$setting"); done
  "$program" "$root/$file" --quiet --output "$name" --set 'Output/Pictures = false' \
    --set 'Output/Fields = false' --set 'Output/Report for tests = none' "${arguments[@]}"
}

for kind in fem mpm; do
  if [ $kind = fem ]; then
    file=tests/fem/safety_steps-01.prm before=weight
  else
    file=prm/safety/slope_mpm.prm before='weight, rest'
  fi
  run $kind $file 'Output/Expectations ='
  run $kind-before $file "Loading/Stages = $before" 'Checkpoint/Every steps = 1' \
    'Reference/Quantity =' 'Output/Expectations ='
  factor=$(/usr/bin/python3 -c "import json; print(json.load(open('$kind/summary.json'))['safety']['factor'])")
  run $kind-reduced $file 'Loading/Stages = reduce' "Initial stress/Run = $kind-before" \
    'Gravity/Ramp duration = 0' "Output/Expectations = safety/factor = $factor +- 0.001"
done

refused() {  # TEXT SETTINGS...
  text=$1 && shift
  if run refused "$file" "$@" 2>message; then exit 1; fi
  grep -q "$text" message || { cat message; exit 1; }
}
refused "parameter 'Initial stress/Run' = 'nowhere'" 'Initial stress/Run = nowhere'
refused 'the checkpoint has' 'Initial stress/Run = mpm-before' 'Mesh/Cell size = 0.5'
refused "a run with 'Analysis/Units' = kN-m" 'Initial stress/Run = mpm-before' \
  'Analysis/Units = kN-m'
