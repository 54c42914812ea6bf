# Crosses of principal stresses: values and directions of a known tensor, lengths in proportion
# to the size, and tension apart from compression; means over squares keep the total force. In
# the plate of tests/meshes/opening.prm the stress around the opening is tension along the wall,
# compression across it, both of the size of the pressure (Lame). The picture is drawn on request,
# and by --stresses.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/meshes/opening.prm" --quiet --output plate --set 'Output/Fields = true' \
  --set 'Loading/push/Output every = 1' --set 'Output/Report for tests = none' \
  --set 'Output/Principal stresses = true' --set 'Mesh/Cell size = 0.5'
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from pathlib import Path

import numpy as np
from geocone.plots import pictures_of, stresses
from geocone.reader import Run

# 30 degrees from x: 2 along, -1 across.
t = np.radians(30.)
R = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
tensor = R @ np.diag([2., -1.]) @ R.T
values, directions = stresses.principal(np.array([[tensor[0, 0], tensor[1, 1], tensor[0, 1]]]))
assert np.allclose(values, [[2., -1.]])
assert np.allclose(np.abs(directions[0] @ R), np.eye(2))
lines, tension = stresses.crosses(np.zeros((1, 2)), values, directions, 4., 1.)
assert np.allclose(np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1), [0.5, 0.25])
assert list(tension) == [True, False]

rng = np.random.default_rng(1)
places, areas, tensors = rng.random((500, 2)), rng.random(500), rng.random((500, 3))
_, means, total = stresses.means_in_squares(places, areas, tensors, np.zeros(2), 0.2)
assert len(total) == 25 and np.allclose(total @ means, areas @ tensors)

run = Run(Path("plate"))
assert "principal_stresses.png" in pictures_of(run)
places, areas, tensors = stresses.stresses_of(stresses.field_of(run))
# A cubic triangle is written as nine linear ones, which have its mean.
places, tensors = places.reshape(-1, 9, 2).mean(axis=1), tensors[::9]
values, directions = stresses.principal(tensors)
r = np.linalg.norm(places, axis=1)
near = (r > 1.1) & (r < 1.6)
radial = np.abs(np.sum(directions[:, 1] * places, axis=1)) / r
error = np.abs(values * (r**2)[:, None] / 2000. - [1., -1.])[near]
print(near.sum(), "cells, errors", error.max(), "directions", radial[near].min())
assert near.sum() > 20 and error.max() < 0.1 and radial[near].min() > 0.99
PYTHON
"$root/scripts/plot" --stresses --output drawn --format svg plate
[ -s drawn/principal_stresses.svg ]
