# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""plastic_strain_rate.png: where the soil yields, and how it moves."""

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from matplotlib.ticker import LogFormatterMathtext, LogLocator

from geocone.plots import overlay
from geocone.plots.answer import heading, is_strength_reduction, moment
from geocone.plots.point_values import per_cell
from geocone.style import (RATES, SHOWN, STRAINS, Skipped, add_bar, disks, level, obstacles_of,
                           panels, save, sizes_of, with_obstacles)


def rates_of(run):
    """The last cells, or points if they move, and their plastic strain rates."""
    field, = run.states("points")
    if "displacement" not in field.data:
        field, = run.states("cells")
    rates = field.data["plastic_strain_rate"][:, 0]
    if not np.any(rates > 0.):
        raise Skipped(f"nothing yields at t = {field.time:.4g} s")
    return field, rates


def scale_of(field, rates):
    """Scale of the colours of rates. It ends at the rate above which a tenth of all flow takes
    place: zones of flow may be small parts of the area, and singular cells are smaller. It
    begins three decades below, or at the rate that four fifths of the body exceed if that is
    higher, but one decade below at least."""
    values, sizes = per_cell(field, rates), sizes_of(field)
    most = level(values, values * sizes, 0.1)
    slow = level(values, sizes, 0.8)
    return LogNorm(np.clip(slow, SHOWN * most, 0.1 * most), most)


def view_of(field, rates, most):
    """The box (low, high) of the flow with a margin, at most a little beyond the domain, and as
    wide as high where the domain is: titles of narrow panels would overlap."""
    points, flowing = field.points, field.points[rates > SHOWN * most]
    margin = np.max([0.1 * np.ptp(flowing, axis=0), 0.02 * np.ptp(points, axis=0)])
    beyond = 0.06 * np.ptp(flowing, axis=0).max()  # where a deformed mesh may be
    least, greatest = points.min(axis=0) - beyond, points.max(axis=0) + beyond
    low = np.maximum(flowing.min(axis=0) - margin, least)
    high = np.minimum(flowing.max(axis=0) + margin, greatest)
    lack = max((high - low)[1] - (high - low)[0], 0.)
    low[0] = max(low[0] - lack / 2., least[0])
    high[0] = min(low[0] + max(high - low), greatest[0])
    low[0] = max(high[0] - max(high - low), least[0])
    return low, high


def cells_of(field, values):
    """The cells, each in the colour of its first corner: all have the cell's value."""
    return PolyCollection(field.points[field.cells], array=values[field.cells[:, 0]],
                          edgecolors="face", linewidths=0.5)


def add_rates(axes, collection, norm, label="plastic strain rate (1/s)"):
    """Adds a collection of rates in their colours, and the colour bar."""
    collection.set(cmap=RATES, norm=norm)
    axes.add_collection(collection)
    add_bar(axes, collection, label, extend="both")


def motion_of(field):
    """Displacements of the nodes or points of a field, or else velocities: name, unit,
    vectors."""
    name = "displacement" if "displacement" in field.data else "velocity"
    vectors = field.data[name][:, :field.points.shape[1]]
    if name == "velocity":
        return name, "m/s", vectors
    return (name, "m", vectors) if np.abs(vectors).max() > 1. else (name, "mm", 1e3 * vectors)


def draw_run(run, path):
    """Draws the rate in each cell, its smooth contours, and the motion; of points that move
    rate and motion."""
    field, rates = rates_of(run)
    unit = "1/s"
    if is_strength_reduction(run):  # its time is not physical
        rates, unit = rates / scale_of(field, rates).vmax, "relative"
    norm = scale_of(field, rates)
    if field.points.shape[1] == 3:
        from geocone.plots import solid
        solid.draw_rates(run, path, field, rates, motion_of(field), norm, unit)
        return
    view = view_of(field, rates, norm.vmax)
    moving = field.cells.shape[1] < 3
    figure, axes_of = panels(2 if moving else 3, with_obstacles(run, view))
    first, last = axes_of[0], axes_of[-1]
    add_rates(first, disks(first, field, rates) if moving else cells_of(field, rates), norm,
              unit)
    first.set_title(f"plastic strain rate{' of the cells' * (not moving)}, "
                    f"{moment(run, field.time)}")
    overlay.draw_scene(first, run, field)
    if not moving:
        second = axes_of[1]
        add_bar(second, overlay.draw_contours(second, field, rates, norm, RATES), unit,
                ticks=LogLocator(), format=LogFormatterMathtext())
        second.set_title("smooth contours (nodal recovery)")
        overlay.draw_scene(second, run, field)
    draw_motion(last, run, field, view)
    figure.suptitle(heading(run), fontsize=13)
    save(figure, run, path, cropped=True)


def draw_motion(axes, run, field, view):
    """Draws how far or how fast the body moves: the deformed mesh or the points, with
    arrows."""
    name, unit, vectors = motion_of(field)
    size = np.linalg.norm(vectors, axis=1)
    inside = np.all((field.points >= view[0]) & (field.points <= view[1]), axis=1)
    seen = per_cell(field, inside)
    most = max(level(size[field.cells[seen]].mean(axis=1), sizes_of(field)[seen]),
               np.finfo(float).tiny)
    title, obstacles = f"magnitude of the {name}", None
    if field.cells.shape[1] < 3:
        drawn = disks(axes, field, size)
        drawn.set(cmap=STRAINS, clim=(0., most))
        axes.add_collection(drawn)
        places = field.points
    else:
        places = field.points
        if name == "displacement" and run.method != "MPM":
            metre = {"m": 1., "mm": 1e3}[unit]
            factor = overlay.magnification(most / metre, view)
            places = places + overlay.enlarged(vectors / metre, factor, most / metre)
            title += ", deformed mesh" + f" ({factor:g} times)" * (factor != 1.)
            now = obstacles_of(run, field.time)
            moved = overlay.obstacle_displacements(run, field.time)
            if moved is not None:
                obstacles = now - moved + overlay.enlarged(moved, factor, most / metre)
            elif len(now):
                title += ", obstacles at their true places"
        drawn = axes.tripcolor(*places.T, overlay.triangles_of(field.cells), size,
                               shading="gouraud", cmap=STRAINS, vmin=0., vmax=most)
        if run.method != "MPM":
            overlay.draw_mesh(axes, field, places)
    overlay.draw_arrows(axes, places, vectors, most)
    overlay.draw_scene(axes, run, field, places, obstacles)
    axes.set_title(title)
    add_bar(axes, drawn, unit, extend="max")
