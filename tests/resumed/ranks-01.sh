# Particles on a shared mesh, whose order depends on the number of ranks: a run on one rank that
# goes on with two observes the same particles, also where soil is added later.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run=("$program" "$root/tests/stages/changed_mass-01.prm" --quiet --output whole
  --set 'Output/Report for tests = none' --set 'Output/Expectations ='
  --set 'Mesh/Triangulation = shared' --set 'Boundary conditions/sides/Sides = left' --set 'Materials/soil/Young modulus = 1e7'
  --set 'Materials/twin/Young modulus = 1e7' --set 'Materials/twin/Region polygon = -1, 0.5; 2, 0.5; 2, 2; -1, 2'
  --set 'Loading/change/Changed materials =' --set 'Loading/change/Added materials = twin'
  --set 'Observation/Points = 1, 0.5; 0.2, 0.5; 0.8, 0.3'
  --set 'Checkpoint/Every steps = 1' --set 'Checkpoint/Keep = 200')
"${run[@]}"
cp -r whole resumed
rm resumed/checkpoint-0000{06..20}.h5
mpirun -n 2 "$program" --resume resumed --quiet
/usr/bin/python3 - <<'END'
import csv
rows = [list(csv.DictReader(open(f"{name}/statistics.csv"))) for name in ("whole", "resumed")]
assert len(rows[0]) == len(rows[1]) == 20
for whole, resumed in zip(*rows):
    for column in whole:
        if column.startswith("displacement of point"):
            a, b = float(whole[column]), float(resumed[column])
            assert abs(a - b) <= 1e-7 * max(abs(a), 1e-5), (whole["step"], column, a, b)
END
