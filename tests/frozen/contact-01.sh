# An arch of 30 rigid blocks, mu = 0.8 (arch.py): contact with friction alone, of Siconos'
# and of FCLib's format. Both must be the same problem, and Newton's method must solve it in
# a few iterations, to the forces that are in equilibrium with the weight. What is no such
# problem is refused by what is wrong.
lab=$(dirname "$1")/geocone-lab root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for format in dat hdf5; do
  "$lab" "$root/tests/frozen/arch_30.$format" --output "$format" >"$format.log"
done
cat >check.py <<'PYTHON'
import csv
import json
import shutil
import sys

import h5py
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1] + "/tests/frozen")
from arch import MU, problem

M, H, f = problem()
for name in ("dat", "hdf5"):
    with open(name + "/summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    assert summary["converged"] and summary["points"] == 62, summary
    assert summary["iterations"] <= 12, summary
    assert summary["natural_map_error"] <= 1e-10, summary
    rows = list(csv.reader(open(name + "/stress.csv", encoding="utf-8")))[1:]
    s = np.array(rows, dtype=float)
    # From the axes of a stress back to those of the cone: n = -(xx + yy)/sqrt 2.
    r_n = -(s[:, 0] + s[:, 1]) / 2**0.5
    r_t = np.stack([(s[:, 0] - s[:, 1]) / 2**0.5, s[:, 2]], axis=1)
    assert np.all(r_n >= -1e-9 * r_n.max())
    assert np.all(np.linalg.norm(r_t, axis=1) <= MU * r_n + 1e-8 * r_n.max())
    assert np.all(np.abs(np.prod(r_t, axis=1)) <= 1e-8 * r_n.max()**2)
    along = r_t[:, np.argmax(np.abs(r_t).max(axis=0))]
    best = 1e300
    for sign in (1., -1.):
        r = np.empty(2 * len(r_n))
        r[0::2], r[1::2] = r_n, sign * along
        best = min(best, np.linalg.norm(H.T @ ((f + H @ r) / M)))
    assert best <= 1e-7 * np.linalg.norm(H.T @ (f / M)), best  # at rest
shutil.copy(sys.argv[1] + "/tests/frozen/arch_30.hdf5", "rolls.hdf5")
with h5py.File("rolls.hdf5", "a") as file:
    file.move("fclib_global", "fclib_global_rolling")
shutil.copy(sys.argv[1] + "/tests/frozen/arch_30.hdf5", "cut.hdf5")
with h5py.File("cut.hdf5", "a") as file:
    del file["fclib_global/vectors/mu"]
    file["fclib_global/vectors/mu"] = np.full(60, 0.8)
shutil.copy(sys.argv[1] + "/tests/frozen/arch_30.hdf5", "outside.hdf5")
with h5py.File("outside.hdf5", "a") as file:
    file["fclib_global/H/i"][3] = 90
shutil.copy(sys.argv[1] + "/tests/frozen/arch_30.hdf5", "lacks.hdf5")
with h5py.File("lacks.hdf5", "a") as file:
    del file["fclib_global/spacedim"]
PYTHON
/usr/bin/python3 check.py "$root"
head -c 20000 "$root/tests/frozen/arch_30.dat" >cut.dat
sed '$d' "$root/tests/frozen/arch_30.dat" | sed '$s/8/-8/' >negative.dat
refused() {
  if "$lab" "$1" 2>err >log; then
    echo "solved: $1"
    exit 1
  fi
  grep -q "$2" err || { cat err; exit 1; }
  grep -q "remedy" err
}
refused rolls.hdf5 "rolling friction"
refused cut.hdf5 "entries, which must be 120"
refused outside.hdf5 "outside of it"
refused lacks.hdf5 "lacks the array"
refused cut.dat "ends within a row of the matrix"
refused negative.dat "coefficient of friction"
