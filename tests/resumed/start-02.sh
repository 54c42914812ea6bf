# What points keep of the run from which they start: the modulus of each place is that of
# the new scene with finite elements, and particles, which keep their mass, are refused
# where its density is another one.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() { # FOLDER, OPTIONS
  "$program" "$root/tests/stages/changed_mass-01.prm" --quiet --output "$1" \
    --set 'Output/Report for tests = none' --set 'Output/Expectations =' \
    --set 'Loading/Stages = weight' --set 'Materials/Names = soil' --set 'Checkpoint/Every steps = 1' \
    --set 'Observation/Points = 0.5, 1' "${@:2}" 2>err
}
fem=(--set 'Discretisation/Method = FEM' --set 'Discretisation/Element = Q2' --set 'Mesh/Box =')
run first "${fem[@]}" --set 'Materials/soil/Young modulus formula = 1e6 + 0*y'
more=(--set 'Initial stress/Run = first' --set 'Gravity/Acceleration = 0, -20')
run place "${fem[@]}" "${more[@]}" --set 'Materials/soil/Young modulus formula = 1e5 + 0*y'
/usr/bin/python3 - <<'END'
import json
place = json.load(open("place/summary.json"))["points"]["displacement_1_y_m"]
assert abs(place + 0.1) < 1e-6, place  # 10 m/s^2 more: -rho g H^2/(2 E)
END
run particles --set 'Materials/soil/Young modulus = 1e7'
fails run denser --set 'Materials/soil/Young modulus = 1e7' \
  --set 'Initial stress/Run = particles' --set 'Materials/soil/Density = 3000'
grep -q "parameter 'Materials/soil/Density' = '3000'" err
grep -q "allowed: 2000, as in 'Initial stress/Run' = particles" err
