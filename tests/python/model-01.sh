# The model of a scene is drawn without a run, into a folder of its own, and again into the
# same one; its description has materials, supports, loads and what stages change.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for _ in 1 2; do
  "$program" "$root/prm/stages/embankment.prm" --dry-run --picture --quiet
done
"$program" "$root/prm/three/square_footing.prm" --dry-run --picture --quiet --output space
"$program" "$root/prm/footing_mpm.prm" --dry-run --picture --quiet --output particles
/usr/bin/python3 -B - <<'END'
import json
from pathlib import Path

from PIL import Image

for name in ("results/embankment-model", "space", "particles"):
    with Image.open(Path(name) / "model.png") as picture:
        print(name, picture.width > 500 and picture.height > 300)
model = json.loads(Path("results/embankment-model/model.json").read_text())
print([material["name"] for material in model["materials"]])
print([stage.get("added") for stage in model["stages"]][:2])
for support in model["supports"]:
    print(support["name"], support["prescribed"], max(map(max, support["values"])))
road, = model["tractions"]
ends = sorted(x for face in road["faces"] for x, _ in face)
print("road", ends[0], ends[-1], min(value[1] for value in road["values"]))
particles = json.loads(Path("particles/model.json").read_text())
print(particles["material_of_cell"], len(particles["cells"]) > 0, particles["body"]["shape"])
END
"$program" "$root/prm/footing_mpm.prm" --picture 2>&1 | head -2
ls results
