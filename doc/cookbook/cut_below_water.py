#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/cut_below_water.png of three runs of prm/consolidation/cut_below_water.prm
with falling permeability, and prints when the crest has moved by 0.2 m:

    cut_below_water.py RUN RUN RUN"""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402

PICTURE = ROOT / "doc/cookbook/cut_below_water.png"


def permeability(run):
    return float(run.parameters["Materials/clay/Permeability"])


def draw_points(axes, run):
    """The points at the end, coloured by their excess pore pressure."""
    field, = run._states("points")
    pressure = field.data["excess_pore_pressure"][:, 0] / 1e3
    axes.set(xlim=(4., 20.), ylim=(0., 6.6), aspect="equal", xlabel="x (m)", ylabel="y (m)")
    axes.grid(False)
    drawn = axes.add_collection(style.disks(axes, field, pressure))
    drawn.set(cmap="RdBu_r", clim=(-12., 12.))
    axes.plot([4., 8., 12., 20.], [6., 6., 2., 2.], color=style.ORANGE, linewidth=1.)
    axes.set_title(f"k = {permeability(run):g} m/s, after {field.time:.0f} s")
    style.add_bar(axes, drawn, "excess pore pressure (kPa)", extend="both")


def draw(runs):
    figure, axes = style.subplots(2, 2, figsize=(12., 6.6))
    for ax, run in zip(axes.flat, runs):
        draw_points(ax, run)
    curves = axes.flat[3]
    for run, color in zip(runs, style.COLORS):
        table = run.statistics
        t, moved = table["time (s)"], np.hypot(*(
            table[f"displacement of point 1 {c} (m)"] for c in "xy"))
        curves.plot(t, moved, color=color, label=f"k = {permeability(run):g} m/s")
        late = np.flatnonzero(moved > 0.2)
        print(f"k = {permeability(run):g} m/s: " + (
            f"0.2 m after {t[late[0]]:.2f} s, " if late.size else "") +
            f"{moved[-1]:.3f} m at the end")
    curves.set(xlabel="time (s)", ylabel="displacement of the crest (m)", ylim=(0., None))
    curves.legend()
    style.write_figure(figure, [PICTURE], cropped=False)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    draw([geocone.read(folder) for folder in sys.argv[1:]])
