# The size of the body and its strength over its weight are told, and asked where no soil
# has such ones: mostly another unit is meant.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
scene=$root/tests/footing_coarse.prm
gravity=(--set 'Observation/Reference = none' --set 'Gravity/Acceleration = 0, -9.81')
"$program" "$scene" --dry-run "${gravity[@]}" >out 2>err
# c/(gamma H) = 2000/(2000 x 9.81 x 2)
grep -q 'body 1 x 2 m; soil: c = 2000 Pa, phi = 25, c/(gamma H) = 0.051$' out
fails grep -q 'weighs' err
asks() { # WORDS, OPTIONS
  "$program" "$scene" --quiet --dry-run "${@:2}" 2>err
  grep -q "warning: $1" err
}
millimetres=(--set 'Geometry/Box = 0, -20000; 10000, 0' --set 'Mesh/Cell size = 1000'
  --set 'Boundary conditions/footing/Box = 0, -1000; 1000, 1000')
asks 'the body is 20000 m large' "${gravity[@]}" "${millimetres[@]}"
asks "the density of 'soil' is 2 kg/m" "${gravity[@]}" --set 'Materials/soil/Density = 2'
asks "the cohesion of 'soil' is 0.1 Pa" "${gravity[@]}" --set 'Materials/soil/Cohesion = 0.1' \
  --set 'Materials/soil/Friction angle = 0' --set 'Materials/soil/Dilatancy angle = 0'
asks "Young's modulus of 'soil', 100 Pa, is smaller" --set 'Materials/soil/Young modulus = 100'
asks "the anisotropy angle of 'soil' is not used" \
  --set 'Materials/soil/Anisotropy angle = 30'
asks 'gravity grows to 0.5 of its value by the end of the loading, 0.2 s' "${gravity[@]}" \
  --set 'Gravity/Ramp duration = 0.4'
# A table at a height of 4.5 m above the invert of a tunnel.
scene=$root/prm/safety/tunnel.prm
table=(--set 'Water/Table = 0, -5.5')
asks "'hole 0' is filled with water, with up to 4.41[45]e+04 Pa on its sides" "${table[@]}"
fails asks "'hole 0' is filled" "${table[@]}" --set 'Tractions/Names = water' \
  --set 'Tractions/water/Sides = hole 0' --set 'Tractions/water/Traction normal = -9810*(y + 5.5)'
fails asks "'hole 0' is filled" --set 'Water/Table = 0, -10.1'
scene=$root/tests/footing_coarse.prm
# Without weight lengths have no unit.
"$program" "$scene" --quiet --dry-run "${millimetres[@]}" 2>err
fails grep -q 'large' err
