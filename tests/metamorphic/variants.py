#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""One scene, written in many ways, has one result: whatever is automatic, and each tolerance,
depends on the scene and not on its place, orientation, units or words.

    variants.py PROGRAM FOLDER SCENE [SCENE ...]

Each scene is a mesh from a file and conditions on its named sides. Its variants have the same
nodes: moved by vectors (also to map coordinates), mirrored, turned by 90 degrees, with
lengths times 1e3 and 1e-3, with forces times 1e3, with materials in another order, and,
where it is a box, as 'Box', as 'Where' and with a layer below a line; its layers are named by
number and by name. Results are compared after a change of units. Allowed is 1e-9, or what the
rounding of coordinates makes of the cells' sizes; interior-point bounds end at a tolerance of
1e-6 of the load.
"""

import json
import math
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

CELL = 0.1
BOUNDS = ("bounds", "inclined", "slope")  # scenes of strict bounds
ROUNDING = 50 * sys.float_info.epsilon  # of a coordinate, in the gradient of a cell


@dataclass(frozen=True)
class Variant:
    """A change of place, orientation, units and words."""
    name: str
    move: tuple = (0., 0.)
    turned: bool = False      # by 90 degrees, counterclockwise
    mirrored: bool = False    # x becomes -x
    length: float = 1.        # of the new units, times the old number
    force: float = 1.
    order: tuple = ("sand", "clay")
    words: str = "file"       # or names, Box, Where, below

    def vector(self, x, y):
        """The direction that a direction becomes."""
        x = -x if self.mirrored else x
        return (-y, x) if self.turned else (x, y)

    def point(self, x, y):
        """The place that a place becomes (m)."""
        x, y = self.vector(x, y)
        return self.length * (x + self.move[0]), self.length * (y + self.move[1])

    def box(self, low, high):
        """The box that a box becomes, as a parameter."""
        (x, y), (u, v) = self.point(*low), self.point(*high)
        return f"{min(x, u)!r}, {min(y, v)!r}; {max(x, u)!r}, {max(y, v)!r}"

    def tolerance(self):
        """Of results that Newton's method finds to rounding."""
        return max(1e-9, ROUNDING * math.hypot(*self.move) / CELL)


VARIANTS = [Variant("moved", move=(7., -3.)),
            Variant("on a map", move=(350000., 5000000.)),
            Variant("mirrored", mirrored=True),
            Variant("turned", turned=True),
            Variant("millimetres", length=1e3),
            Variant("kilometres", length=1e-3),
            Variant("kilonewtons", force=1e-3),
            Variant("large forces", force=1e3),
            Variant("other order", order=("clay", "sand"))]
WORDS = [Variant("names of surfaces", words="names"), Variant("box", words="Box"),
         Variant("formula", words="Where"), Variant("layer below a line", words="below")]


def top(scene, x):
    """The height of the ground (m)."""
    if scene == "footing":
        return 0.
    return 0.5 - min(max(x - 0.4, 0.), 0.4)  # a slope of 45 degrees


def write_mesh(path, ground, columns, rows, triangles, to):
    """A body from x = 0 and y = -0.6 to its ground; curves 1 bottom, 2 left, 3 right, 4 the left
    two cells of the top, 5 its rest."""
    def node(i, j):
        return j * (columns + 1) + i + 1

    def place(i, j):
        x = CELL * i
        return to.point(x, -0.6 + (0.6 + top(ground, x)) * j / rows)

    def oriented(corners):
        return corners[::-1] if to.mirrored else corners

    lines = [(1, node(i, 0), node(i + 1, 0)) for i in range(columns)]
    lines += [(2, node(0, j), node(0, j + 1)) for j in range(rows)]
    lines += [(3, node(columns, j), node(columns, j + 1)) for j in range(rows)]
    lines += [(4 if i < 2 else 5, node(i, rows), node(i + 1, rows)) for i in range(columns)]
    cells = []
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            material = 1 if j >= rows // 2 else 2
            for corners in ([(a, b, c), (a, c, d)] if triangles else [(a, b, c, d)]):
                cells.append((material, oriented(corners)))
    with open(path, "w") as file:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"sand\"\n"
              "2 2 \"clay\"\n$EndPhysicalNames\n$Nodes", file=file)
        print((columns + 1) * (rows + 1), file=file)
        for j in range(rows + 1):
            for i in range(columns + 1):
                print(node(i, j), *map(repr, place(i, j)), 0, file=file)
        print(f"$EndNodes\n$Elements\n{len(lines) + len(cells)}", file=file)
        for number, (side, *ends) in enumerate(lines):
            print(number + 1, 1, 2, side, side, *ends, file=file)
        for number, (material, corners) in enumerate(cells):
            print(len(lines) + number + 1, 2 if triangles else 3, 2, material, material,
                  *corners, file=file)
        print("$EndElements", file=file)


def section(name, values):
    """A subsection with its parameters, or with subsections."""
    inside = "".join(section(key, value) if isinstance(value, dict) else
                     f"set {key} = {value}\n" for key, value in values.items())
    return f"subsection {name}\n{inside}end\n"


def velocities(to, x, y):
    """Velocities in (m/s) of a condition; None leaves a component free."""
    size = [None if v is None else to.length * v for v in (x, y)]
    mapped = to.vector(*(0. if v is None else v for v in size))
    free = [v is None for v in size]
    if to.turned:
        free.reverse()
    return {f"Velocity {axis}": "free" if left else repr(value)
            for axis, value, left in zip("xy", mapped, free)}


def write_scene(scene, to, path):
    """The parameter file of a scene."""
    stress = to.force / to.length**2
    slope = scene == "slope"
    columns, rows = (14 if slope else 10), 6
    ground = "slope" if slope else "footing"
    bounds = scene in BOUNDS
    particles = scene in ("mpm", "explicit")  # they need a box and polygons
    box = to.words not in ("file", "names") or particles
    geometry = {"Shape": "file", "File": path.with_suffix(".msh").name}
    if box:
        geometry = {"Box": to.box((0., -0.6), (1., 0.))}
    else:
        write_mesh(path.with_suffix(".msh"), ground, columns, rows, bounds, to)
    names = ("bottom", "left", "right", "top")
    if to.mirrored:
        names = ("bottom", "right", "left", "top")
    elif to.turned:
        names = ("right", "bottom", "top", "left")
    sides = dict(zip(("bottom", "left", "right", "footing"), names if box else "1234"))
    angle = {"footing": 25, "memory": 0}.get(scene, 25)

    def soil(number, name):
        c = 2000. if name == "sand" else 3000.
        values = {"Type": "Mohr-Coulomb", "Cohesion": repr(c * stress),
                  "Friction angle": 25, "Dilatancy angle": angle,
                  "Density": repr(2000. * to.force / to.length**4),
                  "Young modulus": repr(1e7 * stress), "Poisson ratio": 0.3}
        if not box:
            values["Region number"] = name if to.words == "names" else number
        elif number == 2 and to.words == "below":  # the lower half
            x, y = to.point(0.5, -0.3)
            values["Region below"] = f"{x!r}, {y!r}"
        elif number == 2:
            corners = [to.point(x, y) for x, y in ((0., -0.6), (1., -0.6), (1., -0.3), (0., -0.3))]
            values["Region polygon"] = "; ".join(f"{x!r}, {y!r}" for x, y in corners)
        return values

    materials = {"Names": ", ".join(to.order)}
    for name in to.order:
        materials[name] = soil(1 if name == "sand" else 2, name)
    speed = 1. if bounds else 0.02
    aside = speed / 2 if scene == "inclined" else 0.
    footing = {"Sides": sides["footing"], **velocities(to, aside, -speed)}
    if to.words == "Where":
        footing["Where"] = "0.2 + 1e-12 - x"
    elif box:
        footing["Box"] = to.box((0., -0.01), (0.2, 0.01))
    conditions = {"Names": "bottom, sides" + ("" if slope else ", footing"),
                  "bottom": {"Sides": sides["bottom"], **velocities(to, 0., 0.)},
                  "sides": {"Sides": f"{sides['left']}, {sides['right']}",
                            **velocities(to, 0., None)}}
    if not slope:
        conditions["footing"] = footing
    if scene == "contact":  # the bottom lies on an obstacle
        conditions["Names"] = "sides, footing"
        del conditions["bottom"]
    down = to.vector(0., -1.)
    text = section("Geometry", geometry) + section("Materials", materials)
    text += section("Boundary conditions", conditions)
    if box:
        text += section("Mesh", {"Type": "uniform", "Cells": "quadrilaterals",
                                 "Cell size": repr(CELL * to.length)})
    if not slope:
        # The load is positive whatever the footing's direction is.
        text += section("Observation", {
            "Conditions": "footing", "Component": "x" if to.turned else "y",
            "Factor": 2 * (1 if sum(down) > 0 else -1)})
    if scene != "bounds":
        g = to.vector(0., -10. if slope or scene == "contact" else 0.)
        text += section("Gravity", {
            "Acceleration": f"{to.length * g[0]!r}, {to.length * g[1]!r}"})
    if bounds:
        return text + section("Analysis", {
            "Kind": "strength reduction" if slope else "limit load",
            "Gap tolerance": 0.9})
    method = {"mpm": "MPM", "explicit": "explicit MPM"}.get(scene, "FEM")
    text += section("Discretisation", {
        "Method": method, "Element": "Q1" if method != "FEM" else "Q2"})
    if scene == "contact":
        at, normal = to.point(0., -0.6), to.vector(0., 1.)
        text += section("Obstacles", {"Names": "floor", "floor": {
            "Shape": "half-plane", "Point": f"{at[0]!r}, {at[1]!r}",
            "Normal": f"{normal[0]!r}, {normal[1]!r}", "Friction coefficient": 0.3}})
    # Memory limits substeps to 0.01 s.
    duration = {"explicit": 0.05, "memory": 0.05}.get(scene, 0.2)
    text += section("Loading", {"Stages": "push", "push": {
        "Duration": duration, "Step size": duration / 4}})
    if method != "explicit MPM":
        text += section("Newton", {"Tolerance": 1e-13})
    return text


# Results and the powers of length and force of their units.
RESULTS = {"limit_load/last": (-1, 1), "limit_load/peak": (-1, 1),
           "friction_memory/tau_s": (0, 0), "energy/dissipation_J_per_m": (0, 1),
           "energy/plastic_dissipation_J_per_m": (0, 1), "energy/kinetic_J_per_m": (0, 1),
           "energy/elastic_J_per_m": (0, 1), "state/largest_plastic_strain": (0, 0),
           "bounds/lower": (-1, 1), "bounds/upper": (-1, 1), "safety/lower": (0, 0),
           "safety/upper": (0, 0), "contact/pressure_max_Pa": (-2, 1),
           "size/cells": (0, 0), "size/points": (0, 0)}


def results(program, scene, to, folder):
    """The results of a variant, in the units of the first."""
    name = f"{scene} {to.name}".replace(" ", "_")
    path = folder / f"{name}.prm"
    text = write_scene(scene, to, path)
    path.write_text(text + section("Output", {"Pictures": "false", "Fields": "false"}))
    run = subprocess.run([program, path.name, "--quiet", "--output", name], cwd=folder,
                         capture_output=True, text=True)
    if run.returncode != 0:
        return {}, f"exit code {run.returncode}: {run.stdout}{run.stderr}"
    summary = json.loads((folder / name / "summary.json").read_text())
    found = {}
    for key, (length, force) in RESULTS.items():
        topic, entry = key.split("/")
        value = summary.get(topic, {}).get(entry)
        # Strength reductions have the bounds of the factor under 'safety'.
        if isinstance(value, (int, float)) and not (scene == "slope" and topic == "bounds"):
            found[key] = value / (to.length**length * to.force**force)
    return found, ""


def main(program, folder, scenes):
    """Prints what differs; returns the exit code."""
    folder.mkdir(parents=True, exist_ok=True)
    wrong = 0
    for scene in scenes:
        first, problem = results(program, scene, Variant("as it is"), folder)
        if problem or len(first) < 3:
            print(f"{scene}: {problem or first}")
            return 1
        words = {"footing": WORDS, "memory": WORDS, "mpm": WORDS[2:]}.get(scene, [])
        # Materials by polygons have an order: the last one that contains a point counts.
        left_out = {"mpm": "other order", "explicit": "other order"}
        variants = [variant for variant in VARIANTS if variant.name != left_out.get(scene)]
        for variant in variants + words:
            found, problem = results(program, scene, variant, folder)
            # The interior-point method ends at 1e-8 of the load's scale.
            allowed = max(variant.tolerance(), 1e-6 if scene in BOUNDS else 0.)
            for key, value in first.items():
                if problem:
                    break
                size = max(abs(value), 1e-12)
                if key not in found:
                    problem = f"no {key}"
                elif not abs(found[key] - value) <= allowed * size:
                    problem = f"{key}: {found[key]!r} for {value!r}, allowed {allowed:.1e}"
            if problem:
                wrong += 1
                print(f"{scene}, {variant.name}: {problem}")
        print(f"{scene}: {len(variants) + len(words)} variants")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]), sys.argv[3:]))
