# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""excess_pore_pressure.png: what the fluid in the pores of undrained soil bears."""

import numpy as np

from geocone.plots.rates import cells_of
from geocone.reader import Missing
from geocone.style import add_bar, disks, in_plane, panels, plain, save

NAME = "excess_pore_pressure"


def is_undrained(run):
    """Whether a material of a run has a fluid in its pores."""
    try:
        return any(name.endswith("/Pore fluid bulk modulus") and float(value) > 0.
                   for name, value in run.parameters.items())
    except Missing:
        return False


def draw_run(run, path):
    """Draws the means of the cells, or of points that move the points."""
    series = "points" if run.method == "MPM" else "cells"
    field, = run.states(series)
    in_plane(field)
    pressure = field.data[NAME][:, 0] / 1e3
    # Singular at the edges of what presses: colours are for all but the extremes.
    low, high = np.percentile(pressure, [0.5, 99.5])
    points = field.points
    figure, (axes,) = panels(1, (points.min(axis=0), points.max(axis=0)))
    drawn = disks(axes, field, pressure) if series == "points" else cells_of(field, pressure)
    most = max(abs(low), abs(high)) or 1.
    drawn.set(cmap="RdBu_r", clim=(-most, most))
    axes.add_collection(drawn)
    add_bar(axes, drawn, "excess pore pressure (kPa)", extend="both")
    axes.set_title(f"{plain(run.name)}: excess pore pressure, t = {field.time:.4g} s")
    save(figure, run, path, cropped=True)
