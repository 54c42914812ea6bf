# A quarter of a ring whose bore and symmetry planes share their corners. Lame's
# pressure comes out with second order in the size of the cells, whichever condition is
# the last one; the planes bear what the hoop stress exerts on them; a pressure that is
# given by Traction normal widens the bore by Lame's displacement, and a normal velocity
# of the bore needs Lame's pressure, with second order, too.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # NAME N OPTION ...
{
  local name=$1 n=$2
  shift 2
  /usr/bin/python3 "$root/tests/output/ring.py" ring.msh "$n"
  local options=()
  for option in "$@"; do options+=(--set "$option"); done
  "$program" "$root/tests/output/ring.prm" --quiet --output "$name-$n" \
    --set "Geometry/File = $PWD/ring.msh" "${options[@]}"
}
bore=('Boundary conditions/bore/Sides = bore' 'Observation/Conditions = bore')
radial=("${bore[@]}" 'Boundary conditions/bore/Velocity x = 1e-3*x'
  'Boundary conditions/bore/Velocity y = 1e-3*y')
for element in Q1 Q2; do
  # Errors of Q1 are a tenth of those of Q2, and of second order on finer meshes only.
  case $element in Q1) sizes=(32 64) ;; Q2) sizes=(8 16) ;; esac
  for n in "${sizes[@]}"; do
    degree="Discretisation/Element = $element"
    run "$element-last" $n "$degree" "${radial[@]}" \
      'Boundary conditions/Names = plane_x, plane_y, bore'
    run "$element-first" $n "$degree" "${radial[@]}" \
      'Boundary conditions/Names = bore, plane_x, plane_y'
    [ $element = Q2 ] || continue
    run "$element-normal" $n "$degree" "${bore[@]}" \
      'Boundary conditions/Names = plane_x, plane_y, bore' \
      'Boundary conditions/bore/Velocity normal = -1e-3'
    run "$element-pressure" $n "$degree" 'Tractions/Names = bore' \
      'Tractions/bore/Sides = bore' 'Tractions/bore/Traction normal = -1363.6363636' \
      'Observation/Points = 0.70710678118654757, 0.70710678118654746; 2, 0'
  done
done
/usr/bin/python3 - <<'PYTHON'
import csv, math
def value(run, n, column):
    return float(list(csv.DictReader(open(f"{run}-{n}/statistics.csv")))[-1][column])
failed = False
def check(run, column, exact, least_order, largest_error):
    """Errors on two meshes, relative, and their order."""
    global failed
    sizes = (32, 64) if run.startswith("Q1") else (8, 16)
    errors = [abs(value(run, n, column) / exact - 1) for n in sizes]
    order = math.log2(errors[0] / errors[1])
    good = order >= least_order and errors[1] <= largest_error
    failed = failed or not good
    print(f"{run} {column}: {errors[0]:.2e} {errors[1]:.2e} order {order:.2f}",
          "" if good else "FAILED")
p = 6e6 * 1e-3 / 4.4
# Radial displacement of the outside: 2 p a^2 b (1 - nu)/(2G (b^2 - a^2)).
outside = 2 * p * 2 * 0.7 / (2e6 * 3)
for run in "Q1-last", "Q1-first", "Q2-last", "Q2-first", "Q2-normal":
    check(run, "reaction bore x (N/m)", p, 1.8, 4e-3)
run = "Q2-pressure"
check(run, "displacement of point 1 x (m)", 1e-3 * math.sqrt(0.5), 1.8, 4e-3)
check(run, "displacement of point 1 y (m)", 1e-3 * math.sqrt(0.5), 1.8, 4e-3)
check(run, "displacement of point 2 x (m)", outside, 1.8, 4e-3)
# The chords of the bore span 1 m, whatever their number.
if abs(value(run, 8, "reaction plane_x x (N/m)") / -1363.6363636 - 1) > 1e-10:
    failed = True
    print("the plane does not bear the pressure")
raise SystemExit(failed)
PYTHON
