# A step whose light functions have ghost stiffness, frozen: it must be solved again in
# as many iterations, and to the same residual; stencils that do not fit are refused.
program=$1 lab=$(dirname "$1")/geocone-lab root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/mpm/footing_deep-01.prm" --quiet --output run \
  --set 'Loading/push/Duration = 3' --set 'Output/Freeze steps = 8' \
  --set 'Output/Expectations =' --set 'Output/Report for tests = none'
"$lab" run/frozen-8.h5 >log
cat >check.py <<'PYTHON'
import csv
import re
import shutil

import h5py

with h5py.File("run/frozen-8.h5") as file:
    assert len(file["ghosts/nodes"]) >= 3
with open("run/newton.csv", encoding="utf-8") as file:
    last = [row for row in csv.DictReader(file) if row["step"] == "8"][-1]
iterations, residual = re.search(
    r"solved, (\d+) iterations, residual ([0-9.e-]+)",
    open("log", encoding="utf-8").read()).groups()
assert int(iterations) == int(last["iteration"]), (iterations, last)
assert float(residual) < 1e-10
shutil.copy("run/frozen-8.h5", "damaged.h5")
with h5py.File("damaged.h5", "a") as file:
    file["ghosts/nodes"][0] = 10 ** 6
PYTHON
/usr/bin/python3 check.py
fails "$lab" damaged.h5 2>err >log
grep -q "ghost stiffness is of nodes that it lacks" err && grep -q "remedy" err
