# A traction on a side whose velocity along it is prescribed only changes a reaction, and
# the run says so: a pressure on a wall that holds its normal velocity, and a shear on a
# base; not the same on sides that are free that way.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cat >block.prm <<EOF
include $root/tests/common.prm
subsection Geometry
  set Shape   = polygon
  set Polygon = 0, 0; 2, 0; 2, 1; 0.5, 1
end
subsection Mesh
  set Type      = unstructured
  set Cell size = 0.5
end
subsection Materials
  subsection soil
    set Type          = linear elastic
    set Young modulus = 1e6
    set Poisson ratio = 0.25
  end
end
subsection Boundary conditions
  set Names = bottom, wall
  subsection bottom
    set Sides      = 0
    set Velocity x = 0
    set Velocity y = 0
  end
  subsection wall
    set Sides           = 3
    set Velocity normal = 0
  end
end
subsection Tractions
  set Names = press
end
subsection Loading
  set Stages = press
  subsection press
    set Duration  = 1
    set Step size = 1
  end
end
EOF
run() { # SIDE, KIND
  "$program" block.prm --quiet --output run --force --set "Tractions/press/Sides = $1" \
    --set "Tractions/press/Traction $2 = -100*t" 2>err
}
said="the traction 'press' acts for 100 % along velocities that"
run 3 normal
grep -q "$said 'wall' prescribes" err
run 0 tangential
grep -q "$said 'bottom' prescribes" err
for free in '2 normal' '1 normal' '3 tangential'; do
  run $free
  fails grep -q "the traction 'press'" err
done
