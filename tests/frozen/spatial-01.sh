# Steps of round bodies, with pressures of cells among them, and of three dimensions, frozen and
# solved again: in as many iterations, to the same stresses. A file of one dimension is not
# taken for one of another.
program=$1 lab=$(dirname "$1")/geocone-lab root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
freeze() { # NAME FILE STEP DURATION OPTIONS...
  "$program" "$root/$2" --quiet --output "$1" --set "Output/Freeze steps = $3" \
    --set "Loading/push/Duration = $4" --set 'Output/Report for tests = none' \
    --set 'Output/Expectations =' --set 'Output/Fields = true' \
    --set 'Output/Fields format = hdf5' --set 'Output/Pictures = false' "${@:5}"
  "$lab" "$1/frozen-$3.h5" --output "again_$1" >"$1.log"
}
freeze round tests/fem/circular_footing-02.prm 3 0.0035
freeze pressures tests/mpm/circular_footing-02.prm 3 0.35
freeze three tests/three/circular_footing-01.prm 5 0.01 --run-gmsh-script
cat >check.py <<'PYTHON'
import csv
import json
import shutil
from pathlib import Path

import h5py
import numpy as np

for name, step in (("round", 3), ("pressures", 3), ("three", 5)):
    with open(name + "/newton.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if int(row["step"]) == step]
    with open("again_" + name + "/summary.json", encoding="utf-8") as file:
        again = json.load(file)
    assert again["converged"], again
    assert again["iterations"] == max(int(row["iteration"]) for row in rows) >= 2, (name, again)
    # The frozen step is the last one, after which the fields are written.
    stress = np.loadtxt("again_" + name + "/stress.csv", delimiter=",", skiprows=1)
    with h5py.File(sorted(Path(name).glob("points-*.h5"))[-1]) as file:
        normal = np.stack([file["stress_xx"][:, 0], file["stress_yy"][:, 0]], axis=1)
    assert np.allclose(stress[:, :2], normal, rtol=0., atol=1e-9 * np.abs(normal).max()), name
with h5py.File("pressures/frozen-3.h5") as file:
    n = len(file["points/weight"])
    assert len(file["points/hoop"]) == n * file["points/n_nodes"][0]
    assert len(file["points/volumetric_modes"]) == n
shutil.copy("three/frozen-5.h5", "flat.h5")
with h5py.File("flat.h5", "a") as file:
    del file["dimension"]
PYTHON
/usr/bin/python3 check.py
fails "$lab" flat.h5 2>err >log
grep -q "inconsistent" err && grep -q "remedy" err
