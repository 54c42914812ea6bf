# VTU and HDF5 files hold the same nodes, cells and values, on one rank and on two;
# the XDMF record names what is in the HDF5 files.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$@" --quiet --set 'Output/Report for tests = none' \
    --set 'Output/Fields = true' --set 'Output/Fields format = both' \
    --set 'Output/Pictures = false'
}
for ranks in 1 2; do
  call=("$program")
  [ $ranks = 1 ] || call=(mpirun -np $ranks "$program")
  run "${call[@]}" "$root/tests/footing_coarse.prm" --output fem$ranks \
    --set 'Loading/push/Duration = 0.02'
  run "${call[@]}" "$root/tests/fem/footing-Q2-01.prm" --output quadrilaterals$ranks \
    --set 'Loading/push/Duration = 0.02' --set 'Output/Expectations ='
  run "${call[@]}" "$root/tests/mpm/square-01.prm" --output mpm$ranks \
    --set 'Output/Expectations ='
  run "${call[@]}" "$root/tests/explicit/collapse.prm" --output explicit$ranks
  run "${call[@]}" "$root/tests/three/triaxial-02.prm" --output solid$ranks \
    --set 'Output/Expectations =' --set 'Loading/press/Output every = 6'
done
/usr/bin/python3 -B - "$root" <<'PYTHON'
import pathlib, re, sys
import xml.etree.ElementTree as tree
import h5py
import numpy as np

sys.path.insert(0, sys.argv[1] + "/python")
from geocone.reader import read_vtu

folders = [path for path in pathlib.Path().iterdir() if path.is_dir()]
assert len(folders) == 10
for folder in folders:
    files = sorted(folder.glob("*.h5"))
    assert files
    for path in files:
        record = path.with_suffix(".pvtu" if folder.name[-1] == "2" else ".vtu")
        fields = read_vtu(record)
        first, cells = 0, []
        for field in fields:
            cells.append(field.cells + first)
            first += len(field.points)
        with h5py.File(path) as file:
            names = {name for name in file if name not in ("nodes", "cells")}
            assert names == set(fields[0].data), names ^ set(fields[0].data)
            def same(values, other):
                assert values.shape == other.shape, path
                assert np.allclose(values, other, rtol=1e-6, atol=1e-30,
                                   equal_nan=True), path
            nodes = file["nodes"][:]
            assert nodes.shape[1] == (3 if folder.name[:-1] == "solid" else 2)
            same(np.concatenate([f.points for f in fields])[:, :nodes.shape[1]], nodes)
            assert np.array_equal(np.concatenate(cells), file["cells"][:])
            for name in names:
                same(np.concatenate([f.data[name] for f in fields]), file[name][:])
    # Each reference of the record, file:/name, with its size.
    for path in folder.glob("*.xdmf"):
        n = 0
        for item in tree.parse(path).iter("DataItem"):
            name, array = re.fullmatch(r"(.*):/(.*)", item.text.strip()).groups()
            with h5py.File(folder / name) as file:
                shape = tuple(int(x) for x in item.get("Dimensions").split())
                assert file[array].shape == shape, (path, array)
            n += 1
        assert n > 5
# The fields do not depend on the number of ranks.
for name in ("mpm", "explicit"):
    last = [sorted(pathlib.Path(name + str(n)).glob("points-*.h5"))[-1] for n in (1, 2)]
    with h5py.File(last[0]) as one, h5py.File(last[1]) as two:
        order = [np.lexsort(np.round(file["nodes"][:].T, 6)) for file in (one, two)]
        for array in one:
            if array not in ("cells", "id"):
                a, b = (file[array][:][i] for file, i in zip((one, two), order))
                assert np.abs(a - b).max() <= 1e-6 * (np.abs(a).max() + 1e-12), array
PYTHON
