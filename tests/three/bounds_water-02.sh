# A cut under open water has the factor of safety of the same cut with the buoyant weight.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run()
{
  "$program" "$root/tests/three/bounds_solver.prm" --quiet --output "$1" \
    --set 'Analysis/Kind = strength reduction' --set "Materials/clay/Density = $2" \
    --set "Water/Table = $3" "${@:4}"
}
run dry 100 ''
run submerged 1081 '0, 3' # 9810 N/m^3 over g = 10 m/s^2
# The water as the flow between equal levels: at rest.
run flow 1081 '' --set 'Materials/clay/Permeability = 1e-9' --set 'Seepage/Names = lake' \
  --set 'Seepage/lake/Sides = left, top' --set 'Seepage/lake/Level = 3' --set 'Seepage/Cells = 20'
# ... and its pressures from a file.
printf '%s\n' x,y,u -1,-2,49050 -1,1,19620 2,-2,49050 2,1,19620 >pressures.csv
run file 1081 '' --set "Water/File = $PWD/pressures.csv"
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from geocone.reader import Run

for bound in "lower", "upper":
    dry, submerged, *others = (Run(name).value(f"safety/{bound}")
                               for name in ("dry", "submerged", "flow", "file"))
    assert abs(dry / submerged - 1.) < 1e-4, (bound, dry, submerged)
    for other in others:
        assert abs(other / submerged - 1.) < 1e-6, (bound, other, submerged)
PYTHON
