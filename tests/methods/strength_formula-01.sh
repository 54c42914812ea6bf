# A cohesion that is a formula in the coordinates is the gradient that it describes, by each
# method, in the plane and by laws of all principal stresses; a formula that is not positive
# somewhere or depends on time is refused.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
block() {
  "$program" "$root/tests/fem/growing_block-01.prm" --quiet --output "$1" \
    --set 'Output/Report for tests = none' --set 'Output/Expectations =' \
    --set 'Loading/squeeze/Duration = 2' --set 'Mesh/Box = -0.5, -0.25; 1.5, 1.25' \
    --set 'Particles/Layout = Gauss' "${@:2}"
}
for method in FEM MPM 'explicit MPM'; do
  for law in 'spatial Tresca' Tresca; do
    call=(--set "Discretisation/Method = $method" --set "Materials/clay/Type = $law")
    [ "$method" != FEM ] || call+=(--set 'Mesh/Box =')
    block gradient "${call[@]}" --set 'Output/If folder exists = overwrite'
    block formula "${call[@]}" --set 'Output/If folder exists = overwrite' \
      --set 'Materials/clay/Cohesion gradient = 0' \
      --set 'Materials/clay/Cohesion formula = 1000 + 1000 * (1 - y)'
    # But for the time that was taken.
    cmp <(cut -d, -f4 --complement gradient/statistics.csv) \
      <(cut -d, -f4 --complement formula/statistics.csv)
    [ "$(wc -l <formula/statistics.csv)" -gt 2 ]
  done
done
formula() {
  fails "$program" "$root/tests/fem/growing_block-01.prm" --dry-run --output none \
    --set 'Materials/clay/Cohesion gradient = 0' \
    --set "Materials/clay/Cohesion formula = $1" "${@:2}" 2>said
}
formula '1000 - 2000 * y'
grep -q 'a cohesion > 0 Pa everywhere; here it is' said
formula '1000 * t'
grep -q "Cohesion formula" said
