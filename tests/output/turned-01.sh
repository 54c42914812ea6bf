# A block on two smooth sides and under a rigid smooth plate, all by normal velocities,
# turned by 30 degrees: forces, moments and displacements are those of the block that is
# not turned, whose sides are held along x and y; elastic to rounding, and
# where it flows, to the tolerance of the steps. A side whose normal is x gives the same as
# Velocity x. Two ranks give what one does. The same steps, frozen, are refused.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for angle in 0 30; do
  /usr/bin/python3 "$root/tests/output/ring.py" block-$angle.msh 6 $angle
done
cat >block.prm <<PRM
include $root/tests/common.prm
subsection Geometry
  set Shape = file
end
subsection Materials
  set Names = soil
  subsection soil
    set Type          = linear elastic
    set Density       = 500
    set Young modulus = 1e6
    set Poisson ratio = 0.3
  end
end
subsection Boundary conditions
  set Names = bottom, left, plate
  subsection bottom
    set Sides           = bottom
    set Velocity normal = 0
  end
  subsection left
    set Sides           = left
    set Velocity normal = 0
  end
  subsection plate
    set Sides           = top
    set Velocity normal = -4e-3
  end
end
subsection Tractions
  set Names = side
  subsection side
    set Sides               = right
    set Traction normal     = -2000
    set Traction tangential = 300
  end
end
subsection Loading
  set Stages = push
  subsection push
    set Duration  = 2
    set Step size = 0.5
  end
end
subsection Observation
  set Conditions    = bottom, left, plate
  set Moment centre = 0, 0
end
PRM
run() # NAME ANGLE RANKS OPTION ...
{
  local name=$1 angle=$2 ranks=$3 launcher=()
  shift 3
  [ "$ranks" = 1 ] || launcher=(mpirun -np "$ranks")
  local options=()
  for option in "$@"; do options+=(--set "$option"); done
  "${launcher[@]}" "$program" block.prm --quiet --output "$name" \
    --set "Geometry/File = $PWD/block-$angle.msh" "${options[@]}"
}
along_axes=('Boundary conditions/bottom/Velocity normal = free'
  'Boundary conditions/bottom/Velocity y = 0'
  'Boundary conditions/left/Velocity normal = free'
  'Boundary conditions/left/Velocity x = 0'
  'Boundary conditions/plate/Velocity normal = free'
  'Boundary conditions/plate/Velocity y = -4e-3'
  'Tractions/side/Traction normal = none' 'Tractions/side/Traction tangential = none'
  'Tractions/side/Traction x = -2000' 'Tractions/side/Traction y = 300')
weak=('Materials/soil/Type = Mohr-Coulomb' 'Materials/soil/Cohesion = 1000'
  'Materials/soil/Friction angle = 20' 'Materials/soil/Dilatancy angle = 5')
places=('Observation/Points = 1.2, 0.6; 2, 1'
  # cos and sin of 30 degrees
  'Observation/Points = 0.7392304845413265, 1.1196152422706632; 1.2320508075688774, 1.8660254037844386')
turned_g='Gravity/Acceleration = 5, -8.6602540378443864'
for soil in elastic weak inertia; do
  options=()
  [ $soil != weak ] || options=("${weak[@]}")
  [ $soil != inertia ] || options=('Time stepping/Inertia = true')
  run $soil-axes 0 1 "${along_axes[@]}" "${places[0]}" \
    'Gravity/Acceleration = 0, -10' "${options[@]}"
  run $soil-normal 0 1 "${places[0]}" 'Gravity/Acceleration = 0, -10' "${options[@]}"
  run $soil-turned 30 1 "${places[1]}" "$turned_g" "${options[@]}"
  run $soil-turned-2 30 2 "${places[1]}" "$turned_g" "${options[@]}"
done
if run frozen 30 1 'Output/Freeze steps = 1' 2>error; then exit 1; fi
grep -q "parameter 'Boundary conditions/bottom/Velocity normal'" error
[ ! -e frozen ]
/usr/bin/python3 - <<'PYTHON'
import csv, math
def lines(run):
    return [{key: float(value) for key, value in row.items()}
            for row in csv.DictReader(open(f"{run}/statistics.csv"))]
c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
failed = False
for soil, tolerance in ("elastic", 1e-11), ("inertia", 1e-11), ("weak", 1e-8):
    reference = lines(f"{soil}-axes")
    assert len(reference) == 4
    flows = reference[-1]["largest plastic strain (-)"]
    assert (flows > 1e-4) == (soil == "weak"), flows
    for run, turned in (("normal", False), ("turned", True), ("turned-2", True)):
        for old, new in zip(reference, lines(f"{soil}-{run}")):
            errors = {}
            force = max(abs(v) for k, v in old.items() if k.startswith("reaction"))
            length = max(abs(v) for k, v in old.items()
                         if k.startswith("displacement of"))
            for key in old:
                if key.startswith("moment"):
                    errors[key] = abs(new[key] - old[key]) / force
                if key.startswith(("reaction", "displacement of")) and " x " in key:
                    x, y = new[key], new[key.replace(" x ", " y ")]
                    if turned:
                        x, y = c * x + s * y, c * y - s * x
                    scale = force if key.startswith("reaction") else length
                    errors[key] = math.hypot(
                        x - old[key], y - old[key.replace(" x ", " y ")]) / scale
            worst = max(errors, key=errors.get)
            if not errors[worst] <= tolerance:
                failed = True
                print(soil, run, old["time (s)"], worst, errors[worst])
        print(soil, run, worst, "%.1e" % errors[worst])
raise SystemExit(failed)
PYTHON
