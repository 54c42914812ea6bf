# Steps of round bodies, with pressures of cells among them, and of three dimensions, frozen and
# solved again: in as many iterations, to the same stresses. A file of one dimension is not
# taken for one of another.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
freeze() { # NAME FILE STEP
  "$program" "$root/$2" --quiet --output "$1" --set "Output/Freeze steps = $3" \
    --set "Loading/push/Duration = $4" --set 'Output/Report for tests = none' \
    --set 'Output/Expectations =' --set 'Output/Fields = false' --set 'Output/Pictures = false'
  "$program" --replay "$1/frozen-$3.h5" --output "again_$1" >"$1.log"
}
freeze round tests/fem/circular_footing-02.prm 3 0.0035
freeze pressures tests/mpm/circular_footing-02.prm 3 0.35
freeze three tests/three/circular_footing-01.prm 2 0.01
cat >check.py <<'PYTHON'
import csv
import json
import shutil

import h5py

for name, step in (("round", 3), ("pressures", 3), ("three", 2)):
    with open(name + "/newton.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if int(row["step"]) == step]
    with open("again_" + name + "/summary.json", encoding="utf-8") as file:
        again = json.load(file)
    assert again["converged"], again
    assert again["iterations"] == max(int(row["iteration"]) for row in rows) >= 2, (name, again)
with h5py.File("pressures/frozen-3.h5") as file:
    n = len(file["points/weight"])
    assert len(file["points/hoop"]) == n * file["points/n_nodes"][0]
    assert len(file["points/volumetric_modes"]) == n
shutil.copy("three/frozen-2.h5", "flat.h5")
with h5py.File("flat.h5", "a") as file:
    del file["dimension"]
PYTHON
/usr/bin/python3 check.py
if "$program" --replay flat.h5 2>err >log; then
  echo "solved as a plane problem"
  exit 1
fi
grep -q "inconsistent" err && grep -q "remedy" err
