# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""mechanism.png of bounds in three dimensions: the mechanism of the upper bound on the deformed
body, its dissipation unless soil has none, and the cells' parts of the gap (by VTK where it is
installed: rendered.py)."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm

from geocone.plots.answer import heading
from geocone.plots.point_values import recovered, vertices_of
from geocone.plots.rendered import images_of
from geocone.plots.solid import (add_directions, add_faces, add_image, chosen_view, norm_of,
                                 part_of)
from geocone.style import RATES, STEPS, add_bar, level, panels, save, sizes_of

SHARE = 0.08  # of the size of the body, by which its fastest corner is displaced
DECADES = 1e-2  # shown of dissipation and gap


class Panel:
    """A picture of the body: a value of each cell, its scale, and words."""

    def __init__(self, points, values, norm, colors, title, label):
        self.points, self.values, self.norm, self.colors = points, values, norm, colors
        self.title, self.label = title, label


def deformed(field, vertices):
    """The points, displaced by the mechanism, the mean of the cells at each vertex: jumps of
    the velocity would tear the body."""
    velocity = field.data["velocity"]
    mean = np.stack([recovered(field, column, vertices) for column in velocity.T], axis=1)
    most = np.linalg.norm(mean, axis=1).max()
    size = np.linalg.norm(np.ptp(field.points, axis=0))
    return field.points + SHARE * size / max(most, np.finfo(float).tiny) * mean


def panels_of(field, vertices):
    """Creates the panels of a field: mechanism and, if there are any, dissipation and gap."""
    def of_cells(name):
        return field.data[name][field.cells[:, 0], 0]

    def logarithmic(values, sizes):
        most = max(level(values, sizes), np.finfo(float).tiny)
        return LogNorm(DECADES * most, most)

    volumes = sizes_of(field)
    speed = np.linalg.norm(field.data["velocity"][field.cells].mean(axis=1), axis=1)
    most = max(level(speed, volumes), np.finfo(float).tiny)
    shown = [Panel(deformed(field, vertices), speed / most, norm_of(1.), STEPS,
                   "mechanism of the upper bound: speed", "relative")]
    density, part = of_cells("dissipation"), of_cells("part_of_gap")
    if np.any(density > 0.):  # none without cohesion
        shown.append(Panel(field.points, density, logarithmic(density, volumes), RATES,
                           "dissipation of the upper bound per volume", "over the mean"))
    if np.any(part > 0.):
        shown.append(Panel(field.points, part, logarithmic(part, np.ones(len(part))), RATES,
                           f"parts of the gap of {len(part)} tetrahedra", "over the mean"))
    return shown


def draw_mechanism(run, field, path):
    """Draws the panels of a field, seen from where most is dissipated; the body is cut open
    if that is inside."""
    vertices = vertices_of(field.points)
    first = np.unique(vertices, return_index=True)[1]
    density = field.data["dissipation"][:, 0]
    if not np.any(density > 0.):
        density = field.data["part_of_gap"][:, 0]
    view, faces, normals, cut = chosen_view(field.points, field.cells, density, vertices)
    shown = panels_of(field, vertices)
    places = np.concatenate([view.seen(panel.points) for panel in shown])
    margin = 0.03 * np.ptp(places, axis=0).max()
    box = places.min(axis=0) - margin, places.max(axis=0) + margin
    figure, axes_of = panels(len(shown), box)
    cell_of_point = np.empty(len(field.points), int)
    cell_of_point[field.cells] = np.arange(len(field.cells))[:, None]
    images = []
    for same in shown[:1], shown[1:]:  # those of the same points by one call
        images += images_of(same[0].points[first], vertices[field.cells],
                            [("cell", part_of(panel.norm, panel.values), panel.colors)
                             for panel in same], view, box, cut)
    for i, (axes, panel) in enumerate(zip(axes_of, shown)):
        if len(images) == len(shown):
            add_image(axes, images[i], box)
        else:
            of_faces = panel.values[cell_of_point[faces[:, 0]]]
            add_faces(axes, view, panel.points, faces, normals,
                      panel.colors(panel.norm(of_faces)))
        add_bar(axes, ScalarMappable(panel.norm, panel.colors), panel.label,
                extend="max" if panel.colors is STEPS else "both")
        add_directions(axes, view, box)
        axes.set_title(panel.title)
    figure.suptitle(f"{heading(run)}, seen from {view.name()}{', cut open' * (cut is not None)}",
                    fontsize=13)
    save(figure, run, path, cropped=True)
