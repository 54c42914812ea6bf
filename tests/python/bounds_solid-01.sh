# Bounds in three dimensions write the fields of the last mesh: the parts of the gap have the
# mean one, the dissipation has the mean one over the volume, and tractions at the free surface
# vanish. Pictures are drawn without VTK, too, and the script for ParaView is written. The model
# has the faces of the body, seen from outside, with its supports.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/three/bounds_solver.prm" --quiet --output run \
  --set 'Analysis/Velocities = quadratic' --set 'Analysis/Stresses = quadratic' \
  --set 'Analysis/Solver tolerance = 1e-4'
GEOCONE_VTK=0 "$root/scripts/plot" run > said
grep -qx "run/mechanism.png" said
grep -qx "run/model.png" said
grep -qx "run/paraview_state.py" said
# Sand without cohesion dissipates nothing.
"$program" "$root/tests/three/bounds_sand-03.prm" --quiet --output sand \
  --set 'Output/Fields = true' --set 'Output/Expectations ='
GEOCONE_VTK=0 "$root/scripts/plot" sand > said
grep -qx "sand/mechanism.png" said
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import json

import numpy as np

from geocone.reader import Run
from geocone.style import sizes_of

run = Run("run")
field, = run.states("bounds")
volumes, cells = sizes_of(field) / 6., field.cells  # those of parallelepipeds
assert len(cells) == 30 and abs(volumes.sum() - 0.5) < 1e-6


def of_cells(name):
    values = field.data[name][cells, 0]
    assert np.all(values == values[:, :1]), name
    return values[:, 0]


assert abs(of_cells("part_of_gap").mean() - 1.) < 1e-5
assert abs(volumes @ of_cells("dissipation") / volumes.sum() - 1.) < 1e-5
assert np.linalg.norm(field.data["velocity"], axis=1).max() > 0.
at_top = np.isclose(field.points[cells, 1], 0.)
top = cells[at_top & (at_top.sum(axis=1) == 3)[:, None]]  # of cells with a face there
assert len(top) == 3 * 4
for name in "yy", "xy", "yz":
    stress = field.data[f"stress_{name}"][:, 0]
    assert np.abs(stress[top]).max() < 1e-5 * np.abs(stress).max() + 1e-3, name
model = json.loads((run.folder / "model.json").read_text())
faces = np.array(model["cells"])
areas = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]) / 2.
assert abs(np.einsum("fi,fi", areas, faces.mean(axis=1)) / 3. - 0.5) < 1e-6  # the volume
assert len(model["material_of_cell"]) == len(faces)
assert model["supports"] and all(one["faces"] for one in model["supports"])
memory = run.table("bounds")["peak memory (MB)"]
assert 20. < memory[-1] < 2000., memory
PYTHON
