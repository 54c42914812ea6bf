# Fields of obstacles have their displacements, by which pictures enlarge them as they enlarge
# those of the body: an obstacle at its true place would stand in or off the deformed mesh.
# Displacements count from the stage that sets those of the body to zero.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/contact/wall_passive.prm" --quiet --output run \
  --set 'Mesh/Cell size = 0.5' --set 'Obstacles/wall/Velocity y = -0.02' \
  --set 'Loading/Stages = seat, push' --set 'Loading/seat/Duration = 0.1' \
  --set 'Loading/seat/Step size = 0.1' --set 'Loading/push/Duration = 0.2' \
  --set 'Loading/push/Step size = 0.1' --set 'Loading/push/Reset displacement = true' \
  --set 'Output/Pictures = false' --set 'Output/Expectations =' \
  --set 'Output/Report for tests = none'
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import numpy as np

from geocone.plots import overlay
from geocone.reader import Run

run = Run("run")
for time in 0.1, 0.3:
    moved = run.obstacles(time).data["displacement"][:, :2]
    assert np.allclose(moved, [0.01 * time, -0.02 * time], atol=1e-12), moved
# Since the reset at 0.1 s.
moved = overlay.obstacle_displacements(run, 0.3)
assert moved.shape[1:] == (3, 2) and np.allclose(moved, [0.002, -0.004], atol=1e-12), moved
drawn = overlay.enlarged(moved, 10., 0.0025)
assert np.allclose(np.linalg.norm(drawn, axis=-1), 0.025), drawn  # not beyond the largest
PYTHON
