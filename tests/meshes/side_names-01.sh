# Sides of polygons and holes by names are those of their numbers: exact solutions hold with
# names alone (flow beside a sheet pile, consolidation with a drained side, an infinite slope
# between tied sides, a block on a column, a column in bounds), and Lame's opening and particles
# that widen a bore give the same as with numbers. Names in another order are other sides.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # NAME FILE OPTION ...
{
  local name=$1 file=$2
  shift 2
  local options=()
  for option in "$@"; do options+=(--set "$option"); done
  "$program" "$root/$file" --quiet --output "$name" --set 'Output/Pictures = false' "${options[@]}"
}
polygon() # LEFT RIGHT TOP: a box from y = 0 with sides of names that boxes do not have
{
  options=('Geometry/Shape = polygon' "Geometry/Polygon = $1, 0; $2, 0; $2, $3; $1, $3"
    'Geometry/Side names = rock, end, filter, axis' 'Mesh/Type = unstructured'
    'Mesh/Cells = triangles' 'Discretisation/Element = P2'
    'Boundary conditions/base/Sides = rock' 'Boundary conditions/sides/Sides = axis, end')
}

# The expectations of these files are exact solutions.
pile=('Seepage/gap/Sides = below the pile' 'Seepage/ground/Sides = ground')
run pile prm/seepage/sheet_pile.prm "${pile[@]}" \
  'Geometry/Side names = rock, far end, ground, pile, below the pile'
fails run exchanged prm/seepage/sheet_pile.prm "${pile[@]}" \
  'Geometry/Side names = rock, far end, ground, below the pile, pile'
polygon 0 0.1 1
run drained prm/consolidation/terzaghi.prm "${options[@]}" \
  'Time stepping/Drained sides = filter' 'Tractions/fill/Sides = filter'
polygon 0 1 1
run block tests/contact/free_block-01.prm "${options[@]}"
run tied prm/safety/infinite_slope.prm 'Geometry/Side names = rock, right, ground, left' \
  'Discretisation/Tied sides = left: right' 'Boundary conditions/base/Sides = rock' \
  'Output/Expectations = reference/relative_error = 0 +- 0.01'
run bounds tests/limit_load/column-01.prm 'Geometry/Side names = foot, 1, head, axis' \
  'Boundary conditions/bottom/Sides = foot' 'Boundary conditions/axis/Sides = axis' \
  'Tractions/top/Sides = head'

# All sides of a hole, and sides of particles, of which some keep their numbers.
run hole tests/meshes/opening.prm 'Geometry/Holes = circle(0, 0, 1, 24)'
run opening tests/meshes/opening.prm 'Geometry/Holes = "opening, round": circle(0, 0, 1, 24)' \
  'Tractions/pressure/Sides = "opening, round"'
cmp hole/statistics.csv opening/statistics.csv
run bore tests/mpm/bore-segments-01.prm
run named tests/mpm/bore-segments-01.prm \
  'Geometry/Side names = a, b, c, d, e, 5, 6, h, 8, left, 10, 11, 12, 13, 14, 15, 16, axis' \
  'Boundary conditions/bore/Sides = h, 6, 5, a, b, c, d, e'
# Sides are treated in the order of their names: loads are equal to rounding.
for run in bore named; do cut -d, -f1-4 $run/statistics.csv >$run.csv; done
numdiff -q -s ', \n' -r 1e-8 -a 1e-12 bore.csv named.csv
