# Holes of a polygon: the pressure in a circular opening widens it as Lame's solution says, with
# second order in the number of its chords, where the outline is clockwise and a border of
# materials passes through the opening; material points fill the body without the opening, and
# move as far.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # NAME OPTION ...
{
  local name=$1
  shift
  local options=()
  for option in "$@"; do options+=(--set "$option"); done
  "$program" "$root/tests/meshes/opening.prm" --quiet --output "$name" "${options[@]}" || exit 1
}
run fem-24 'Geometry/Holes = circle(0, 0, 1, 24)'
run fem-48
run clockwise 'Geometry/Holes = 0.5, 0; 0.2, -0.5; -0.2, -0.5; -0.5, 0; 0, 0.5 | circle(2, 1.5, 0.3, 3)' \
  'Tractions/pressure/Sides = 4, 5, 6, 7, 8' 'Observation/Points = 0.5, 0; 0, 0.5; -0.5, 0' \
  'Boundary conditions/outside/Velocity x = 0' 'Boundary conditions/outside/Velocity y = 0'
run mpm 'Discretisation/Method = MPM' 'Discretisation/Element = Q2' 'Mesh/Type = uniform' \
  'Mesh/Cell size = 0.25' 'Boundary conditions/outside/Sides = bottom, right, top, left' \
  'Discretisation/Basis = automatic'
/usr/bin/python3 - <<'END'
import csv
import json
import math


def moved(run, point):
    row = list(csv.DictReader(open(run + "/statistics.csv")))[-1]
    return [float(row[f"displacement of point {point} {c} (m)"]) for c in "xy"]


def error(run, point, x, y):
    """Of the radial displacement, 1e-3/r, relative."""
    u, r = moved(run, point), math.hypot(x, y)
    return (u[0] * x + u[1] * y) / r / (1e-3 / r) - 1


coarse, fine = (error(run, 1, 1, 0) for run in ("fem-24", "fem-48"))
print("errors at the wall:", coarse, fine, "order", math.log2(coarse / fine))
assert abs(fine) < 5e-3 and math.log2(coarse / fine) > 1.8
assert abs(error("fem-48", 4, -1.5, 1.5)) < 2e-3
# The pressure in a clockwise hole pushes its walls away, too.
walls = moved("clockwise", 1)[0], moved("clockwise", 2)[1], -moved("clockwise", 3)[0]
print("walls:", walls)
assert min(walls) > 0
print("particles:", error("mpm", 4, -1.5, 1.5))
assert abs(error("mpm", 4, -1.5, 1.5)) < 0.1
size = json.load(open("mpm/summary.json"))["size"]
area = 20 - 24 * math.sin(2 * math.pi / 48)
print("points:", size, "of", area / (0.25 / 2)**2)
assert abs(size["points"] * (0.25 / 2)**2 / area - 1) < 0.02
END
