# Contact costs no iterations: a footing that is an obstacle, on soil that sticks to it, takes at
# most 1.3 times the iterations of one whose nodes have prescribed velocities, with dilatancy as
# large as friction and half as large, and both have the same load to 1e-8.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for dilatancy in 25 12.5; do
  for scene in footing_fem contact/footing; do
    "$program" "$root/prm/$scene.prm" --quiet --output "${scene##*/}-$dilatancy" \
      --set "Materials/soil/Dilatancy angle = $dilatancy" --set 'Output/Expectations =' \
      --set 'Discretisation/Element = P2' --set 'Mesh/Type = graded' --set 'Mesh/Smallest size = 0.02' \
      --set 'Mesh/Growth factor = 1.5' --set 'Output/Fields = false' \
      --set 'Output/Pictures = false'
  done
done
/usr/bin/python3 - <<'PYTHON'
import json

for dilatancy in "25", "12.5":
    held, touched = (json.load(open(f"{name}-{dilatancy}/summary.json"))
                     for name in ("footing_fem", "footing"))
    n, most = (run["newton"]["iterations_mean"] for run in (touched, held))
    loads = [run["limit_load"]["last"] for run in (touched, held)]
    print(f"{dilatancy} degrees: {n} iterations per step, {most} with held nodes; {loads} N/m")
    assert n <= 1.3 * most, (dilatancy, n, most)
    assert abs(loads[0] / loads[1] - 1.) <= 1e-8, (dilatancy, loads)
PYTHON
