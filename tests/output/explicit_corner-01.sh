# Soil under a uniform stress of 1600 Pa at rest, whose base and wall both hold all
# components: in explicit steps each carries 1600 N/m along its normal and nothing along
# its side, whichever of them is the last condition, on the grid and on a mesh.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cat >block.prm <<EOF
include $root/tests/common.prm
subsection Geometry
  set Box = 0, 0; 1, 1
end
subsection Discretisation
  set Method = explicit MPM
end
subsection Mesh
  set Type      = uniform
  set Cell size = 0.125
end
subsection Materials
  subsection soil
    set Type          = linear elastic
    set Density       = 2000
    set Young modulus = 1e6
    set Poisson ratio = 0.25
  end
end
subsection Initial stress
  set Type      = given
  set Stress xx = -1600
  set Stress yy = -1600
end
subsection Boundary conditions
  subsection top
    set Sides      = top
    set Velocity y = 0
  end
  subsection left
    set Sides      = left
    set Velocity x = 0
  end
  subsection bottom
    set Sides      = bottom
    set Velocity x = 0
    set Velocity y = 0
  end
  subsection wall
    set Sides      = right
    set Velocity x = 0
    set Velocity y = 0
  end
end
subsection Loading
  set Stages = rest
  subsection rest
    set Duration  = 0.02
    set Step size = 0.01
  end
end
EOF
for names in 'left, top, bottom, wall' 'wall, bottom, top, left'; do
  for fast in true false; do
    "$program" block.prm --quiet --output run --force \
      --set "Boundary conditions/Names = $names" --set "Explicit/Fast path = $fast" 2>err
    /usr/bin/python3 - <<'EOF'
import csv
last = list(csv.DictReader(open("run/statistics.csv")))[-1]
for side, component, exact in (("left", "x", 1600), ("wall", "x", -1600), ("wall", "y", 0),
                               ("bottom", "x", 0), ("bottom", "y", 1600), ("top", "y", -1600)):
    force = float(last[f"force {side} {component} (N/m)"])
    assert abs(force - exact) < 1e-3, (side, component, force)
EOF
  done
done
