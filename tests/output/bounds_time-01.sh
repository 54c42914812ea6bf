# What has no effect without time, stages and the forces of structures is said: a
# surcharge that grows from zero and an excavation in bounds, tied sides in bounds, and
# structures whose forces a run that begins from another one would not know.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cat >block.prm <<EOF
include $root/tests/common.prm
subsection Analysis
  set Kind = strength reduction
end
subsection Geometry
  set Box = 0, 0; 1, 4
end
subsection Mesh
  set Type      = unstructured
  set Cell size = 1
end
subsection Materials
  subsection soil
    set Type          = Tresca
    set Cohesion      = 60e3
    set Unit weight   = 20e3
    set Young modulus = 1e7
    set Poisson ratio = 0.3
  end
end
subsection Gravity
  set Acceleration = 0, -10
end
subsection Boundary conditions
  set Names = bottom
  subsection bottom
    set Sides      = bottom
    set Velocity x = 0
    set Velocity y = 0
  end
end
subsection Tractions
  set Names = surcharge
  subsection surcharge
    set Sides      = top
    set Traction y = -1e3
  end
end
EOF
run() { "$program" block.prm --quiet --output a --force "$@" 2>err; }
run
fails grep -q 'at t = 0\|have no stages' err
run --set 'Tractions/surcharge/Traction y = -1e3*min(1, t)'
grep -q "the traction 'surcharge' depends on time" err
run --set 'Loading/push/Removed polygon = 0, 2; 1, 2; 1, 4; 0, 4'
grep -q "bounds have no stages: 'Loading/push/Removed polygon' has no effect" err
fails run --set 'Discretisation/Tied sides = left: right'
grep -q "its sides would be free in bounds" err

cat >strut.prm <<EOF
include block.prm
subsection Analysis
  set Kind = steps
end
subsection Structures
  set Names = strut
  subsection strut
    set Type            = strut
    set Points          = 1, 3; 2, 3
    set Axial stiffness = 1e7
    set Pre-stress      = -1e3
  end
end
subsection Loading
  subsection push
    set Duration  = 1
    set Step size = 1
  end
end
subsection Checkpoint
  set Every steps = 1
end
EOF
"$program" strut.prm --quiet --output first
fails "$program" strut.prm --quiet --output second --set 'Initial stress/Run = first' 2>err
grep -q "a run without the structure 'strut'" err
[ ! -e second ]
