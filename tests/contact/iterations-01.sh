# Contact costs no iterations: a footing, or a wall, that is an obstacle, on soil that sticks to it
# or slides along it, takes at most 1.3 times the iterations of one whose nodes have prescribed
# velocities, with dilatancy as large as friction and half as large, and both have the same load
# to 1e-8. (To 1e-4 the rough wall's, whose lowest node is held by the base, too, but touches the
# obstacle alone.)
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # NAME SCENE OPTION ...
{
  local name=$1 scene=$2
  shift 2
  "$program" "$root/prm/$scene.prm" --quiet --output "$name" --set 'Output/Expectations =' \
    --set 'Output/Fields = false' --set 'Output/Pictures = false' "$@"
}
wall() # NAME DILATANCY OPTION ...
{
  local name=$1 dilatancy=$2
  shift 2
  run "$name" contact/wall_passive --set 'Observation/Reference = none' \
    --set "Materials/sand/Dilatancy angle = $dilatancy" "$@"
}
held=(--set 'Obstacles/Names =' --set 'Boundary conditions/Names = base, end, wall'
      --set 'Boundary conditions/wall/Sides = left' --set 'Boundary conditions/wall/Velocity x = 0.01')
rough=(--set 'Boundary conditions/base/Velocity x = 0'
       --set 'Boundary conditions/base/Box = 0.01, -1; 4, 0.01')
for part in whole half; do
  if [ $part = whole ]; then soil=25 sand=30; else soil=12.5 sand=15; fi
  for scene in footing_fem contact/footing; do
    run "${scene##*/}-$part" "$scene" --set "Materials/soil/Dilatancy angle = $soil" \
      --set 'Discretisation/Element = P2' --set 'Mesh/Type = graded' \
      --set 'Mesh/Smallest size = 0.02' --set 'Mesh/Growth factor = 1.5'
  done
  wall smooth_held-$part $sand "${held[@]}"
  wall smooth_wall-$part $sand
  wall rough_held-$part $sand "${rough[@]}" "${held[@]}" \
    --set 'Boundary conditions/wall/Velocity y = 0'
  wall rough_wall-$part $sand "${rough[@]}" --set 'Obstacles/wall/Friction coefficient = 100'
done
/usr/bin/python3 - <<'PYTHON'
import json

for held, touched, close in (("footing_fem", "footing", 1e-8), ("smooth_held", "smooth_wall", 1e-8),
                             ("rough_held", "rough_wall", 1e-4)):
    for part in "whole", "half":
        runs = [json.load(open(f"{name}-{part}/summary.json")) for name in (touched, held)]
        n, most = (run["newton"]["iterations_mean"] for run in runs)
        loads = [run["limit_load"]["last"] for run in runs]
        print(f"{touched}, {part} dilatancy: {n} iterations per step, {most} with held nodes; "
              f"{loads} N/m")
        assert n <= 1.3 * most, (touched, part, n, most)
        assert abs(loads[0] / loads[1] - 1.) <= close, (touched, part, loads)
PYTHON
