#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/contact_more.png of runs of prm/contact/patch.prm, silo.prm (one or more) and
raft_fem_mpm.prm, in this order:

    contact_more.py PATCH SILO [SILO ...] RAFT

The pressures of the silo are those of the integration points next to the wall, beside
sigma_x = gamma b/mu (1 - exp(-mu K y/b)), K = nu/(1 - nu) (Janssen 1895)."""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402


def draw_patch(axes, run):
    field = run.fields("cells")
    corners = field.points[field.cells[0].data]
    pressure = -field.point_data["stress_yy"].ravel()[field.cells[0].data].mean(axis=1)
    print(f"patch: pressures of cells from {pressure.min():.9g} to {pressure.max():.9g} Pa")
    axes.add_collection(PolyCollection(corners[:, :, :2], facecolors="#dcecf7",
                                       edgecolors=style.BLUE, linewidths=1.))
    axes.set(aspect="equal", xlabel="x (m)", ylabel="y (m)",
             title="patch: 1 MPa in all cells")
    axes.autoscale()


def draw_silo(axes, runs):
    depth = np.linspace(0., 15., 300)
    for run, color in zip(runs, style.COLORS):
        nu = float(run.parameters["Materials/grain/Poisson ratio"])
        exact = 16. * (1. - np.exp(-0.5 * nu / (1. - nu) * depth / 0.5))
        axes.plot(exact, depth, "--", color=color)
        field = run.fields("points")
        x, y = field.points[:, 0], field.points[:, 1]
        near = x > x.max() - 1e-6
        order = np.argsort(y[near])[::5]
        p = -field.point_data["stress_xx"].ravel()[near][order] / 1e3
        axes.plot(p, -y[near][order], "o", color=color, markersize=3, label=f"$\\nu$ = {nu:g}")
        d = -y[near][order]
        inside = (d > 2.) & (d < 12.)
        off = p[inside] - 16. * (1. - np.exp(-0.5 * nu / (1. - nu) * d[inside] / 0.5))
        print(f"silo, nu = {nu:g}: from 2 to 12 m at most {np.abs(off).max() / 16.:.2%} of 16 kPa off")
    axes.plot([], [], "k--", label="Janssen")
    axes.set(xlabel="pressure on the wall (kPa)", ylabel="depth (m)", xlim=(0., 20.),
             ylim=(15., 0.), title="silo")
    axes.legend(loc="lower left")


def draw_raft(axes, figure, run):
    field = run.fields("points")
    drawn = axes.scatter(field.points[:, 0], field.points[:, 1], s=1.2,
                         c=-1e3 * field.point_data["displacement"][:, 1], cmap=style.STEPS,
                         linewidths=0.)
    axes.plot([0., 0.5, 0.5], [0., 0., 0.1], "w", linewidth=1.2)
    axes.set(aspect="equal", xlabel="x (m)", ylabel="y (m)", title="raft_fem_mpm")
    figure.colorbar(drawn, ax=axes, label="settlement (mm)", shrink=0.7)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    runs = [geocone.read(folder) for folder in sys.argv[1:]]
    figure = Figure(figsize=(11.2, 3.9), layout="constrained")
    patch, silo, raft = figure.subplots(1, 3, width_ratios=(1., 1., 1.6))
    draw_patch(patch, runs[0])
    draw_silo(silo, runs[1:-1])
    draw_raft(raft, figure, runs[-1])
    figure.savefig(ROOT / "doc" / "cookbook" / "contact_more.png", dpi=95)


if __name__ == "__main__":
    main()
