# A strip of velocity is as wide as the nodes that it holds: a run whose box ends between
# nodes says so, and others do not.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
width() { # BOX OF THE FOOTING, FURTHER OPTIONS
  "$program" "$root/tests/footing_coarse.prm" --quiet --dry-run \
    --set "Boundary conditions/footing/Box = $1" "${@:2}" 2>err
}
# Cells of 0.1 m; of cubic ones nodes are at their thirds.
width '0, -0.1; 0.09, 0.1'
grep -q "'footing' holds nodes from x = 0 to 0.0666667 m, a width of 0.0666667 m, where 0.09 m" err
width '0, -0.1; 0.2, 0.1'
fails grep -q 'holds nodes' err
# What is outside of the body is no part of the width.
width '-5, -0.1; 0.2, 0.1'
fails grep -q 'holds nodes' err
width '0, -0.1; 0.09, 0.1' --set 'Discretisation/Element = P1'
grep -q 'a width of 0 m, where 0.09 m' err
# A point that is held has no width.
width '0, -0.1; 0.2, 0.1' --set 'Boundary conditions/Names = bottom, sides, corner, footing' \
  --set 'Boundary conditions/corner/Sides = bottom' \
  --set 'Boundary conditions/corner/Box = -0.01, -10; 0.01, 10' \
  --set 'Boundary conditions/corner/Velocity x = 0'
fails grep -q 'holds nodes' err
# A formula selects nodes, and whole faces for a traction.
width '' --set 'Boundary conditions/footing/Where = 0.09 - x'
grep -q "'footing' holds nodes from x = 0 to 0.0666667 m, .* are in its formula" err
width '' --set 'Boundary conditions/footing/Where = 0.201 - x'
fails grep -q 'holds nodes' err
load() { # FORMULA
  width '0, -0.1; 0.2, 0.1' --set 'Tractions/Names = q' --set 'Tractions/q/Sides = top' \
    --set "Tractions/q/Where = $1" --set 'Tractions/q/Traction y = -1'
}
load 'x - 0.56'
grep -q "'q' acts on whole faces from x = 0.6 to 1 m, .* where 0.43[0-9]* m are in its" err
load 'x - 0.599'
fails grep -q 'whole faces' err
# Cells belong to regions and excavations by their centres.
layer() { # DEPTH
  width '0, -0.1; 0.2, 0.1' --set 'Materials/Names = soil, weak' \
    --set 'Materials/weak/Young modulus = 1e8' --set 'Materials/weak/Cohesion = 1e3' \
    --set "Materials/weak/Region polygon = -2, -$1; 2, -$1; 2, 1; -2, 1"
}
layer 0.22
grep -q "material 'weak' takes cells by their centres, of 0.2 m^2 in all, where about 0.2[2-6]" err
layer 0.3
fails grep -q 'by their centres' err
