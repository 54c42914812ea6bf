"""Compares the gradients of certified bounds with central differences along one direction,
in which all parameters strengthen the body, so that no error is hidden by another:
gradients.py PROGRAM ROOT."""

import json
import math
import subprocess
import sys
from pathlib import Path

program, root = sys.argv[1], Path(sys.argv[2])
STEP = 0.02
NAMES = {"cohesion": "Cohesion", "cohesion_gradient": "Cohesion gradient",
         "tensile_strength": "Tensile strength",
         "unit_weight": "Density", "traction": "Traction y"}
LISTS = {"materials": "Materials", "tractions": "Tractions"}
STRENGTHS = "cohesion", "cohesion_gradient", "tensile_strength", "adhesion"


def bounds_of(scene, settings):
    """The topic bounds of a run of a scene."""
    options = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([program, root / scene, "--output", "run", "--quiet", "--set",
                    "Output/If folder exists = overwrite", "--set", "Output/Pictures = false",
                    "--set", "Output/Fields = false", "--set", "Output/Expectations =",
                    *options], check=True, stdout=subprocess.DEVNULL)
    return json.loads(Path("run/summary.json").read_text())["bounds"]


def gradients_of(bounds):
    """The gradients: list, name, parameter and numbers."""
    return [(kind, name, parameter, numbers)
            for kind, names in bounds["gradients"].items()
            for name, parameters in names.items() for parameter, numbers in parameters.items()]


def check_sums(bounds, of_loads, reduced=False):
    """Checks the sums of elasticities: of cohesions and loads, and of reduced strengths."""
    for side in "elasticity_lower", "elasticity_upper":
        found = gradients_of(bounds)
        homogeneous = sum(numbers[side] for _, _, parameter, numbers in found
                          if parameter not in ("friction_angle", "friction_coefficient") and
                          not parameter.endswith("_ratio"))
        assert abs(homogeneous - of_loads) < 1e-6, (side, homogeneous)
        if reduced:
            strength = sum(numbers[side] for kind, _, parameter, numbers in found
                           if kind == "materials" and parameter != "unit_weight" and
                           not parameter.endswith("_ratio"))
            assert abs(strength - 1.) < 1e-6, (side, strength)


def settings_of(found, step):
    """The parameters changed by a relative step: strengths grow, loads are as given by the
    sign of their elasticity, so that all changes raise the bound."""
    for kind, name, parameter, numbers in found:
        by = 1. + math.copysign(step, step * numbers["elasticity_upper"])
        place, value = f"{LISTS[kind]}/{name}", numbers["value"]
        if parameter == "friction_angle":
            angle = math.degrees(math.atan(by * math.tan(math.radians(value))))
            yield f"{place}/Friction angle = {angle!r}"
            yield f"{place}/Dilatancy angle = {angle!r}"
        else:
            unit = {"unit_weight": 1. / 9.81, "traction": -1.}.get(parameter, 1.)
            yield f"{place}/{NAMES[parameter]} = {by * unit * value!r}"


def check_differences(scene, of_loads, reduced=False):
    """Compares predicted and computed changes of both bounds."""
    base = bounds_of(scene, ())
    check_sums(base, of_loads, reduced)
    found = gradients_of(base)
    more, less = (bounds_of(scene, settings_of(found, step)) for step in (STEP, -STEP))
    for side in "lower", "upper":
        change = math.log(more[side] / less[side]) / math.log((1. + STEP) / (1. - STEP))
        predicted = sum(math.copysign(numbers[f"elasticity_{side}"],
                                      numbers[f"elasticity_{side}"] *
                                      numbers["elasticity_upper"])
                        for *_, numbers in found)
        assert abs(predicted / change - 1.) < 0.01, (scene, side, predicted, change)


check_differences("tests/limit_load/gradients_footing.prm", of_loads=1.)
check_differences("tests/limit_load/gradients_slope.prm", of_loads=0., reduced=True)
check_differences("tests/limit_load/gradients_disc.prm", of_loads=1.)
check_differences("tests/limit_load/gradients_cone.prm", of_loads=0., reduced=True)
check_sums(bounds_of("tests/limit_load/axisymmetric_water-01.prm", ()), of_loads=1.)
check_sums(bounds_of("prm/safety/slope_crust.prm", ["Analysis/Maximum levels = 1"]), 0., True)
check_sums(bounds_of("prm/limit_load/footing_anisotropic.prm", ["Analysis/Maximum levels = 1"]), 1.)
check_sums(bounds_of("prm/safety/slope_clay.prm", [
    "Analysis/Maximum levels = 1", "Materials/clay/Passive strength ratio = 0.5",
    "Materials/clay/Cohesion gradient = 1000"]), 0., True)
for other, of_loads, reduced in (("wall_passive", 1., False), ("../safety/slope_water", 0., True),
                                 ("../safety/cut_growing_strength", 0., True)):
    check_sums(bounds_of(f"prm/limit_load/{other}.prm", ["Analysis/Maximum levels = 1"]),
               of_loads, reduced)
