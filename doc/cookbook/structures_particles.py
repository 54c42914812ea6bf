#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/structures_particles.png: loads and moments of the wall of
prm/structures/wall_fails.prm by finite elements and by particles, and the strict bounds:

    structures_particles.py FEM MPM BOUNDS      # folders of runs"""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402


def column(table, words):
    """The column whose name begins with some words."""
    return next(values for name, values in table.items() if name.startswith(words))


def main(fem, mpm, bounds):
    """Draws the picture of three runs."""
    figure, axes = style.subplots(1, 2, figsize=(9., 3.8))
    enclosed = geocone.Run(bounds).summary["bounds"]
    axes[0].axhspan(enclosed["lower"] / 1e3, enclosed["upper"] / 1e3, color="0.8",
                    label="strict bounds")
    for name, folder, color in (("finite elements", fem, style.COLORS[0]),
                                ("particles", mpm, style.COLORS[1])):
        run = geocone.Run(folder)
        steps = run.table("statistics")
        axes[0].plot(1e3 * column(steps, "displacement"), column(steps, "load") / 1e3,
                     color=color, label=name)
        plates = run.table("plates")
        last = plates["time (s)"] == plates["time (s)"].max()
        axes[1].plot(plates["bending moment (N m/m)"][last] / 1e3, plates["y (m)"][last],
                     color=color, label=name)
        print(name, np.max(column(steps, "load")))
    axes[0].set(xlabel="settlement of the strip (mm)", ylabel="load (kN/m)", xlim=(0., None),
                ylim=(0., None))
    axes[1].set(xlabel="bending moment at the end (kN m/m)", ylabel="y (m)")
    axes[0].legend(fontsize=8)
    figure.savefig(ROOT / "doc/cookbook/structures_particles.png", dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
