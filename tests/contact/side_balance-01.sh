# Forces on a body in the notch between a side and an oblique obstacle balance its momentum in each step to
# rounding, and that on a free obstacle its own: the part of the obstacle's force that goes into the side is
# counted once.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # NAME TEST OPTION ...
{
  local name=$1 test=$2
  shift 2
  "$program" "$root/tests/$test.prm" --quiet --output "$name" --set 'Output/Expectations =' \
    --set 'Output/Report for tests = none' "$@"
}
both=(--set 'Observation/Conditions = wall, plane')
run fem contact/notch-01 "${both[@]}"
run mpm contact/notch-MPM-01 "${both[@]}"
stages=(--set 'Loading/fall/Duration = 0.1' --set 'Loading/fall/Step size = 0.0002'
        --set 'Explicit/Time step = 0.0002' --set 'Loading/fall/Damping = 0')
run explicit explicit/obstacle_notch-01 "${stages[@]}"
run free explicit/obstacle_notch-01 "${stages[@]}" --set 'Obstacles/plane/Velocity x = free' \
  --set 'Obstacles/plane/Mass = 100' --set 'Obstacles/plane/Force x = -3000'
/usr/bin/python3 - <<'PYTHON'
import csv

def rows(name):
    return [{k: float(v) for k, v in row.items() if v}
            for row in csv.DictReader(open(f"{name}/statistics.csv"))]

def force(row, part, axis):
    return next(v for k, v in row.items() if k in
                (f"reaction {part} {axis} (N/m)", f"force {part} {axis} (N/m)"))

def report(name, error, largest):
    print(f"{name}: out of balance by {error:.3g} N/m")
    assert error <= largest, name

weight = 2000*9.81/8
report("finite elements", max(
    max(abs(force(r, "wall", "x") + force(r, "plane", "x")),
        abs(force(r, "plane", "y") - weight*r["time (s)"])) for r in rows("fem")), weight*1e-10)
last = rows("mpm")[-1]
report("implicit MPM at rest", abs(force(last, "wall", "x") + force(last, "plane", "x")), 1e-2)
for name in "explicit", "free":
    dt, worst, before = 0.0002, 0., None
    for r in rows(name):
        if before:
            for axis, load in ("x", 0.), ("y", -weight):
                change = (r[f"momentum {axis} (N s/m)"] - before[f"momentum {axis} (N s/m)"])/dt
                worst = max(worst, abs(change - load - force(r, "plane", axis)
                                       - (force(r, "wall", axis) if axis == "x" else 0.)))
        before = r
    report(name, worst, 1e-5)
moved = [r["displacement plane x (m)"] for r in rows("free")]
speeds = [(b - a)/dt for a, b in zip(moved, moved[1:])]
report("free obstacle", max(
    abs(100*(b - a)/dt + 3000 + force(r, "plane", "x"))
    for a, b, r in zip(speeds, speeds[1:], rows("free")[2:])), 1e-3)
assert max(force(r, "plane", "y") for r in rows("free")) > 1000.
PYTHON
