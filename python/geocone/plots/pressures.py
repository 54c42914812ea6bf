# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""excess_pore_pressure.png: the part of the load that the pore fluid of undrained soil carries."""

import numpy as np

from geocone.plots import overlay
from geocone.plots.answer import heading, moment
from geocone.plots.point_values import level_of
from geocone.plots.rates import cells_of
from geocone.reader import Missing
from geocone.style import add_bar, disks, in_plane, panels, save

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
    pressure = field.data[NAME][:, 0] * run.mass_unit / 1e3
    most = level_of([field], [np.abs(pressure)])
    points = field.points
    figure, (axes,) = panels(1, (points.min(axis=0), points.max(axis=0)))
    drawn = disks(axes, field, pressure) if series == "points" else cells_of(field, pressure)
    drawn.set(cmap="RdBu_r", clim=(-most, most))
    axes.add_collection(drawn)
    add_bar(axes, drawn, "excess pore pressure (kPa)", extend="both")
    overlay.draw_scene(axes, run, field)
    axes.set_title(heading(run, f"excess pore pressure, {moment(run, field.time)}"))
    save(figure, run, path, cropped=True)
