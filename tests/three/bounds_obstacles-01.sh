# Obstacles that are stronger than the soil in all respects hold it as sides with prescribed
# velocities do, between which the soil fails beside them; bounds are the same.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cat >held.prm <<PRM
include $root/tests/common.prm
include $root/tests/three/bounds_block_scene.prm
subsection Analysis
  set Solver tolerance = 1e-7
end
subsection Boundary conditions
  set Names = bottom, back, top
  subsection bottom
    set Velocity x = 0
    set Velocity z = 0
  end
  subsection top
    set Velocity x = 0
    set Velocity z = 0
  end
end
PRM
cat >touched.prm <<PRM
include held.prm
subsection Boundary conditions
  set Names = back
end
subsection Obstacles
  set Names = bottom, top
  subsection bottom
    set Shape                = half-space
    set Point                = 0, 0, 0
    set Normal               = 0, 1, 0
    set Friction coefficient = 0.7
    set Adhesion             = 5000
    set Tensile strength     = 7000
  end
  subsection top
    set Shape                = polyhedron
    set Vertices             = 0, 1, 0; 1, 1, 0; 1, 1, 1; 0, 1, 1; 0, 2, 0; 1, 2, 0; 1, 2, 1; 0, 2, 1
    set Friction coefficient = 0.7
    set Adhesion             = 5000
    set Tensile strength     = 7000
    set Velocity y           = -1
  end
end
PRM
run() {
  local name=$1
  shift
  for scene in held touched; do
    "$program" $scene.prm --quiet --output "$name-$scene" "$@"
  done
}
run friction --set 'Materials/soil/Type = Mohr-Coulomb' --set 'Analysis/Stresses = quadratic' \
  --set 'Materials/soil/Friction angle = 25' --set 'Materials/soil/Dilatancy angle = 25'
run clay --set 'Analysis/Velocities = linear'
/usr/bin/python3 -B - <<'PYTHON'
import json

for name in "friction", "clay":
    held, touched = (json.load(open(f"{name}-{scene}/summary.json"))["bounds"]
                     for scene in ("held", "touched"))
    print(name, held["lower"], touched["lower"], held["upper"], touched["upper"])
    assert 0. < held["lower"] < 0.99 * held["upper"], name
    for side in "lower", "upper":
        assert abs(touched[side] - held[side]) < 1e-5 * held[side], (name, side)
PYTHON
