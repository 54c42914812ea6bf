"""The checker proves the bounds of five runs, and finds changes of their files and forgeries."""

import json
import types
from pathlib import Path

import numpy as np

from verdict import CHECKER, verdict

for folder in "reaction", "weight", "factor", "obstacles", "rigid":
    good, text = verdict("check_folder", folder)
    assert good and text.count(" proved for ") == 2

rigid = json.loads(Path("rigid", "certificate_upper.json").read_text())
assert 6000. <= rigid["value"] < 6060.  # weight times friction is exact

SPEED = 1. + 9e-6


def changed(folder, side, *changes):
    """The file of a bound with changes (place in the file, function of its value)."""
    content = json.loads(Path(folder, f"certificate_{side}.json").read_text())
    for place, change in changes:
        data = content
        for key in place[:-1]:
            data = data[key]
        data[place[-1]] = change(data[place[-1]])
    return content


def times(factor):
    """A change of a value by a factor."""
    return lambda value: value * factor


def to(value):
    """A change to another value."""
    return lambda _: value


# Changed values: folder, side, reason, changes.
CHANGES = (
    ("reaction", "lower", "tractions", (("stress", 3, 1, 0), times(1.0001))),
    ("reaction", "lower", "only", (("materials", 0, "cohesion"), times(0.9))),
    ("reaction", "upper", "only", (("value",), times(0.999))),
    ("reaction", "lower", "strength factor", (("strength_factor",), to(0.5))),
    ("reaction", "lower", "stated magnitude",
     (("speed",), times(1. / SPEED)), (("value",), times(SPEED))),
    ("reaction", "lower", "cohesion is not finite", (("materials", 0, "cohesion"), to(None))),
    ("reaction", "upper", "cohesion is not finite", (("materials", 0, "cohesion"), to(None))),
    ("reaction", "lower", "bound is not finite", (("multiple",), to(float("inf")))),
    ("reaction", "upper", "friction_angle is negative",
     (("materials", 0, "friction_angle"), to(-1.))),
    ("reaction", "lower", "number of a part", (("material", 0), to(-1))),
    ("reaction", "lower", "neither", (("bound",), to("both"))),
    ("reaction", "lower", "same side",
     (("vertices",), to([[0., 0.], [1., 0.], [0., 1.], [0.2, 0.5]])),
     (("triangles",), to([[0, 1, 2], [0, 1, 3]])),
     (("edges",), to([[0, 1], [0, 2], [1, 2], [0, 3], [1, 3]]))),
    ("weight", "lower", "div s + b", (("body_force", "live", 5, 1), times(1.0001))),
    ("weight", "upper", "only", (("materials", 0, "tensile_strength"), times(2.))),
    ("weight", "lower", "tensile_strength is negative",
     (("materials", 0, "tensile_strength"), to(-1.))),
    ("weight", "upper", "90 degrees", (("materials", 0, "friction_angle"), to(90.))),
    ("reaction", "lower", "beside live loads", (("load_factor",), to(5.))),
    ("reaction", "upper", "beside live loads", (("body_force", "live", 0, 1), to(-1.))),
    ("factor", "lower", "load factor", (("strength_factor",), times(1.1))),
    ("factor", "upper", "flow rule", (("strength_factor",), times(0.9))),
    ("factor", "lower", "only", (("value",), to(5.))),
    ("factor", "upper", "only", (("value",), to(0.3))),
    ("factor", "lower", "stated magnitude", (("speed",), to(1.))),
    ("obstacles", "lower", "strength", (("obstacles", 0, "friction"), times(0.5))),
    ("obstacles", "lower", "tractions", (("interfaces", "traction", 0, 0, 1), times(1.0001))),
    ("obstacles", "upper", "flow of interfaces", (("obstacles", 0, "friction"), times(4.))),
    ("obstacles", "upper", "listed twice",
     (("interfaces",), lambda faces: {key: [*part, part[0]] for key, part in faces.items()})),
)
for folder, side, reason, *changes in CHANGES:
    name = Path("changed.json")
    name.write_text(json.dumps(changed(folder, side, *changes)))
    body, text = verdict("check", name)
    assert body is None and reason in text.partition("NOT PROVED")[2], (changes, text)


def refused(lower, upper, reason):
    """Looks for the reason for which two proved bounds are not a bracket."""
    other = Path("other")
    other.mkdir(exist_ok=True)
    for side, content in ("lower", lower), ("upper", upper):
        (other / f"certificate_{side}.json").write_text(json.dumps(content))
    good, text = verdict("check_folder", other)
    assert not good and text.count(" proved for ") == 2 and reason in text, text


# Proved bounds of different problems: others, moved, with other parts.
DIFFERENT = "different problems"
refused(changed("reaction", "lower"), changed("weight", "upper"), DIFFERENT)
refused(changed("reaction", "lower"), changed(
    "reaction", "upper", (("vertices",), lambda x: [[a + 1e-6, b] for a, b in x])), DIFFERENT)
TWICE = ("materials",), lambda laws: [*laws, laws[0]]
refused(changed("weight", "lower", TWICE),
        changed("weight", "upper", TWICE, (("material", 0), to(1))), DIFFERENT)
refused(changed("obstacles", "lower"),
        changed("obstacles", "upper", (("obstacles", 0, "centre", 0), to(1.))), DIFFERENT)
AGAIN = ("obstacles",), lambda laws: [*laws, laws[0]]
refused(changed("obstacles", "lower", AGAIN), changed(
    "obstacles", "upper", AGAIN, (("interfaces", "obstacle", 0), to(2)),
    (("velocity", "obstacles"), lambda motion: [*motion, motion[0]])), DIFFERENT)
# A support more, of an edge without a traction.
refused(changed("weight", "lower", (("boundary", "held"), lambda held: [
    [True, True] if i == held.index([False, False]) else one for i, one in enumerate(held)])),
        changed("weight", "upper"), DIFFERENT)
# Weight moved between two triangles, at the same total.
data = changed("weight", "upper", (("value",), times(2.)))
A, live = CHECKER["Body"](data).A, data["body_force"]["live"]
live[0][1] *= 0.9
live[1][1] *= 1. + 0.1 * A[0] / A[1]
refused(changed("weight", "lower"), data, DIFFERENT)
# One millionth of a small quantity is not rounding.
SMALL = ("obstacles", 0, "adhesion")
refused(changed("obstacles", "lower"), changed("obstacles", "upper", (SMALL, to(1e-7))), DIFFERENT)
lower = changed("reaction", "lower")
refused(lower, lower, "not a lower and an upper bound")


def forged(data, value, reason):
    """Looks for the reason for which a forged file proves nothing."""
    data["value"] = value
    name = Path("forged.json")
    name.write_text(json.dumps(data))
    body, text = verdict("check", name)
    assert body is None and reason in text.partition("NOT PROVED")[2], text


def detached(folder, side, is_held):
    """The file of a bound with a small triangle beside the body, without loads."""
    data = changed(folder, side)
    n, m = len(data["vertices"]), len(data["edges"])
    data["vertices"] += [[99., 99.], [99. + 1e-6, 99.], [99., 99. + 1e-6]]
    data["triangles"].append([n, n + 1, n + 2])
    data["edges"] += [[n, n + 1], [n, n + 2], [n + 1, n + 2]]
    data["material"].append(0)
    rim = data["boundary"]
    rim["edge"] += [m, m + 1, m + 2]
    rim["held"] += [[is_held] * 2] * 3
    rim["velocity"] += [[0., 0.]] * 3
    for kind in "dead", "live":
        data["body_force"][kind].append([0., 0.])
        rim[kind] += [[[0., 0.]] * 2] * 3
    return data


# No stress in the body, and a large one beside it.
pressed = detached("weight", "lower", True)
pressed["stress"] = [[[0.] * 3] * 3 for _ in pressed["stress"]] + [[[-1e20, -1e20, 0.]] * 3]
pressed["load_factor"] = 1000.
# The body falls through its supports, and something fast is beside it.
fallen = detached("factor", "upper", False)
for part in "vertices", "middles":
    fallen["velocity"][part] = [[0., -1.] for _ in fallen["velocity"][part]] + [[1e20, 0.]] * 3
fallen["strength_factor"] = 0.1
# Twice the loads are dead, so that a load factor near two leaves hardly any.
lifted = changed("factor", "lower", (("load_factor",), lambda factor: 2. - 1e-4 * factor))
lifted["stress"] = (1e-4 * np.array(lifted["stress"])).tolist()
for loads in lifted["body_force"], lifted["boundary"]:
    live = np.array(loads["live"])
    loads["dead"], loads["live"] = (2. * live).tolist(), (-live).tolist()
lifted["strength_factor"] = 300.
forged(lifted, 300., "beside dead loads")
forged(pressed, 1000., "not connected")
forged(fallen, 0.1, "not connected")
# Large values do not hide residuals, even if such a part were accepted.
GLOBALS = CHECKER["check"].__globals__
GLOBALS["is_connected"] = lambda *_: True
forged(pressed, 1000., "div s + b")
forged(fallen, 0.1, "prescribed velocities")

# The largest of several residuals is printed.
found = types.SimpleNamespace(residuals={})
for residual in 1e-12, 1e-13:
    CHECKER["Body"].vanishes(found, "flow", np.array([residual]), 1.)
assert found.residuals["flow"] == 1e-12

# Bounds that contradict each other, from a wrong formula.
GLOBALS["upper_bound"] = lambda body: 1.
good, text = verdict("check_folder", "reaction")
assert not good and "the lower bound is above the upper one" in text
