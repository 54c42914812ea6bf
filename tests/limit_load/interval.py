"""Compares bounds for a whole box of parameters with those of its corners and of points
within: interval.py PROGRAM ROOT. Each true answer lies in the interval, so no upper bound of a
point may be below the box's lower one, and no lower one above its upper one."""

import itertools
import json
import random
import subprocess
import sys
from pathlib import Path

program, root = sys.argv[1], Path(sys.argv[2])


def bounds_of(scene, settings):
    """The topic bounds of a run of a scene."""
    options = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([program, root / scene, "--output", "run", "--quiet", "--set",
                    "Output/If folder exists = overwrite", "--set", "Output/Pictures = false",
                    "--set", "Output/Fields = false", "--set", "Output/Expectations =",
                    "--set", "Analysis/Solver tolerance = 1e-4", *options],
                   check=True, stdout=subprocess.DEVNULL)
    return json.loads(Path("run/summary.json").read_text())["bounds"]


def settings_of(name, value, traction):
    """Lines of a parameter file for the value of one parameter."""
    owner, parameter = name.split("/")
    if parameter == "Traction factor":
        return [f"Tractions/{owner}/Traction y = {value * traction!r}"]
    lines = [f"Materials/{owner}/{parameter} = {value!r}"]
    if parameter == "Friction angle":
        lines.append(f"Materials/{owner}/Dilatancy angle = {value!r}")
    return lines


def check(scene, box, traction, loose):
    """Checks the bounds of a box at its corners and at five points. @param loose by which
    they may exceed those of the points, relative"""
    text = "; ".join(f"{name}: {low!r} .. {high!r}" for name, (low, high) in box.items())
    found = bounds_of(scene, [f"Analysis/Parameter intervals = {text}"])["interval"]
    assert found["certified"], found
    number = random.Random(57)
    points = list(itertools.product(*box.values()))
    points += [[number.uniform(*limits) for limits in box.values()] for _ in range(5)]
    bounds = [bounds_of(scene, [line for name, value in zip(box, point)
                                for line in settings_of(name, value, traction)])
              for point in points]
    for point, of_point in zip(points, bounds):
        assert found["lower"] <= of_point["upper"], (scene, found, point, of_point)
        assert found["upper"] >= of_point["lower"], (scene, found, point, of_point)
    least = min(of_point["lower"] for of_point in bounds)
    most = max(of_point["upper"] for of_point in bounds)
    assert least * (1. - loose) < found["lower"] < least * 1.002, (scene, found, least)
    assert most * 0.998 < found["upper"] < most * (1. + loose), (scene, found, most)


def check_weight(scene):
    """Checks that the factor of the weight of one soil is inversely proportional to it: the
    bounds of the interval are those of its ends."""
    found = bounds_of(scene, ["Analysis/Parameter intervals = clay/Density: 1500 .. 2500",
                              "Materials/clay/Density = 2000", "Analysis/Maximum levels = 1"])
    interval = found["interval"]
    assert abs(interval["lower"] / (found["lower"] * 2000. / 2500.) - 1.) < 5e-4, found
    assert abs(interval["upper"] / (found["upper"] * 2000. / 1500.) - 1.) < 5e-4, found


check_weight("prm/limit_load/vertical_cut.prm")
FOOTING, SLOPE = (f"tests/limit_load/gradients_{name}.prm" for name in ("footing", "slope"))
check(FOOTING, {"crust/Cohesion": (8000., 12000.), "crust/Friction angle": (18., 22.),
                "surcharge/Traction factor": (0.8, 1.2)}, -8000., 0.02)
check(FOOTING, {"sand/Friction angle": (26., 30.), "sand/Density": (1800., 2200.),
                "crust/Density": (1700., 2000.)}, -8000., 0.02)
# Weight raises the load of the footing before it lowers it.
check("tests/limit_load/interval_crest.prm", {"soil/Density": (10., 3000.)}, 0., 0.03)
check(SLOPE, {"top/Cohesion": (6000., 10000.), "base/Friction angle": (13., 17.),
              "base/Density": (1800., 2200.)}, -10000., 0.02)
