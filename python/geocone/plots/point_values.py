# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values of material points that are shown in pictures, and the box of the points."""

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from geocone.reader import nearest
from geocone.style import Skipped, level, sizes_of

STRAIN = "cumulative_plastic_strain"
SHEAR = "largest shear stress in the plane (Pa)"


def states_at(run, wanted):
    """The states of the points of a run at the times nearest to those wanted."""
    return run.states("points", tuple(nearest(run.times("points"), wanted)))


def values_of(fields, *names):
    """The values of the first of the names that the points have, a list over the
    fields; or None."""
    for name in names:
        if all(name in field.data for field in fields):
            return [field.data[name][:, 0] for field in fields]
    return None


def shear_stress(fields):
    """The largest shear stress in the plane (Pa), a list over the fields."""
    parts = [values_of(fields, f"stress_{name}") for name in ("xx", "yy", "xy")]
    if None in parts:
        raise Skipped("its points have neither plastic strain nor stress")
    return [np.hypot((xx - yy) / 2., xy) for xx, yy, xy in zip(*parts)]


def per_cell(field, values):
    """Values of the cells of a field, all of whose corners have the cell's value, or of its
    points where these are its cells."""
    return values[field.cells[:, 0]]


def vertices_of(points):
    """A number for each point, the same for those at one place."""
    size = np.ptp(points, axis=0).max()
    places = np.round((points - points.min(axis=0)) * (1e8 / size)).astype(np.int64)
    return np.unique(places, axis=0, return_inverse=True)[1].ravel()


def recovered(field, values, vertices=None):
    """Values of the cells, recovered at the nodes: means over the cells of a node, weighted
    by their areas or volumes.

    @param vertices of the points (vertices_of), where they are known"""
    vertices = vertices_of(field.points) if vertices is None else vertices
    weights = np.repeat(sizes_of(field), field.cells.shape[1])
    corners = field.cells.ravel()
    total = np.bincount(vertices[corners], weights)
    sums = np.bincount(vertices[corners], weights * values[corners])
    return (sums / np.maximum(total, 1e-300))[vertices]


def level_of(fields, values):
    """Positive value at which colours end (style.level) for some states together; the
    smallest number if nothing is positive."""
    all_values = np.concatenate([per_cell(*pair) for pair in zip(fields, values)])
    sizes = np.concatenate([sizes_of(field) for field in fields])
    positive = all_values > 0.
    return (level(all_values[positive], sizes[positive]) if np.any(positive) else
            np.finfo(float).tiny)


def strain_or_shear(run, fields):
    """Quantity shown at the points: plastic strain, on a logarithmic scale, or the shear
    stress of an elastic body.

    @return values, a list over the fields; their name; their scale; its open ends"""
    values = values_of(fields, STRAIN)
    if values is not None and np.any(np.concatenate(values) > 0.):
        most = level_of(fields, values)
        return values, "cumulative plastic strain (-)", LogNorm(1e-3 * most, most), "both"
    values = shear_stress(fields)
    return values, SHEAR.replace("Pa", run.unit("Pa")), Normalize(0., level_of(fields, values)), "max"


def view_of(fields, reach):
    """The box of all points except outliers: those whose distance from the box of nearly
    all points exceeds `reach`, a function of the size of that box (2)."""
    points = np.concatenate([field.points for field in fields])
    low, high = np.quantile(points, [0.005, 0.995], axis=0)
    far = reach(high - low)
    near = points[np.all((points >= low - far) & (points <= high + far), axis=1)]
    margin = 0.03 * np.ptp(near, axis=0).max()
    return near.min(axis=0) - margin, near.max(axis=0) + margin
