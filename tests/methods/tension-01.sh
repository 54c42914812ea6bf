# Soil that is drawn apart between smooth walls carries its tensile strength T = 5 kPa, by
# each method; across it has the stress of its elastic strain, nu/(1 - nu) T, for it opens
# along the pull alone. Without the cut-off its cone carries 28 kPa.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
soil=()
for name in soft stiff; do
  for value in 'Type = Mohr-Coulomb' 'Cohesion = 10000' 'Friction angle = 30' \
    'Dilatancy angle = 10' 'Tensile strength = 5000'; do
    soil+=(--set "Materials/$name/$value")
  done
done
for method in FEM MPM 'explicit MPM'; do
  "$program" "$root/tests/methods/strip.prm" --quiet --output "${method/ /_}" \
    --set "Discretisation/Method = $method" "${soil[@]}" \
    --set 'Boundary conditions/right/Velocity x = if(t < 0.500001, 0.002, 0)'
done
/usr/bin/python3 - <<'PYTHON'
import json
import pathlib

import h5py
import numpy as np

T = 5e3
for folder in ("FEM", "MPM", "explicit_MPM"):
    with h5py.File(sorted(pathlib.Path(folder).glob("points-*.h5"))[-1]) as file:
        xx, yy, xy = (file["stress_" + name][:].ravel() for name in ("xx", "yy", "xy"))
    largest = (xx + yy) / 2. + np.hypot((xx - yy) / 2., xy)
    print(folder, xx.min(), xx.max(), yy.min(), yy.max(), largest.max())
    assert largest.max() <= T * (1. + 1e-12), folder
    if folder == "FEM":
        assert abs(xx / T - 1.).max() < 1e-9 and abs(yy / (T / 3.) - 1.).max() < 1e-9
    elif folder == "MPM":  # its points move by 1 mm
        assert abs(xx / T - 1.).max() < 5e-3 and abs(yy / (T / 3.) - 1.).max() < 5e-3
    else:  # the end of the push unloads it by a wave of rho c v = 1 kPa
        assert xx.min() > 0.7 * T, xx.min()
    if folder != "explicit_MPM":
        quality = json.load(open(folder + "/summary.json"))["quality"]
        print(quality)
        assert quality["natural_map_error_max"] < 1e-10
PYTHON
