#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/three_cases.png of runs of prm/three/sphere.prm, thick_cylinder.prm and
square_footing.prm, in this order, with the exact stresses documented in these files, and
prints the errors of the computed ones:

    three_cases.py SPHERE CYLINDER SQUARE

Stresses are those of all integration points of the body."""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

FRONT = 1.4  # radius up to which the metal is plastic (m)
SHOWN = 250  # points that are drawn
RED, GREEN = style.COLORS[1:3]


def stresses(run):
    """Places (m) of the points, and their stresses (kPa) as matrices."""
    field = run.fields("points")
    names = [["xx", "xy", "zx"], ["xy", "yy", "yz"], ["zx", "yz", "zz"]]
    return field.points, np.array([[field.point_data[f"stress_{name}"] for name in row]
                                   for row in names]).transpose(2, 0, 1) / 1e3


def along(stress, n):
    return np.einsum("pi,pij,pj->p", n, stress, n)


def draw_stresses(axes, title, r, lines):
    """Computed stresses over the radius, and exact ones.

    @param lines of (name, computed, function of the radius, colour)"""
    fine = np.linspace(1., 2., 401)
    some = np.random.default_rng(1).permutation(len(r))[:SHOWN]
    errors = []
    for name, computed, exact, color in lines:
        axes.plot(r[some], computed[some], "o", color=color, markersize=3,
                  label=f"computed, {name}")
        axes.plot(fine, exact(fine), "k--", linewidth=1.2)
        errors.append(f"{name} {1e3 * np.sqrt(np.mean((computed - exact(r))**2)):.1f} Pa")
    axes.plot([], [], "k--", linewidth=1.2, label="exact (Hill)")
    axes.axvline(FRONT, color=style.GREY, linewidth=1.)
    low, high = axes.get_ylim()
    axes.set(title=title, xlabel="r (m)", ylabel="stress (kPa)", xlim=(1., 2.),
             ylim=(low, high + 0.42 * (high - low)))
    for x, side, name in ((FRONT - 0.015, "right", "plastic"),
                          (FRONT + 0.015, "left", "elastic")):
        axes.text(x, low + 0.03 * (high - low), name, ha=side, color="#505050")
    axes.legend(loc="upper right", ncols=2, fontsize=9)
    print(f"{title}: root mean square errors of stresses: {', '.join(errors)}")


def draw_sphere(axes, run):
    points, stress = stresses(run)
    r = np.linalg.norm(points, axis=1)
    radial = along(stress, points / r[:, None])
    hoop = (np.trace(stress, axis1=1, axis2=2) - radial) / 2.

    def exact_hoop(x):
        return np.where(x > FRONT, 0.45733333 * (1. + 4. / x**3),
                        -2.221888946 + 2. * (1. + 2. * np.log(x)))

    def exact_radial(x):
        return exact_hoop(x) - np.where(x > FRONT, 5.488 / x**3, 2.)

    draw_stresses(axes, "sphere", r, [("hoop", hoop, exact_hoop, RED),
                                      ("radial", radial, exact_radial, style.BLUE)])


def draw_cylinder(axes, run):
    points, stress = stresses(run)
    r = np.hypot(points[:, 0], points[:, 2])
    n = points * [1., 0., 1.] / r[:, None]
    t = n[:, [2, 1, 0]] * [-1., 0., 1.]

    def exact_radial(x):
        return np.where(x > FRONT, 0.49 - 1.96 / x**2, -1.182944473 + 2. * np.log(x))

    def difference(x):
        return np.where(x > FRONT, 3.92 / x**2, 2.)

    draw_stresses(axes, "thick_cylinder", r, [
        ("hoop", along(stress, t), lambda x: exact_radial(x) + difference(x), RED),
        ("axial", stress[:, 1, 1], lambda x: 0.6 * exact_radial(x) + 0.3 * difference(x), GREEN),
        ("radial", along(stress, n), exact_radial, style.BLUE)])


def draw_square(axes, run):
    c, width = float(run.parameters["Materials/soil/Cohesion"]), 0.2
    table = run.statistics
    s, q = 1e3 * np.abs(table["displacement (m)"]), table["load (N)"] / (c * width**2)
    axes.semilogx(s, q, "o-", color=style.BLUE, markersize=4, label="computed, a point per step")
    axes.axhline(5.91, color="black", linestyle="--", linewidth=1.2,
                 label="Gourvenec et al. (2006), 5.91")
    for i, (x, y, n) in enumerate(zip(s, q, table["iterations (-)"])):
        up = i % 2 == len(s) % 2 and x > 0.1  # steps on the plateau are close together
        axes.annotate(f"{n:.0f}", (x, y), (0, 7 if up else -16), textcoords="offset points",
                      ha="center", fontsize=9, color="#505050")
    axes.plot([], [], " ", label="numbers: iterations of the step")
    axes.set(title="square_footing", xlabel="settlement (mm)",
             ylabel="load over c B$^2$", ylim=(0., 6.6))
    axes.legend(loc="lower right", fontsize=9)
    print(f"square_footing: {q[-1]:.3f} c B^2")


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    figure = Figure(figsize=(13., 4.), layout="constrained")
    for axes, draw, folder in zip(figure.subplots(1, 3),
                                  (draw_sphere, draw_cylinder, draw_square), sys.argv[1:]):
        draw(axes, geocone.read(folder))
    figure.savefig(ROOT / "doc" / "cookbook" / "three_cases.png", dpi=85)


if __name__ == "__main__":
    main()
