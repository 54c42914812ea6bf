# Particles at the Gauss points of finite elements are finite elements: the footing on
# one mesh of triangles has the same load by both methods, to what inertia leaves.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for scene in rough mpm_triangles; do
  "$program" "$root/prm/verification/prandtl_$scene.prm" --quiet \
    --output "$scene" --set 'Output/Pictures = false' \
    --set 'Mesh/Smallest size = 0.002' --set 'Mesh/Size ratio = 0.3' \
    --set 'Particles/Layout = Gauss' --set 'Particles/Points per direction = 3' \
    --set 'Output/Expectations ='
done
/usr/bin/python3 - <<'PYTHON'
import json

loads, iterations = [], []
for scene in "rough", "mpm_triangles":
    with open(f"{scene}/summary.json") as file:
        summary = json.load(file)
    loads.append(summary["limit_load"]["value"])
    iterations.append(summary["newton"]["iterations_mean"])
assert abs(loads[1] / loads[0] - 1.) < 1e-7, loads
assert iterations[1] <= 1.2 * iterations[0], iterations
PYTHON
