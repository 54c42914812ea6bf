# Bounds on tetrahedra are verified by a script that does not use the program: a reaction of clay, a
# live weight with friction and a cut-off, a factor of safety under water, a circular cone, an oblique
# plane of symmetry, obstacles.
# Fields, loads and strengths that were changed are found, and so are forgeries.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  local name=$1 scene=$2
  shift 2
  local settings=()
  for setting in "$@"; do settings+=(--set "$setting"); done
  "$program" "$root/tests/three/$scene.prm" --quiet --output "$name" \
    --set 'Output/Certificates = true' --set 'Output/Expectations =' "${settings[@]}"
}
run reaction bounds_layer-01 'Analysis/Stresses = linear' 'Analysis/Velocities = linear'
run weight bounds_solver 'Analysis/Velocities = quadratic' 'Analysis/Stresses = quadratic' \
  'Materials/clay/Friction angle = 20' 'Materials/clay/Dilatancy angle = 20' \
  'Materials/clay/Tensile strength = 100'
run factor bounds_solver 'Analysis/Kind = strength reduction' 'Analysis/Solver tolerance = 1e-5' \
  'Water/Table = 0, 1' 'Materials/clay/Density = 1081'
run circular bounds_block-04
run oblique bounds_oblique-01
run plate bounds_obstacle-03
run rough bounds_obstacle-02 'Obstacles/plate/Tensile strength = 30' \
  'Materials/soil/Type = Mohr-Coulomb' 'Materials/soil/Cohesion = 300' \
  'Materials/soil/Friction angle = 20' 'Materials/soil/Dilatancy angle = 20'
PYTHONPATH="$root/tests/python" /usr/bin/python3 -B - "$root/scripts/check_certificate" <<'PYTHON'
import copy
import json
from pathlib import Path

from verdict import CHECKER, verdict

for folder in "reaction", "weight", "factor", "circular", "oblique", "plate", "rough":
    good, text = verdict("check_folder", folder)
    assert good and text.count(" proved for ") == 2, folder

CHANGES = (
    ("reaction", "lower", "div s + b", ("stress", 3, 1, 1), 1.001),
    ("reaction", "lower", "only", ("materials", 0, "cohesion"), 0.9),
    ("reaction", "upper", "only", ("value",), 0.999),
    ("reaction", "upper", "stated magnitude", ("speed",), 1.001),
    ("weight", "lower", "div s + b", ("body_force", "live", 5, 1), 1.001),
    ("weight", "upper", "only", ("materials", 0, "tensile_strength"), 2.),
    ("weight", "upper", "flow", ("materials", 0, "friction_angle"), 1.5),
    ("factor", "lower", "load factor", ("strength_factor",), 1.1),
    ("factor", "lower", "div s + b", ("body_force", "live", 5, 1), 0.5),
    ("factor", "upper", "flow rule", ("strength_factor",), 0.9),
    ("weight", "lower", "tensile_strength is negative", ("materials", 0, "tensile_strength"), -1.),
    ("weight", "upper", "90 degrees", ("materials", 0, "friction_angle"), 4.5),
    ("circular", "lower", "only", ("materials", 0, "strength"), 0.9),
    ("circular", "upper", "only", ("materials", 0, "strength"), 1.1),
    ("plate", "lower", "strength exceeded", ("obstacles", 0, "friction"), 0.9),
    ("plate", "upper", "only", ("obstacles", 0, "friction"), 1.1),
    ("plate", "lower", "otherwise than its obstacle", ("obstacles", 0, "velocity", 0), 2.),
    ("plate", "upper", "friction is negative", ("obstacles", 0, "friction"), -1.),
    ("rough", "lower", "only", ("obstacles", 0, "adhesion"), 0.9),
    ("rough", "upper", "only", ("obstacles", 0, "adhesion"), 1.1),
)
for folder, side, reason, place, factor in CHANGES:
    content = json.loads(Path(folder, f"certificate_{side}.json").read_text())
    data = content
    for key in place[:-1]:
        data = data[key]
    data[place[-1]] *= factor
    path = Path(f"changed_{side}.json")
    path.write_text(json.dumps(content))
    body, text = verdict("check", path)
    assert body is None and reason in text, (folder, side, place, text)

# The oblique plane that is free or held wholly, pushed, or not there in one of two files.
content = json.loads(Path("oblique", "certificate_lower.json").read_text())
rim = content["boundary"]
plane = rim["oblique"].index(True)
for key, value, reason in (
        ("oblique", False, "tractions"), ("held", [True] * 3, "axes and obliquely"),
        ("velocity", [2., 0., 0.], "stated magnitude")):
    before, rim[key][plane] = rim[key][plane], value
    Path("changed_lower.json").write_text(json.dumps(content))
    body, text = verdict("check", Path("changed_lower.json"))
    assert body is None and reason in text, (key, text)
    rim[key][plane] = before
content = json.loads(Path("oblique", "certificate_upper.json").read_text())
content["velocity"] = [[[0.9 * v[0], v[1], v[2]] for v in cell] for cell in content["velocity"]]
Path("changed_upper.json").write_text(json.dumps(content))
body, text = verdict("check", Path("changed_upper.json"))
assert body is None and "flow" in text, text
content = json.loads(Path("oblique", "certificate_upper.json").read_text())
content["boundary"]["oblique"][plane] = False
Path("plane").mkdir()
Path("plane", "certificate_upper.json").write_text(json.dumps(content))
Path("plane", "certificate_lower.json").write_text(
    Path("oblique", "certificate_lower.json").read_text())
good, text = verdict("check_folder", "plane")
assert not good, text

# An obstacle that holds nothing, holds more than its faces, or is not there.
content = json.loads(Path("plate", "certificate_lower.json").read_text())
rim = content["boundary"]
face = rim["obstacle"].index(0)
for key, value, reason in (("obstacle", -1, "tractions"), ("obstacle", 1, "not there"),
                           ("held", [True] * 3, "beside an obstacle")):
    before, rim[key][face] = rim[key][face], value
    Path("changed_lower.json").write_text(json.dumps(content))
    body, text = verdict("check", Path("changed_lower.json"))
    assert body is None and reason in text, (key, text)
    rim[key][face] = before

# A tetrahedron that is left out, and bounds of two problems.
content = json.loads(Path("weight", "certificate_lower.json").read_text())
less = copy.deepcopy(content)
for key in "tetrahedra", "material", "stress":
    less[key] = less[key][1:]
for kind in "dead", "live":
    less["body_force"][kind] = less["body_force"][kind][1:]
Path("changed_lower.json").write_text(json.dumps(less))
assert "boundary is not complete" in verdict("check", Path("changed_lower.json"))[1]
Path("two").mkdir()
for side, folder in ("lower", "weight"), ("upper", "factor"):
    Path("two", f"certificate_{side}.json").write_text(
        Path(folder, f"certificate_{side}.json").read_text())
good, text = verdict("check_folder", "two")
assert not good and "different problems" in text


def forged(folder, side, value, reason, forge):
    """Looks for the reason for which a forged file proves nothing."""
    data = json.loads(Path(folder, f"certificate_{side}.json").read_text())
    data["value"] = value
    forge(data)
    path = Path("forged.json")
    path.write_text(json.dumps(data))
    body, text = verdict("check", path)
    assert body is None and reason in text, (folder, side, text)


def detach(data, is_held):
    """Adds a small tetrahedron beside the body, without loads."""
    n = len(data["vertices"])
    data["vertices"] += [[9. + 1e-6 * (i == a) for a in range(3)] for i in range(-1, 3)]
    data["tetrahedra"].append(list(range(n, n + 4)))
    data["material"].append(0)
    rim = data["boundary"]
    for i in range(4):
        rim["face"].append([n + j for j in range(4) if j != i])
        rim["held"].append([is_held] * 3)
        rim["oblique"].append(False)
        rim["obstacle"].append(-1)
        rim["velocity"].append([0.] * 3)
    for kind in "dead", "live":
        data["body_force"][kind].append([0.] * 3)
        rim[kind] += [[[0.] * 3] * 3] * 4


def press(data):
    """No stress in the body, and a large one beside it."""
    count, nodes = len(data["tetrahedra"]), len(data["nodes"])
    detach(data, True)
    data["load_factor"] = data["value"]
    data["stress"] = [[[0.] * 6] * nodes] * count + [[[-1e20] * 3 + [0.] * 3] * nodes]


def fall(data):
    """The body falls through its supports, and something fast is beside it."""
    count, nodes = len(data["tetrahedra"]), len(data["nodes"])
    detach(data, False)
    data["strength_factor"] = data["value"]
    data["velocity"] = [[[0., -1., 0.]] * nodes] * count + [[[1e20, 0., 0.]] * nodes]


def lift(data):
    """Twice the loads are dead, so that a load factor near two leaves hardly any."""
    data["load_factor"] = 2. - 1e-4 * data["load_factor"]
    data["strength_factor"] = data["value"]
    data["stress"] = [[[1e-4 * s for s in at] for at in cell] for cell in data["stress"]]
    for of, depth in (data["body_force"], 1), (data["boundary"], 2):
        of["dead"] = scaled(of["live"], 2., depth)
        of["live"] = scaled(of["live"], -1., depth)


def scaled(values, factor, depth):
    """A factor times the numbers of nested lists."""
    return [scaled(one, factor, depth - 1) if depth else factor * one for one in values]


def factor_of_reaction(data):
    data["load_factor"] = 5.


def weight_of_reaction(data):
    data["body_force"]["live"][0][1] = -1.


forged("factor", "lower", 300., "beside dead loads", lift)
forged("reaction", "lower", 1800., "beside live loads", factor_of_reaction)
forged("reaction", "upper", 2300., "beside live loads", weight_of_reaction)
forged("weight", "lower", 1000., "not connected", press)
forged("factor", "upper", 0.1, "not connected", fall)
# Large values do not hide residuals, even if such a part were accepted.
CHECKER["check"].__globals__["is_connected"] = lambda *_: True
forged("weight", "lower", 1000., "div s + b", press)
forged("factor", "upper", 0.1, "flow at supports", fall)
PYTHON
