# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The slope whose toe is cut off (studies/slope_cut.toml): a group is a soil, the axis
`cells` its cells and points. Options: cells (the runs of a picture), cut (its time, s).
"""

import numpy as np
from matplotlib.colors import LogNorm

from geocone.reader import nearest, read_series, read_states, read_table
from geocone.report.schema import NUMBER, VALUE, VIEW, list_of, takes
from geocone.style import COLORS, STRAINS, disks, plain, subplots


def shown(rows, options):
    """The finished runs of a picture, one for each soil."""
    return [row for row in rows if row["axes"]["cells"] == options["cells"] and
            row["status"] == "finished"]


def states_at(row, times):
    """The states of the points that are nearest to some times."""
    file = row["folder"] / "points.pvd"
    series = np.array([time for time, _ in read_series(file)])
    return read_states(file, nearest(series, times))


def steps_of(row, cut):
    """The columns of statistics.csv, and the place of the last step before the cut."""
    table = read_table(row["folder"] / "statistics.csv")
    return table, int(np.flatnonzero(table["time (s)"] <= cut + 1e-9)[-1])


@takes("crest", "cut", crest=NUMBER, cut=NUMBER)
def table(rows, options):
    """A line for each run. Options: crest (m, height of the ground behind the slope)."""
    lines = []
    for row in rows:
        if row["status"] != "finished":
            lines.append([row["group"], row["label"], "failed", *["-"] * 9])
            continue
        steps, before = steps_of(row, options["cut"])
        last, = read_states(row["folder"] / "points.pvd")
        x, y = last.points.T
        moved = np.linalg.norm(last.data["displacement"], axis=1) > 1.
        weight = 9.81 * steps["mass (kg/m)"][before]
        speed, work = steps["largest speed (m/s)"], steps["gravity work (J/m)"]
        lines.append([
            row["group"], row["label"], row["summary"]["state"]["points"],
            row["summary"]["explicit"]["steps"],
            f"{steps['unbalanced force (N/m)'][before] / weight:.1e}",
            f"{speed[before]:.3f}", f"{speed[before + 1:].max():.1f}",
            f"{steps['kinetic energy (J/m)'][before + 1:].max() / 1e3:.1f}",
            f"{(work[-1] - work[before]) / 1e3:.0f}",
            f"{x[~moved & (y > options['crest'] - 0.5)].max():.2f}",
            f"{x[moved].max():.2f}" if np.any(moved) else "-",
            f"{100. * steps['numerical loss (J/m)'][-1] / work[-1]:.2f} %"])
    return ["soil", "cells, points per cell", "points", "explicit steps", "unbalanced",
            "fastest point before (m/s)", "fastest point after (m/s)",
            "largest kinetic energy (kJ/m)", "released (kJ/m)", "edge (m)", "slide (m)",
            "numerical loss"], lines


@takes("cells", "cut", "times", "view", cells=VALUE, cut=NUMBER,
       times=list_of(NUMBER, 1, 20), view=VIEW)
def points(rows, options):
    """The points of all soils at some times. Options: times (s), view [x0, y0, x1, y1]."""
    soils, times = shown(rows, options), options["times"]
    x0, y0, x1, y1 = options["view"]
    figure, grid = subplots(len(times), len(soils), figsize=(5.5 * len(soils), 10.),
                            sharex=True, sharey=True, squeeze=False)
    for column, row in zip(grid.T, soils):
        for axes, state in zip(column, states_at(row, times)):
            after = state.time - options["cut"]
            axes.set(aspect="equal", xlim=(x0, x1), ylim=(y0, y1))
            drawn = disks(axes, state, state.data["cumulative_plastic_strain"][:, 0])
            drawn.set(cmap=STRAINS, norm=LogNorm(1e-2, 10.))
            axes.add_collection(drawn)
            axes.grid(False)
            axes.set_title(plain(row["group"]) + (f", t = {after:.2g} s after the cut"
                                                  if after > 0. else ", before the cut"))
            axes.set(xlabel="x (m)", ylabel="y (m)")
            axes.label_outer()
    figure.colorbar(drawn, ax=grid, extend="both", shrink=0.6,
                    label="cumulative plastic strain since the slope stands (-)")
    return figure


@takes("cells", "cut", cells=VALUE, cut=NUMBER)
def energies(rows, options):
    """Kinetic energy, and where the released energy goes."""
    figure, (kinetic, works) = subplots(1, 2, figsize=(10., 4.))
    for row, color in zip(shown(rows, options), COLORS):
        steps, cut = steps_of(row, options["cut"])
        time, soil = steps["time (s)"][cut:] - options["cut"], plain(row["group"])
        kinetic.plot(time, steps["kinetic energy (J/m)"][cut:] / 1e3, color=color,
                     label=soil)
        for name, style in (("gravity work", "-"), ("stress work", "--")):
            work = steps[f"{name} (J/m)"][cut:]
            works.plot(time, (work - work[0]) / 1e3, style, color=color,
                       label=f"{soil}, {name}")
    for axes, title in ((kinetic, "kinetic energy"), (works, "work since the cut")):
        axes.set(title=title, xlabel="time after the cut (s)", ylabel="energy (kJ/m)")
        axes.legend(fontsize=9)
    return figure
