# A law with an internal variable in all methods: the stress and the cohesion of each
# point follow the closed form of tests/methods/hardening.prm. FEM is exact;
# points move by up to 0.1 mm in cells of 0.25 m, 4e-4 of them, by which sums over
# them are no longer the integrals.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for ranks in 1 2; do
  call=("$program")
  [ $ranks = 1 ] || call=(mpirun -np $ranks "$program")
  for method in FEM MPM 'explicit MPM'; do
    "${call[@]}" "$root/tests/methods/hardening.prm" --quiet \
      --output "${method/ /_}-$ranks" --set "Discretisation/Method = $method"
  done
done
/usr/bin/python3 - <<'PYTHON'
import pathlib

import h5py
import numpy as np

TAU, S_ZZ = 25e3, 0.
allowed = {"FEM": 1e-9, "MPM": 1e-3, "explicit_MPM": 1e-3}
for folder in sorted(pathlib.Path().iterdir()):
    method = folder.name.split("-")[0]
    with h5py.File(sorted(folder.glob("points-*.h5"))[-1]) as file:
        shear, cohesion = file["stress_xy"][:].ravel(), file["cohesion"][:].ravel()
        zz = file["stress_zz"][:].ravel()
        mean = (file["stress_xx"][:].ravel() + file["stress_yy"][:].ravel()) / 2.
    assert len(shear) >= 64, folder
    for name, values, exact in (("shear", shear, TAU), ("cohesion", cohesion, TAU),
                                ("zz", zz - 2. * 0.3 * mean, S_ZZ)):
        error = np.max(np.abs(values - exact)) / TAU
        assert error <= allowed[method], (folder, name, error)
PYTHON
