#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/contact_round.png of runs of prm/axisymmetric/hertz.prm and
prm/three/incline.prm, in this order, with the exact solutions documented in these files, and
prints the errors of the computed values:

    contact_round.py HERTZ INCLINE

The pressure is the stress of the integration points next to the surface."""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

A, P0 = 0.1, 47.746483  # radius (m) and greatest pressure (MPa) of Hertz


def draw_pressure(axes, run):
    field = run.fields("points")
    r, y = field.points[:, 0], field.points[:, 1]
    cell = float(run.parameters["Mesh/Smallest size"])
    near = (y > -0.2 * cell) & (r < 1.6 * A)
    r, p = r[near], -field.point_data["stress_yy"][near] / 1e6
    fine = np.linspace(0., 1.6 * A, 400)
    axes.plot(1e3 * fine, P0 * np.sqrt(np.maximum(1. - (fine / A)**2, 0.)), "k--",
              label="exact (Hertz)")
    axes.plot(1e3 * r, p, "o", color=style.BLUE, markersize=3, label="computed")
    axes.set(title="a ball on a half-space", xlabel="r (mm)", ylabel="pressure (MPa)",
             xlim=(0., 160.), ylim=(0., None))
    axes.legend()
    inside = r < 0.9 * A
    error = p[inside] - P0 * np.sqrt(1. - (r[inside] / A)**2)
    print(f"hertz: pressure within 0.9 a: root mean square error "
          f"{100. * np.sqrt(np.mean(error**2)) / P0:.2f} % of the greatest; radius "
          f"{1e3 * np.sqrt(run.value('contact/area_m2') / np.pi):.1f} mm")


def draw_incline(axes, run):
    t = run.statistics["time (s)"]
    x, z = (1e3 * run.statistics[f"displacement of point 1 {c} (m)"] for c in "xz")
    fine = np.linspace(0., t[-1], 100)
    for way, part, color, name in ((x, 0.6, style.BLUE, "x"), (z, 0.8, style.ORANGE, "z")):
        axes.plot(fine, part * 1e3 * 2.356287 * fine**2 / 2., "k--",
                  label="exact" if name == "x" else None)
        axes.plot(t[::5], way[::5], "o", color=color, markersize=4, label=f"computed, {name}")
    axes.set(title="a block on an incline, across the mesh", xlabel="t (s)",
             ylabel="displacement (mm)", xlim=(0., None), ylim=(0., None))
    axes.legend()
    n = len(t)
    print(f"incline: {x[-1] / (0.6 * 1e3 * 2.356287 / 8. * (1. + 1. / n)) - 1.:+.1e} of the way of "
          f"backward Euler along x, {z[-1] / x[-1] * 0.75 - 1.:+.1e} in the direction")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    figure = Figure(figsize=(10.4, 3.8), layout="constrained")
    for axes, draw, folder in zip(figure.subplots(1, 2), (draw_pressure, draw_incline),
                                  sys.argv[1:]):
        draw(axes, geocone.read(folder))
    figure.savefig(ROOT / "doc" / "cookbook" / "contact_round.png", dpi=95)


if __name__ == "__main__":
    main()
