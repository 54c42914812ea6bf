# What a run has not found is said: a cut that slides while its strength is reduced, a
# reference that the run has not, a record that begins when the loading has ended.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cat >cut.prm <<'EOF'
# A vertical cut of 4 m: F = 3.776 c/(gamma H) = 1.180 for c = 25 kPa.
include ROOT/tests/common.prm
subsection Geometry
  set Shape   = polygon
  set Polygon = 0, 0; 12, 0; 12, 2; 6, 2; 6, 6; 0, 6
end
subsection Mesh
  set Type      = unstructured
  set Cell size = 1
end
subsection Materials
  set Names = clay
  subsection clay
    set Type          = Tresca
    set Cohesion      = 25e3
    set Unit weight   = 20e3
    set Young modulus = 2e7
    set Poisson ratio = 0.3
  end
end
subsection Gravity
  set Acceleration  = 0, -10
  set Ramp duration = 1
end
subsection Time stepping
  set Inertia = true
end
subsection Boundary conditions
  set Names = bottom, sides
  subsection bottom
    set Sides      = 0
    set Velocity x = 0
    set Velocity y = 0
  end
  subsection sides
    set Sides      = 1, 5
    set Velocity x = 0
  end
end
subsection Loading
  set Stages = weight, reduction
  subsection weight
    set Duration  = 2
    set Step size = 0.2
  end
  subsection reduction
    set Duration        = 4
    set Step size       = 0.2
    set Strength factor = 1.5
  end
end
EOF
sed -i "s|ROOT|$root|" cut.prm
run() { # FOLDER, OPTIONS
  "$program" cut.prm --quiet --set "Output/Folder = $1" "${@:2}" 2>err
}
run moves
grep -q 'warning: the body accelerates by the strength factor 1.25' err
run rests --set 'Loading/reduction/Strength factor = 1.1'
fails grep -q 'accelerates' err
/usr/bin/python3 - <<'EOF'
import json
moves, rests = (json.load(open(f"{name}/summary.json"))["safety"] for name in ("moves", "rests"))
assert 1.1 < moves["lower"] < 1.3 and moves["upper"] is None and moves["factor"] is None, moves
assert "no equilibrium" in moves["criterion"], moves
assert rests["lower"] == 1.1 and "all factors" in rests["criterion"], rests
EOF

run none --set 'Loading/Stages = weight' --set 'Reference/Quantity = limit_load/value' \
  --set 'Reference/Expected = 1'
grep -q "warning: reference: this run has no number 'limit_load/value'" err

printf 't,v\n7,0\n8,1\n' >late.csv
run late --set 'Loading/Stages = weight' \
  --set 'Boundary conditions/sides/Velocity x = record late.csv' --dry-run
grep -q "the record of 'sides' begins at t = 7 s" err

# A plate on the upper side of a mesh that is higher than the body of particles.
cat >plate.prm <<EOF
include $root/tests/stages/geostatic_fill-02.prm
subsection Boundary conditions
  set Names = bottom, sides, plate
  subsection plate
    set Sides      = top
    set Velocity y = -0.001
  end
end
EOF
push() {
  "$program" plate.prm --quiet --set 'Output/Expectations =' --set "Output/Folder = $1" "${@:2}" 2>err
}
push above
grep -q "no force acts on 'plate' in any step" err
push beside --set 'Mesh/Box = 0, 0; 1, 6'
fails grep -q 'no force' err
