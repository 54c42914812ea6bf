# UMATs in C and in Fortran give what the built-in laws give, to 1e-10: components, shear
# strains, tangent and history, at a point and by all methods, on two ranks and resumed.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cc -O2 -shared -fPIC -o drucker_prager.so "$root/prm/umat/drucker_prager.c" -lm
run() {
  OMPI_MCA_rmaps_base_oversubscribe=1 "$@" --load-library --quiet --set 'Output/Pictures = false' \
    2>>warnings
}
block() { # NAME OPTIONS...
  run "$program" "$root/tests/umat/block.prm" --output "$@"
}
umat=(--set 'Materials/soil/Type = umat' --set "Materials/soil/Library = $PWD/drucker_prager.so")
mpm=(--set 'Discretisation/Method = MPM' --set 'Discretisation/Element = Q1'
  --set 'Mesh/Box = 0, 0; 1, 1.25' --set 'Particles/Points per direction = 2')
explicit=("${mpm[@]}" --set 'Discretisation/Method = explicit MPM')

run "$program" "$root/prm/umat/compression.prm" --output point "${umat[@]:2}"
block fem --set 'Output/Expectations = state/largest_plastic_strain >= 0.005'
block fem_umat "${umat[@]}" --set 'Checkpoint/Every steps = 2'
for method in mpm explicit; do
  declare -n options=$method
  block "$method" "${options[@]}"
  block "${method}_umat" "${options[@]}" "${umat[@]}"
done
for law in three three_umat; do
  options_of_law=()
  [ $law = three ] || options_of_law=("${umat[@]}")
  run "$program" "$root/tests/umat/cube.prm" --output $law "${options_of_law[@]}"
done
run mpirun -np 2 "$program" "$root/tests/umat/block.prm" --output two_ranks "${umat[@]}"
cp -r fem_umat resumed # the fourth of five steps is in its checkpoint
"$program" --resume resumed --load-library --quiet

pairs='fem:fem_umat mpm:mpm_umat explicit:explicit_umat three:three_umat fem:two_ranks fem:resumed'
if command -v gfortran >compiler; then
  gfortran -O2 -shared -fPIC -o von_mises.so "$root/prm/umat/von_mises.f"
  block mises --set 'Materials/soil/Type = von Mises'
  block mises_umat "${umat[@]:0:2}" --set "Materials/soil/Library = $PWD/von_mises.so" \
    --set 'Materials/soil/Number of state variables = 0' \
    --set 'Materials/soil/Constants = 1e7, 0.3, 10e3'
  pairs+=' mises:mises_umat'
else
  echo 'gfortran is missing: the law in Fortran is left out'
fi
/usr/bin/python3 -B - $pairs <<'PYTHON'
import csv
import sys

def table(run):
    with open(f"{run}/statistics.csv") as file:
        return list(csv.DictReader(file))

for pair in sys.argv[1:]:
    built_in, umat = map(table, pair.split(":"))
    assert len(built_in) == len(umat) > 3, pair
    compared = [name for name in umat[0] if name.startswith(
        ("load", "force plate", "largest plastic strain", "elastic energy", "plastic dissipation",
         "external work", "stress work", "kinetic energy"))]
    assert len(compared) > 2, list(umat[0])
    for name in compared:
        values = [[float(row[name]) for row in rows] for rows in (built_in, umat)]
        largest = max(map(abs, values[0]))
        for a, b in zip(*values):
            assert abs(a - b) <= 1e-10 * largest, (pair, name, a, b)
PYTHON
