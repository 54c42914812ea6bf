# A run that starts with a stress outside of the strength says so, once, and goes on.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/footing_coarse.prm" \
    --set 'Output/Report for tests = none' --set 'Initial stress/Type = given' \
    --set 'Loading/push/Duration = 0.02' "$@" >log 2>&1
}
# c = 2 kPa, phi = 25: a shear stress of 10 kPa is too much at 10 kPa of pressure.
stress() {
  run --set "Initial stress/Stress xx = $1" --set "Initial stress/Stress yy = $2" \
    --output "run$1$2"
}
stress -1000 -30000
[ "$(grep -c 'initial stress of .* points is outside of the strength' log)" = 1 ]
grep -q "material 'soil'" log
stress -10000 -10000
! grep -q 'outside of the strength' log
