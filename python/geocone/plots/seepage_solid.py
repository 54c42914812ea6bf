# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""flow_net.png of seepage in three dimensions: pore pressures and heads on the faces of the
tetrahedra, seen from where the water is fastest, and the body cut open if that is inside."""

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from geocone.plots.answer import heading
from geocone.plots.point_values import vertices_of
from geocone.plots.solid import add_directions, add_faces, chosen_view
from geocone.style import Skipped, add_bar, panels, save

DRY = np.array([0.93, 0.89, 0.80, 1.])  # soil above the free surface


def draw_net(run, field, path):
    """Draws pressures and heads of a field."""
    pressure = field.data["pore_pressure"][:, 0] * run.mass_unit / 1e3
    head = field.data["head"][:, 0]
    if not np.any(pressure > 0.):
        raise Skipped("the soil is dry")
    speed = np.linalg.norm(field.data["seepage_velocity"], axis=1)
    view, faces, normals, cut = chosen_view(field.points, field.cells, speed,
                                            vertices_of(field.points))
    seen = view.seen(field.points)
    margin = 0.03 * np.ptp(seen, axis=0).max()
    box = seen.min(axis=0) - margin, seen.max(axis=0) + margin
    wet = pressure[faces].max(axis=1) > 0.
    figure, axes_of = panels(2, box)
    heads = head[pressure > 0.]
    for axes, values, norm, colors, label in (
            (axes_of[0], pressure, Normalize(0., pressure.max()), "Blues", "pore pressure (kPa)"),
            (axes_of[1], head, Normalize(heads.min(), max(heads.max(), heads.min() + 1e-9)),
             "viridis", "head (m)")):
        colors = colormaps[colors]
        paint = colors(norm(values[faces].mean(axis=1)))
        paint[~wet] = DRY
        add_faces(axes, view, field.points, faces, normals, paint)
        add_bar(axes, ScalarMappable(norm, colors), label)
        add_directions(axes, view, box)
        axes.set(xlim=(box[0][0], box[1][0]), ylim=(box[0][1], box[1][1]), aspect="equal")
    figure.suptitle(f"{heading(run)}, seen from {view.name()}{', cut open' * (cut is not None)}",
                    fontsize=13)
    save(figure, run, path, cropped=True)
