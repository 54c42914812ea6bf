#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/sheet_pile_crow.png: moments and horizontal displacements of a run of
prm/structures/crow.prm, and those of the finite elements of the benchmark, and prints their
largest values:

    sheet_pile_crow.py RUN KRATOS

KRATOS is a clone of Kratos Multiphysics (github.com/KratosMultiphysics/Kratos), or a folder with
the tables of applications/GeoMechanicsApplication/tests/crow_validation."""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402

TABLES = "applications/GeoMechanicsApplication/tests/crow_validation/" \
    "mohr_coulomb_clay-sand/staged_construction"
STAGES = [("wall and surcharge", 2., "3_Wall_installation"),
          ("first lift, -2 m", 3., "4_First_excavation"),
          ("second lift, -5 m", 5., "6_Second_excavation"),
          ("third lift, -8 m", 6., "7_Third_excavation")]


def reference_of(folder, name, before):
    """Level (m), moment (kN m/m) and displacement (mm) of a stage. The table of the first lift
    has the displacement of that stage alone."""
    table = np.loadtxt(folder / f"{name}__FE_comparison_wall.csv", delimiter=",")
    if table.shape[1] == 5:
        return table[:, 0], table[:, 1], table[:, 3] + np.interp(-table[:, 0], -before[0],
                                                                 before[2])
    return table[:, 0], table[:, 1], table[:, 4]


def main(run, kratos):
    """Draws the picture of a run."""
    folder = pathlib.Path(kratos)
    folder = folder / TABLES if (folder / TABLES).is_dir() else folder
    table = geocone.Run(run).table("plates")
    figure, axes = style.subplots(1, 2, figsize=(9., 4.4), sharey=True)
    reference = None
    for color, (stage, time, name) in zip(style.COLORS, STAGES):
        lines = np.abs(table["time (s)"] - time) < 1e-6
        y = table["y (m)"][lines]
        own = (-table["bending moment (N m/m)"][lines] / 1e3,
               table["displacement x (m)"][lines] * 1e3)
        reference = reference_of(folder, name, reference)
        print(f"{stage:20s}" + "".join(
            f"{np.abs(a).max():9.2f}{np.abs(b).max():9.2f}"
            f"{100. * (np.abs(a).max() / np.abs(b).max() - 1.):7.1f} %"
            for a, b in zip(own, reference[1:])))
        for one, values, other in zip(axes, own, reference[1:]):
            one.plot(values, y, color=color, label=stage)
            one.plot(other, reference[0], "o", color=color, markersize=4., markerfacecolor="none")
    axes[0].plot([], [], "ko", markersize=4., markerfacecolor="none", label="reference")
    axes[0].set(xlabel="bending moment (kN m/m)", ylabel="y (m)")
    axes[1].set(xlabel="horizontal displacement (mm)")
    axes[0].legend(fontsize=8, loc="lower left")
    figure.savefig(ROOT / "doc/cookbook/sheet_pile_crow.png", dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
