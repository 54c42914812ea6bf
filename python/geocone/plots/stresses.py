# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""principal_stresses.png: crosses of the principal stresses in the plane."""

import contextlib

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D

from geocone.plots import overlay
from geocone.plots.answer import heading, moment
from geocone.plots.model import SOILS, add_legend
from geocone.plots.point_values import view_of
from geocone.plots.rates import cells_of
from geocone.reader import Missing
from geocone.style import (BLUE, COLORS, Skipped, disks, in_plane, level, panels, save,
                           sizes_of, unit_for, with_obstacles)

COMPRESSION, TENSION = BLUE, COLORS[1]
SEEN = 0.05  # of the longest line, from which on one is seen
CROSSES = 34  # along the longer side of the view
WATER = ("Water/Table", "Water/File", "Seepage/Names")  # with one of them stresses are effective


def field_of(run):
    """The last field that has stresses: of a mesh, or of points if they move."""
    if run.method in ("limit load", "strength reduction"):
        return run.states("bounds")[0]
    with contextlib.suppress(Missing):
        field, = run.states("points")
        if "displacement" in field.data or run.method == "explicit MPM":
            return field
    return run.states("cells")[0]


def stresses_of(field):
    """Middles (n, 2) of the cells or points of a field, their areas, and their stresses
    xx, yy, xy (n, 3)."""
    names = [f"stress_{name}" for name in ("xx", "yy", "xy")]
    if not all(name in field.data for name in names):
        raise Skipped("the field has no stresses")
    of_nodes = np.concatenate([field.data[name] for name in names], axis=1)
    return (field.points[field.cells].mean(axis=1), sizes_of(field),
            of_nodes[field.cells].mean(axis=1))


def means_in_squares(places, areas, stresses, low, step):
    """Means over squares of a lattice, weighted by areas: places, stresses and the sum of the
    areas."""
    square = np.floor((places - low) / step).astype(int)
    _, index = np.unique(square, axis=0, return_inverse=True)
    index = index.ravel()
    total = np.bincount(index, areas)

    def means(values):
        return np.stack([np.bincount(index, areas * column) / total for column in values.T],
                        axis=1)

    return means(places), means(stresses), total


def principal(stresses):
    """Principal values (n, 2), the greater one first, and their unit directions (n, 2, 2)."""
    xx, yy, xy = stresses.T
    middle, radius = (xx + yy) / 2., np.hypot((xx - yy) / 2., xy)
    angle = np.arctan2(2. * xy, xx - yy) / 2.
    first = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    second = np.stack([-first[:, 1], first[:, 0]], axis=1)
    return np.stack([middle + radius, middle - radius], axis=1), np.stack([first, second], axis=1)


def crosses(places, values, directions, most, step):
    """The lines of crosses (n, 2, 2), of length `step` where a stress has the size `most` or
    more, and whether each is tension."""
    length = step * np.clip(values / most, -1., 1.)[..., None]
    half = length * directions / 2.
    lines = np.stack([places[:, None] - half, places[:, None] + half], axis=2).reshape(-1, 2, 2)
    return lines, values.ravel() > 0.


def draw_run(run, path):
    """Draws the crosses over the soils and the mesh."""
    field = field_of(run)
    in_plane(field)
    places, areas, stresses = stresses_of(field)
    moves = field.cells.shape[1] < 3
    view = with_obstacles(run, view_of([field], lambda size: 0.1 * np.max(size)) if moves else
                          (field.points.min(axis=0), field.points.max(axis=0)))
    step = np.max(view[1] - view[0]) / CROSSES
    places, stresses, areas = means_in_squares(places, areas, stresses, view[0], step)
    values, directions = principal(stresses)
    most = level(np.abs(values).max(axis=1), areas)
    if not most > 0.:
        raise Skipped("there are no stresses")
    lines, is_tension = crosses(places, values, directions, most, 0.95 * step)
    figure, (axes,) = panels(1, view)
    figure.set_size_inches(1.3 * figure.get_size_inches())
    soils = field.data["material"][:, 0] % len(SOILS)
    drawn = disks(axes, field, soils) if moves else cells_of(field, soils)
    drawn.set(cmap=ListedColormap(SOILS), clim=(-0.5, len(SOILS) - 0.5))
    axes.add_collection(drawn)
    if not moves:
        overlay.draw_mesh(axes, field, field.points)
    overlay.draw_scene(axes, run, field)
    axes.add_collection(LineCollection(
        lines, colors=np.where(is_tension, TENSION, COMPRESSION), linewidths=1.1, zorder=5,
        capstyle="butt"),
        autolim=False)
    name, size = unit_for(most, run.unit("Pa"))
    entries = {f"compression (longest line: {most / size:.4g} {name} or more)":
               Line2D([], [], color=COMPRESSION)}
    if np.any(values > SEEN * most):
        entries["tension"] = Line2D([], [], color=TENSION)
    add_legend(axes, entries, below=36.)
    effective = any(run.parameters.get(key) for key in WATER)
    when = "of the lower bound" if run.method in ("limit load", "strength reduction") else (
        moment(run, field.time))
    axes.set_title(f"{'effective ' * effective}principal stresses in the plane, {when}")
    figure.suptitle(heading(run), fontsize=13)
    save(figure, run, path, cropped=True)
