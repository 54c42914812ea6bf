# Mesh files are data: a script of gmsh runs only if the command line says so, and the
# options beside a mesh never; what gmsh cannot do ends with exit code 1 and a
# remedy, not with an abort.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" scene.prm --quiet --set "Geometry/File = $1" --output "$2" "${@:3}"
}
trusted=(--run-gmsh-script)
sed "s|include |include $root/tests/fem/|" "$root/tests/fem/plate-msh-01.prm" >scene.prm
cp "$root/tests/fem/two_squares.msh" squares.msh

# The script makes the same plate with the same sides, where the expectations of
# the scene (the exact solution) hold; gmsh may run commands in the
# background.
cat >squares.geo <<'GEO'
SystemCall "touch was_run";
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0};
Point(4) = {2, 1, 0}; Point(5) = {1, 1, 0}; Point(6) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Line Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Line Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Transfinite Line {1:7} = 2;
Transfinite Surface {1:2};
Physical Line("ground", 1) = {1, 2}; Physical Line("end", 2) = {3};
Physical Line("wall", 3) = {6}; Physical Line(4) = {4, 5};
Physical Surface("left", 7) = {1}; Physical Surface("right", 8) = {2};
GEO
was_run() {
  for wait in 1 2 3 4 5 6 7 8 9 10; do
    [ -e was_run ] && return 0
    sleep 0.1
  done
  return 1
}
refused() { # FILE TEXT OPTIONS...
  if run "$1" results "${@:3}" 2>error; then exit 1; fi
  grep -q "$2" error && grep -q '^  remedy:' error
  [ ! -e results ]
}

cp squares.geo script.msh
cp squares.geo script.step
cp squares.geo squares.msh.opt
refused squares.geo 'a geo script is a program'
refused squares.geo 'a geo script is a program' --dry-run
refused squares.geo 'give the option --run-gmsh-script' \
  --set 'Geometry/Run gmsh script = true'
refused script.msh 'begins with .MeshFormat'
refused script.msh 'begins with .MeshFormat' "${trusted[@]}"
refused script.step 'begins with .MeshFormat' "${trusted[@]}"
run squares.msh data
run squares.msh again "${trusted[@]}"
fails was_run
run squares.geo script "${trusted[@]}"
was_run

# The bounds mesh the same way, and a run that goes on meshes again.
sed "s|include |include $root/prm/limit_load/|" >bounds.prm <<'PRM'
include footing_rough.prm
subsection Geometry
  set Shape = file
  set File  = squares.geo
end
PRM
rm was_run
if "$program" bounds.prm --dry-run --quiet 2>error; then exit 1; fi
grep -q 'a geo script is a program' error
run squares.geo saved "${trusted[@]}" --set 'Checkpoint/Every steps = 1'
was_run
rm was_run
if "$program" --resume saved --quiet 2>error; then exit 1; fi
grep -q 'a geo script is a program' error
fails was_run
"$program" --resume saved --quiet "${trusted[@]}"
was_run
# gmsh throws texts.
echo 'Plane Surface(3) = {4};' >no_curve.geo
refused no_curve.geo 'cannot be made by gmsh: Unknown curve loop 4' "${trusted[@]}"
echo 'Point(1) = {0, 0, 0};' >no_surface.geo
refused no_surface.geo 'no cells in two dimensions' "${trusted[@]}"

# What is no file of meshes.
: >empty.msh
refused empty.msh 'begins with .MeshFormat'
head -c 5000 /dev/urandom >random.msh
refused random.msh 'begins with .MeshFormat'
mkdir folder.msh
refused folder.msh 'an existing gmsh .msh file'
mkfifo pipe.msh
refused pipe.msh 'an existing gmsh .msh file'
refused /dev/zero 'an existing gmsh .msh file'
truncate -s 600M large.msh
refused large.msh 'has 600 MB'
rm large.msh
