# A step of soil that hardens, frozen with the history of its points: both formulations
# solve it again; without the history it is refused.
program=$1 lab=$(dirname "$1")/geocone-lab root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/fem/footing-hardening-01.prm" --quiet --output run \
  --set 'Loading/push/Duration = 0.06' --set 'Output/Freeze steps = 3' \
  --set 'Output/Expectations =' --set 'Output/Report for tests = none'
for formulation in 'return map' 'natural map'; do
  "$lab" run/frozen-3.h5 --set "Newton/Formulation = $formulation" >log
  grep -q ': solved, .* natural-map error [0-9.]*e-1[2-9]' log || { cat log; exit 1; }
done
/usr/bin/python3 - <<'PYTHON'
import shutil

import h5py

with h5py.File("run/frozen-3.h5") as file:
    history = file["points/history"][:].reshape(len(file["points/weight"]), -1)
    assert history.shape[1] == 2 and history[:, 1].max() > 1e-4
shutil.copy("run/frozen-3.h5", "without.h5")
with h5py.File("without.h5", "a") as file:
    del file["points/history"]
PYTHON
fails "$lab" without.h5 2>err >log
grep -q "lacks the history of its points" err && grep -q "remedy" err
