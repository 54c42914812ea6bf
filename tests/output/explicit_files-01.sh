# The files and pictures of an explicit run are there and can be read, also by one
# that knows nothing of the laws; the balances close in statistics.csv.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/explicit/collapse.prm" --quiet --output a \
  --set 'Output/Report for tests = none' --set 'Output/Fields = true' \
  --set 'Loading/fall/Output every = 1'
for file in parameters.prm statistics.csv summary.json log.txt points.pvd \
  points-0000.vtu points-0004.vtu; do
  [ -s "a/$file" ] || { echo "no $file"; exit 1; }
done
"$root/scripts/plot" a
for picture in energy points runout; do
  [ -s "a/$picture.png" ] || { echo "no $picture.png"; exit 1; }
done
/usr/bin/python3 - <<'PYTHON'
import csv, json
summary = json.load(open("a/summary.json"))
assert summary["status"] == "finished"
for topic, names in {
    "explicit": ["steps", "smallest_step_s", "massless_nodes"],
    "state": ["points", "mass_kg_per_m", "right_front_m", "y_largest_m"],
    "energy": ["stress_work_J_per_m", "numerical_loss_max_relative"],
    "momentum": ["residual_max_relative"],
    "cost": ["cpu_ns_per_point_step", "bytes_per_point"]}.items():
    for name in names:
        assert name in summary[topic], (topic, name)
rows = [{key: float(value) for key, value in row.items()}
        for row in csv.DictReader(open("a/statistics.csv"))]
assert len(rows) == 4
for row in rows:
    # What has fallen is the work of gravity; what stays is mass.
    fallen = rows[0]["potential energy (J/m)"] + rows[0]["gravity work (J/m)"]
    assert abs(fallen - row["potential energy (J/m)"] - row["gravity work (J/m)"]
               ) < 1e-8 * fallen
    assert abs(row["mass (kg/m)"] - 4000.) < 1e-8
    assert row["x of 99 % of the mass (m)"] <= row["x largest (m)"] + 1e-12
assert sum(row["explicit steps (-)"] for row in rows) == summary["explicit"]["steps"]
PYTHON

# The parameters as used repeat the run.
"$program" a/parameters.prm --quiet --output again --set 'Output/Report for tests = none'
cmp <(cut -d, -f1-3,5-35 a/statistics.csv) <(cut -d, -f1-3,5-35 again/statistics.csv)
