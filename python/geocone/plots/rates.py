# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""plastic_strain_rate.png and plastic_strain_rate_points.png: where the soil flows."""

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm

from geocone.style import (RATES, SHOWN, Skipped, add_bar, disks, draw_obstacles, draw_water,
                           in_plane, panels, plain, save, with_obstacles)

ZONE = 1e-3  # the view is where the rate is more than this part of the greatest one


def rates_of(run, series):
    """The last field of a series, its plastic strain rates and its title."""
    field, = run.states(series)
    rates = field.data["plastic_strain_rate"][:, 0]
    if not np.any(rates > 0.):
        raise Skipped(f"nothing flows at t = {field.time:.4g} s")
    return field, rates, (f"{plain(run.name)}: plastic strain rate of {series}, "
                          f"t = {field.time:.4g} s")


def view_of(run):
    """The box (low, high) of the flow with a margin, within the domain."""
    field, rates, _ = rates_of(run, "cells")
    points, flowing = field.points, field.points[rates > ZONE * rates.max()]
    margin = np.max([0.1 * np.ptp(flowing, axis=0), 0.02 * np.ptp(points, axis=0)])
    return (np.maximum(flowing.min(axis=0) - margin, points.min(axis=0)),
            np.minimum(flowing.max(axis=0) + margin, points.max(axis=0)))


def cells_of(field, values):
    """The cells, each in the colour of its first corner: all have the cell's value."""
    return PolyCollection(field.points[field.cells], array=values[field.cells[:, 0]],
                          edgecolors="face", linewidths=0.5)


def add_rates(axes, collection, most, shown=SHOWN):
    """Adds a collection of rates in their colours, and the colour bar."""
    collection.set(cmap=RATES, norm=LogNorm(shown * most, most))
    axes.add_collection(collection)
    add_bar(axes, collection, "plastic strain rate (1/s)", extend="min")


def motion_of(run, data):
    """How far or how fast the nodes of a field move.

    @return name and unit, the magnitudes, and the greatest that is shown"""
    # The mesh of points that move has no displacement.
    name, unit, factor = (("displacement", "mm", 1e3) if "displacement" in data else
                          ("velocity", "m/s", 1.))
    size = factor * np.linalg.norm(data[name], axis=1)
    most = np.inf
    if name == "velocity":
        # Nodes with hardly any mass may be much faster than all particles.
        particles, = run.states("points")
        most = np.linalg.norm(particles.data[name], axis=1).max()
    return name, unit, size, most


def draw_cells(run, path):
    """Draws the rate in each cell, and the displacement."""
    field, rates, title = rates_of(run, "cells")
    points, cells, data, _ = field
    if points.shape[1] == 3:
        from geocone.plots import solid
        solid.draw_cells(run, path, field, rates, motion_of(run, data), title)
        return
    view = view_of(run)
    figure, (first, second) = panels(2, with_obstacles(run, view))
    add_rates(first, cells_of(field, rates), rates.max())
    first.set_title(title)
    name, unit, size, most = motion_of(run, data)
    inside = np.all((points >= view[0]) & (points <= view[1]), axis=1)
    triangles = np.concatenate([cells[:, [0, i, i + 1]]
                                for i in range(1, cells.shape[1] - 1)])
    drawn = second.tripcolor(*points.T, triangles, size, shading="gouraud",
                             vmin=0., vmax=min(most, size[inside].max()))
    second.set_title(f"magnitude of the {name}")
    add_bar(second, drawn, f"{name} ({unit})")
    for axes in (first, second):
        draw_obstacles(axes, run)
        draw_water(axes, run)
    save(figure, run, path, cropped=True)


def draw_points(run, path):
    """Draws the rate of each material point."""
    field, rates, title = rates_of(run, "points")
    in_plane(field)
    figure, (axes,) = panels(1, with_obstacles(run, view_of(run)))
    add_rates(axes, disks(axes, field, rates), rates.max())
    draw_obstacles(axes, run)
    axes.set_title(title)
    save(figure, run, path, cropped=True)
