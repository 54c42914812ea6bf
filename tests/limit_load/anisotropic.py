"""Compares bounds with strengths by direction with exact loads of footings and with one another,
and lets their files be proved: anisotropic.py PROGRAM ROOT."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np

program, root = sys.argv[1], Path(sys.argv[2])
ONE = 1. + 1e-12
CLAY = {"Friction angle": 0., "Dilatancy angle": 0.}


def strengths(active, passive, shear, angle=0.):
    """Settings of the soil of the footing; strengths in Pa."""
    return {**CLAY, "Cohesion": active, "Passive strength ratio": passive / active,
            "Simple shear strength ratio": shear / active, "Anisotropy angle": angle}


def run(name, settings, levels=4, *others, scene="prm/limit_load/footing_rough.prm",
        material="soil"):
    """The topic bounds of a run with settings of its soil, and with files of its proofs."""
    options = [f"Materials/{material}/{key} = {value!r}"
               for key, value in settings.items()] + [
        f"Analysis/Maximum levels = {levels}", "Output/If folder exists = overwrite",
        "Output/Pictures = false", "Output/Fields = false", "Output/Expectations =",
        "Output/Certificates = true", *others]
    words = [word for one in options for word in ("--set", one)]
    subprocess.run([program, root / scene, "--output", name, "--quiet", *words], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads(Path(name, "summary.json").read_text())["bounds"]


def prove(*names, good=True):
    """Lets the files of runs be proved."""
    done = subprocess.run([root / "scripts/check_certificate", *names], check=False,
                          capture_output=True, text=True)
    assert (done.returncode == 0) == good, done.stdout + done.stderr


def footing_load(active, passive, shear, width=0.2, n=4000):
    """Exact load: between passive failure beside the footing and active failure below it, the
    mean stress grows by the length of half of the ellipse (Booker and Davis 1972)."""
    a, t = (active + passive) / 2., (np.arange(n) + 0.5) * np.pi / n
    arc = np.pi * np.hypot(a * np.sin(t), shear * np.cos(t)).mean()
    return width * (active + passive + arc)


# The limit of equal strengths, computed by the ellipse.
tresca = run("tresca", {**CLAY, "Cohesion": 10000.})
for angle in 0., 25.:
    same = run("same", strengths(10000., 10000., 10000. * ONE, angle))
    assert same["iterations_max"] == tresca["iterations_max"], (same, tresca)
    for side in "lower", "upper":
        assert abs(same[side] / tresca[side] - 1.) < 1e-7, (side, same, tresca)

# Exact loads, among them a circle off zero, and shear that is stronger than compression.
for case in (10000., 4000., 6500.), (10000., 6000., 8000.), (5000., 10000., 9000.), \
            (10000., 4000., 3500.):
    found, exact = run("footing", strengths(*case)), footing_load(*case)
    assert found["lower"] <= exact <= found["upper"], (case, found, exact)
    assert found["gap"] <= 0.03, (case, found)
    assert abs((found["lower"] + found["upper"]) / 2. / exact - 1.) < 0.01, (case, found, exact)
    prove("footing")

# Stresses that had to be scaled into an ellipse whose passive strength is the larger one.
run("flexible", {"Passive strength ratio": 50, "Simple shear strength ratio": 0.005}, 1,
    "Mesh/Cell size = 1", "Analysis/Solver tolerance = 1e-3",
    scene="prm/limit_load/strip_flexible.prm")
prove("flexible")

# Axes that are turned: active along the horizontal. Optima of one mesh are found to 1e-6.
straight = run("straight", strengths(*case), 1, "Analysis/Solver tolerance = 1e-6")
turned = run("turned", strengths(4000., 10000., 3500., 90.), 1, "Analysis/Solver tolerance = 1e-6")
for side in "lower", "upper":
    assert abs(turned[side] / straight[side] - 1.) < 1e-4, (side, turned, straight)
prove("turned")

# A slope with strengths that grow, under strength reduction.
SOFT = {"Passive strength ratio": 0.5, "Simple shear strength ratio": 0.7,
        "Anisotropy angle": 10., "Cohesion gradient": 1000.}
assert run("slope", SOFT, 2, scene="prm/safety/slope_clay.prm", material="clay")["certified"]
prove("slope")

# Gradients of a factor of the weight by strengths and ratios are differences on one mesh.
def cut(**settings):
    """The bounds of a vertical cut."""
    return run("cut", {**SOFT, "Cohesion": 10000., **settings}, 1,
               "Analysis/Solver tolerance = 1e-6", scene="prm/limit_load/vertical_cut.prm",
               material="clay")


gradients = cut()["gradients"]["materials"]["clay"]
for name in "Cohesion", "Cohesion gradient", "Passive strength ratio", \
            "Simple shear strength ratio":
    gradient = gradients[name.lower().replace(" ", "_")]
    less, more = (cut(**{name: part * gradient["value"]}) for part in (0.98, 1.02))
    for side in "lower", "upper":
        slope = (more[side] - less[side]) / (0.04 * gradient["value"])
        assert abs(gradient[side] / slope - 1.) < 0.01, (name, side, gradient, slope)

# Files with other strengths prove nothing.
for key, side, factor in (("passive_ratio", "lower", 0.9), ("simple_shear_ratio", "lower", 0.9),
                          ("passive_ratio", "upper", 1.1), ("anisotropy_angle", "upper", 0.9)):
    path = Path("turned", f"certificate_{side}.json")
    kept = path.read_text()
    data = json.loads(kept)
    data["materials"][0][key] *= factor
    path.write_text(json.dumps(data))
    prove("turned", good=False)
    path.write_text(kept)
# Nor does a file in which another material, which comes first, has no such strengths.
data["materials"] = [{key: value for key, value in json.loads(kept)["materials"][0].items()
                      if "anisotropy" not in key and "_ratio" not in key},
                     json.loads(kept)["materials"][0]]
data["material"] = [1] * len(data["material"])
path.write_text(json.dumps(data))
prove("turned", good=False)
path.write_text(kept)
prove("turned")
