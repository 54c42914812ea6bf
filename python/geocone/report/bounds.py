# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Limit analyses of a study: the gaps of all their meshes."""

import numpy as np
from matplotlib.ticker import FuncFormatter

from geocone.plots.bounds import cells_of
from geocone.reader import ReadError, Run
from geocone.report.figures import COLORS, MARKERS
from geocone.report.schema import POSITIVE, takes
from geocone.style import BESIDE, GREY, plain, subplots


@takes(tolerance=POSITIVE)
def gaps(rows, options):
    """The gap of the bounds against the triangles and against the time of all meshes so
    far: a line for each run, a colour for each group. Options: tolerance = a gap that is
    marked."""
    figure, panels = subplots(1, 2, figsize=(12., 4.8), sharey=True)
    groups, drawn = list(dict.fromkeys(row["group"] for row in rows)), set()
    for row in rows:
        try:
            table = Run(row["folder"]).table("bounds")
        except ReadError:
            continue
        i = groups.index(row["group"])
        seconds = np.cumsum(table["CPU time (s)"] + table["CPU time of the mesh (s)"])
        for axes, x in zip(panels, (cells_of(table)[0], seconds)):
            axes.loglog(x, 100. * table["gap (-)"], color=COLORS[i % len(COLORS)],
                        marker=MARKERS[i % len(MARKERS)], markersize=4., linewidth=1.,
                        label=None if row["group"] in drawn else plain(row["group"]))
        drawn.add(row["group"])
    for axes, label in zip(panels, ("triangles", "CPU time of all meshes so far (s)")):
        if "tolerance" in options:
            axes.axhline(100. * options["tolerance"], color=GREY, linestyle=":")
        axes.set(xlabel=label)
        for axis in axes.xaxis, axes.yaxis:
            axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    # A line to compare with.
    if drawn:
        x = np.array([300., 10000.])
        panels[0].loglog(x, 20. * 300. / x, "k--", linewidth=1.,
                         label="one over the triangles")
    panels[0].set_ylabel("gap (%)")
    panels[1].legend(*panels[0].get_legend_handles_labels(), **BESIDE)
    return figure
