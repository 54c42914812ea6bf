# Seepage in three dimensions writes the fields of its tetrahedra: the velocity of a uniform flow is
# k dH/L everywhere, and the head is linear. The free surface of a dam, triangles of the model, begins
# at the level of the lake and ends at the top of the seepage face, at 12.7 m. The picture is drawn.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run()
{
  "$program" "$root/tests/three/$1-01.prm" --quiet --output "$1" --set 'Output/Fields = true' \
    --set 'Output/Report for tests = none' --set 'Seepage/Cells = 20' --set 'Output/Expectations ='
}
run seepage_patch
run seepage_dam
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import json

import numpy as np

from geocone.plots import seepage
from geocone.reader import Run
from geocone.style import finish

run = Run("seepage_patch")
field, = run.states("seepage")
assert field.cells.shape[1] == 4
velocity = field.data["seepage_velocity"]
assert np.abs(velocity - [0., 0., 1.5e-5]).max() < 1e-10, velocity
assert np.abs(field.data["head"][:, 0] - (5. - field.points[:, 2] / 2.)).max() < 1e-5
run = Run("seepage_dam")
model = json.loads((run.folder / "model.json").read_text())
surface = np.array(model["free_surfaces"][-1]["triangles"])
assert surface.shape[1:] == (3, 3)
x, y = surface.reshape(-1, 3)[:, :2].T
assert y.max() <= 24. + 1e-6 and y[x < 1e-6].min() > 23.
assert abs(y[x > 16. - 1e-6].max() - 12.7) < 2., y  # the exit point, within a cell
for name, draw in seepage.pictures(run).items():
    if name == "flow_net.png":
        draw(run, run.folder / name)
finish()
assert (run.folder / "flow_net.png").stat().st_size > 1e4
PYTHON
