# The same parameter files by all methods, but for the line of the method: stresses of
# all points against exact ones.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for scene in column strip; do
  for method in FEM MPM 'explicit MPM'; do
    "$program" "$root/tests/methods/$scene.prm" --quiet \
      --output "$scene-${method/ /_}" --set "Discretisation/Method = $method"
  done
done
/usr/bin/python3 - <<'PYTHON'
import pathlib

import h5py
import numpy as np

# Of 20 and 90 kPa. Points move by 0.1 mm and 1 mm, which exact values leave out.
allowed = {"FEM": 1e-9, "MPM": 2e-3, "explicit_MPM": 2e-3}
for folder in sorted(pathlib.Path().iterdir()):
    scene, method = folder.name.split("-")
    with h5py.File(sorted(folder.glob("points-*.h5"))[-1]) as file:
        y = file["nodes"][:][:, 1]
        xx, yy, xy, zz = (file["stress_" + name][:].ravel()
                          for name in ("xx", "yy", "xy", "zz"))
    if scene == "column":
        exact = {"yy": -2e4 * (1. - y), "xx": -2e4 / 3. * (1. - y)}
        exact["zz"], scale = exact["xx"], 2e4
    else:
        exact, scale = {"xx": -9e4, "yy": -3e4, "zz": -3e4}, 9e4
    exact["xy"] = 0.
    for name, values in (("xx", xx), ("yy", yy), ("xy", xy), ("zz", zz)):
        error = np.max(np.abs(values - exact[name])) / scale
        assert error <= allowed[method], (folder, name, error)
PYTHON
