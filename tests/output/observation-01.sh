# Moments of reactions and displacements of points against hand calculations: a tilting
# footing by FEM and MPM, on nodes and by segments, and an elastic column that settles
# under its weight by the explicit method, the moment about a point beside it. On 1 and 2
# ranks; the last values are in summary.json. Places outside of the body are refused.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # FILE NAME RANKS OPTION ...
{
  local file=$1 name=$2 ranks=$3 launcher=()
  shift 3
  [ "$ranks" = 1 ] || launcher=(mpirun -np "$ranks")
  local options=()
  for option in "$@"; do options+=(--set "$option"); done
  "${launcher[@]}" "$program" "$file" --quiet --output "$name" "${options[@]}"
}
mpm=('Discretisation/Method = MPM' 'Discretisation/Element = B-spline 2'
  'Particles/Layout = sub-cells' 'Boundary conditions/pin/Box = 0, 0; 0.01, 0')
segments=('Boundary conditions/footing/Imposed on = segments'
  'Boundary conditions/footing/Segments = 8')
cat >column.prm <<PRM
include $root/tests/common.prm
subsection Discretisation
  set Method  = explicit MPM
  set Element = B-spline 2
end
subsection Geometry
  set Box = 0, 0; 1, 1
end
subsection Mesh
  set Type      = uniform
  set Cell size = 0.25
  set Box       = 0, 0; 1, 1.5
end
subsection Particles
  set Layout = sub-cells
end
subsection Materials
  set Names = soil
  subsection soil
    set Type          = linear elastic
    set Density       = 2000
    set Young modulus = 1e7
    set Poisson ratio = 0
  end
end
subsection Gravity
  set Acceleration  = 0, -10
  set Ramp duration = 0.1
end
subsection Boundary conditions
  set Names = bottom, sides
  subsection bottom
    set Sides      = bottom
    set Velocity y = 0
  end
  subsection sides
    set Sides      = left, right
    set Velocity x = 0
  end
end
subsection Loading
  set Stages = settle
  subsection settle
    set Duration  = 0.4
    set Step size = 0.2
    set Damping   = 0.5
  end
end
subsection Observation
  set Conditions    = bottom
  set Moment centre = -1, 0
  set Points        = 0.4375, 0.9375; 0.1, 0.1
end
PRM
for ranks in 1 2; do
  run "$root/tests/output/tilt.prm" FEM-$ranks $ranks
  run "$root/tests/output/tilt.prm" nodes-$ranks $ranks "${mpm[@]}"
  run "$root/tests/output/tilt.prm" segments-$ranks $ranks "${mpm[@]}" "${segments[@]}"
  run column.prm explicit-$ranks $ranks
  run column.prm general-$ranks $ranks 'Explicit/Fast path = false'
done
for method in FEM MPM; do
  if run "$root/tests/output/tilt.prm" outside-$method 1 \
    'Observation/Points = 1, 0.5; 2, 1.2' \
    "Discretisation/Method = $method" 'Particles/Layout = sub-cells' \
    'Discretisation/Element = automatic' 2>error; then exit 1; fi
  grep -q "parameter 'Observation/Points' = '2, 1.2'" error
  [ ! -e outside-$method ]
done
if run column.prm outside-explicit 1 'Observation/Points = 0.5, 1.3' 2>error; then exit 1; fi
grep -q "parameter 'Observation/Points' = '0.5, 1.3'" error
/usr/bin/python3 - <<'PYTHON'
import csv, json
failed = False
def check(what, value, exact, tolerance):
    global failed
    if not abs(value - exact) <= tolerance:
        failed = True
        print(what, value, "is not", exact, "within", tolerance)
def last(run):
    return {key: float(value) for key, value in
            list(csv.DictReader(open(f"{run}/statistics.csv")))[-1].items()}
for ranks in 1, 2:
    # FEM is exact; particles have moved by 1e-3 of the size of the block, and the ends of
    # the sides bend with them.
    for run, part in ("FEM", 1e-10), ("nodes", 4e-3), ("segments", 3e-2):
        name = f"{run}-{ranks}"
        row, points = last(name), json.load(open(f"{name}/summary.json"))["points"]
        check(name + " force", row["reaction footing y (N/m)"], -2000, 2000 * part)
        check(name + " moment", row["moment footing (N m/m)"], -2000 / 3, 2000 * part)
        check(name + " answer", row["moment ground (N m/m)"], 2000 / 3, 2000 * part)
        places = [(1.9375, 0.5625), (2, 1) if run == "FEM" else (1.9375, 0.9375)]
        for i, (x, y) in enumerate(places):
            for d, exact in ("x", 5e-4 * y * y), ("y", -1e-3 * x * y):
                u = row[f"displacement of point {i + 1} {d} (m)"]
                check(f"{name} u_{d} of point {i + 1}", u, exact, 2e-3 * part)
                check(name + " summary", points[f"displacement_{i + 1}_{d}_m"], u, 1e-12)
    for run in "explicit", "general":
        name = f"{run}-{ranks}"
        row = last(name)
        # 2000 kg/m at x = 0.5 m, 1.5 m beside the point that the moment is about.
        check(name + " force", row["force bottom y (N/m)"], 2e4, 2e4 * 2e-3)
        check(name + " moment", row["moment bottom (N m/m)"],
              1.5 * row["force bottom y (N/m)"], 1e-6 * 2e4)
        # u_y = -rho g (H y - y^2/2)/E; the second place is nearest to (0.0625, 0.0625).
        for i, y in (1, 0.9375), (2, 0.0625):
            check(name + " settlement", row[f"displacement of point {i} y (m)"],
                  -2e-3 * (y - y * y / 2), 2e-5)
raise SystemExit(failed)
PYTHON
