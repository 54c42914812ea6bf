# Bounds around an axis are verified by a script that does not use the program: a reaction of clay, a
# live pressure on soil with friction, a factor of safety, a circular cone, dead loads, whose stresses
# cannot be scaled. The bracket of the cylinder contains its exact load. Fields, loads and strengths
# that were changed are found.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  local name=$1 scene=$2
  shift 2
  local settings=()
  for setting in "$@"; do settings+=(--set "$setting"); done
  "$program" "$root/$scene.prm" --quiet --output "$name" --set 'Output/Certificates = true' \
    --set 'Output/Expectations =' --set 'Output/Report for tests = none' \
    --set 'Output/Pictures = false' "${settings[@]}" || exit 1
}
run reaction prm/axisymmetric/bounds_disc 'Analysis/Maximum levels = 1'
run pressure tests/limit_load/axisymmetric_cylinder-01
run factor tests/limit_load/axisymmetric_plug-01
run circular tests/limit_load/axisymmetric_block-04
run dead tests/limit_load/axisymmetric_block-05 'Analysis/Solver tolerance = 1e-6'
PYTHONPATH="$root/tests/python" /usr/bin/python3 -B - "$root/scripts/check_certificate" <<'PYTHON'
import json
from pathlib import Path

from verdict import CHECKER, verdict

for folder in "reaction", "pressure", "factor", "circular", "dead":
    good, text = verdict("check_folder", folder)
    assert good and text.count(" proved for ") == 2, text


def value(folder, side):
    return json.loads(Path(folder, f"certificate_{side}.json").read_text())["value"]


assert value("pressure", "lower") <= 1164.28 / 1000. <= value("pressure", "upper")
assert value("factor", "lower") <= 4. <= value("factor", "upper")

CHANGES = (
    ("reaction", "lower", "equilibrium", ("stress_times_radius", 3, 1, 1), 1.001),
    ("reaction", "lower", "only", ("materials", 0, "cohesion"), 0.9),
    ("reaction", "lower", "only", ("multiple",), 0.999),
    ("reaction", "upper", "only", ("value",), 0.999),
    ("reaction", "upper", "only", ("materials", 0, "cohesion"), 1.1),
    ("reaction", "upper", "volume change", ("velocity", "axial", 20, 4), 1.001),
    ("reaction", "upper", "stated magnitude", ("speed",), 1.001),
    ("pressure", "lower", "tractions", ("load_factor",), 1.001),
    ("pressure", "upper", "only", ("materials", 0, "cohesion"), 1.1),
    ("pressure", "upper", "flow", ("materials", 0, "friction_angle"), 1.5),
    ("factor", "lower", "load factor", ("strength_factor",), 1.1),
    ("factor", "lower", "equilibrium along z", ("body_force", "live", 5, 1), 1.001),
    ("factor", "upper", "load factor", ("strength_factor",), 0.9),
    ("circular", "lower", "only", ("materials", 0, "strength"), 0.9),
    ("circular", "upper", "only", ("materials", 0, "strength"), 1.1),
    ("dead", "lower", "strength exceeded", ("materials", 0, "cohesion"), 0.9),
    ("dead", "lower", "a radius is negative", ("vertices", 0, 0), -1.),
)
for folder, side, reason, place, factor in CHANGES:
    content = json.loads(Path(folder, f"certificate_{side}.json").read_text())
    data = content
    for key in place[:-1]:
        data = data[key]
    if reason == "a radius is negative":
        content["vertices"] = [[r - 1e-3, z] for r, z in content["vertices"]]
    else:
        data[place[-1]] *= factor
    name = Path("changed.json")
    name.write_text(json.dumps(content))
    body, text = verdict("check", name)
    assert body is None and reason in text.partition("NOT PROVED")[2], (reason, place, text)
PYTHON
