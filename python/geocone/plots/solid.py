# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies in three dimensions. plastic_strain_rate.png: the faces of the cells that are
seen from where most of the flow is, the body cut open where the flow is inside.
plastic_strain.png: material points as balls, the nearest in front."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import LogNorm, Normalize
from matplotlib.patheffects import withStroke

from geocone.plots.points import view_of
from geocone.style import RATES, SHOWN, STEPS, STRAINS, add_bar, panels, plain, save

# Corners of the faces of cells, in VTK's order; triangles tell one corner twice.
FACES = {4: [(0, 1, 2, 2), (0, 1, 3, 3), (1, 2, 3, 3), (0, 2, 3, 3)],
         8: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6),
             (3, 0, 4, 7)]}
ON_DARK = [withStroke(linewidth=3., foreground="white")]
HEIGHT = np.radians(30.)  # of the eye above the horizon
HIDDEN = 0.3  # the body is cut open if less than this part of the greatest rate is seen


def vertices_of(points):
    """A number for each point, the same for those at one place."""
    size = np.ptp(points, axis=0).max()
    places = np.round((points - points.min(axis=0)) * (1e8 / size)).astype(np.int64)
    return np.unique(places, axis=0, return_inverse=True)[1].ravel()


def outer_faces(points, cells, vertices):
    """The faces that one cell only has.

    @param vertices a number of each point, by which cells are neighbours
    @return the points of the corners (n, 4), and the outward unit normals (n, 3)"""
    corners = cells[:, FACES[cells.shape[1]]]  # cell, face, corner
    flat = corners.reshape(-1, 4)
    own = flat[:, :3] if cells.shape[1] == 4 else flat  # the fourth is told twice
    _, first, number = np.unique(np.sort(vertices[own], axis=1), axis=0,
                                 return_index=True, return_counts=True)
    outer = first[number == 1]
    faces = flat[outer]
    a, b, c, d = (points[faces[:, i]] for i in range(4))
    normals = np.cross(c - a, d - b)
    flat_ones = np.linalg.norm(normals, axis=1) == 0.
    normals[flat_ones] = np.cross(b - a, c - a)[flat_ones]
    inwards = points[cells].mean(axis=1)[outer // corners.shape[1]] - (a + b + c + d) / 4.
    normals *= -np.sign(np.sum(normals * inwards, axis=1))[:, None]
    return faces, normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]


class View:
    """Parallel projection from above, from one of the four corners of the horizon.

    towards  unit vector to the eye; right, up  those of the picture"""

    def __init__(self, sign_x, sign_z):
        self.signs = np.array([sign_x, sign_z])
        self.right = np.array([sign_z, 0., -sign_x]) / np.sqrt(2.)
        level = np.array([sign_x, 0., sign_z]) / np.sqrt(2.)
        self.towards = np.cos(HEIGHT) * level + np.array([0., np.sin(HEIGHT), 0.])
        self.up = np.cos(HEIGHT) * np.array([0., 1., 0.]) - np.sin(HEIGHT) * level

    def seen(self, points):
        """Where points are in the picture (n, 2)."""
        return points @ np.array([self.right, self.up]).T

    def name(self):
        """Where the eye is."""
        return ", ".join("-+"[int(sign > 0)] + axis
                         for sign, axis in zip(self.signs, "xz"))


def chosen_view(points, cells, rates):
    """From where most of the flow is seen, and the cells that are left of the body if it
    has to be opened: those in front of the cell of the greatest rate are taken away."""
    vertices = vertices_of(points)
    views = [View(x, z) for x in (1., -1.) for z in (1., -1.)]
    centres, of_cell = points[cells].mean(axis=1), rates[cells[:, 0]]

    def shown(view, left):
        faces, normals = outer_faces(points, cells[left], vertices)
        facing = normals @ view.towards > 1e-6
        return rates[faces[facing, 0]] if np.any(facing) else np.zeros(1)

    whole = np.ones(len(cells), bool)
    seen = [shown(view, whole) for view in views]
    best = max(range(4), key=lambda i: (seen[i].max(), seen[i].sum()))
    if seen[best].max() >= HIDDEN * rates.max():
        return views[best], whole, vertices
    fastest = centres[np.argmax(of_cell)]
    view = max(views, key=lambda view: -np.sum(view.signs * fastest[[0, 2]]))
    in_front = np.all((centres - fastest)[:, [0, 2]] * view.signs > 0., axis=1)
    return view, ~in_front, vertices


def add_faces(axes, view, points, faces, normals, values, colors, norm, label, **bar):
    """Draws faces from the back to the front, in the colours of their values (one for
    each face), darker where they are seen from the side."""
    depth = points[faces].mean(axis=1) @ view.towards
    order = np.argsort(depth)
    light = 0.75 + 0.25 * np.abs(normals @ np.array([0.25, 0.9, 0.35]))
    paint = colors(norm(values))
    paint[:, :3] *= np.minimum(light, 1.)[:, None]
    axes.add_collection(PolyCollection(view.seen(points)[faces[order]],
                                       facecolors=paint[order], edgecolors="#60606060",
                                       linewidths=0.3))
    add_bar(axes, ScalarMappable(norm, colors), label, **bar)


def add_directions(axes, view, box):
    """Adds the directions of the coordinates and a length, in place of axes."""
    axes.set(xticks=[], yticks=[], xlabel="", ylabel="")
    axes.set_frame_on(False)
    low, size = box[0], np.ptp(box, axis=0)
    length = 0.08 * size.max()
    corner = low + np.array([1.2, 1.2]) * length
    for name, direction in zip("xyz", np.eye(3)):
        tip = view.seen(direction[None])[0] * length
        axes.annotate("", corner + tip, corner, zorder=5,
                      arrowprops={"arrowstyle": "->", "shrinkA": 0., "shrinkB": 0.,
                                  "path_effects": ON_DARK})
        axes.text(*(corner + 1.35 * tip), name, ha="center", va="center", zorder=5,
                  path_effects=ON_DARK)
    scale = 10.**np.floor(np.log10(0.3 * size[0]))
    scale *= max(factor for factor in (1, 2, 5) if factor * scale <= 0.3 * size[0])
    start = np.array([low[0] + 0.97 * size[0] - scale, low[1] + 0.03 * size[1]])
    axes.plot([start[0], start[0] + scale], [start[1]] * 2, color="black", linewidth=2.,
              zorder=5, path_effects=ON_DARK)
    axes.text(start[0] + scale / 2., start[1] + 0.01 * size[1], f"{scale:g} m",
              ha="center", va="bottom", zorder=5, path_effects=ON_DARK)


def draw_cells(run, path, field, rates, title):
    """Draws the rate of each cell that is seen, and the displacement of its faces."""
    points, cells, data, _ = field
    view, left, vertices = chosen_view(points, cells, rates)
    faces, normals = outer_faces(points, cells[left], vertices)
    facing = normals @ view.towards > 1e-6
    faces, normals = faces[facing], normals[facing]
    name, unit, factor = (("displacement", "mm", 1e3) if "displacement" in data else
                          ("velocity", "m/s", 1.))
    size = factor * np.linalg.norm(data[name], axis=1)[faces].mean(axis=1)
    most = size.max()
    if name == "velocity":
        # Nodes with hardly any mass may be much faster than all particles.
        particles, = run.states("points")
        most = min(most, np.linalg.norm(particles.data[name], axis=1).max())
    # What is seen is where something moves, with a margin.
    moving = np.concatenate([rates[faces[:, 0]] > 1e-3 * rates.max(),
                             size > 0.02 * size.max()]).reshape(2, -1).any(axis=0)
    shown, body = (view.seen(points)[f.ravel()] for f in (faces[moving], faces))
    margin = 0.15 * np.ptp(shown, axis=0).max()
    box = (np.maximum(shown.min(axis=0) - margin, body.min(axis=0)),
           np.minimum(shown.max(axis=0) + margin, body.max(axis=0)))
    box = (box[0] - 0.02 * np.ptp(box), box[1] + 0.02 * np.ptp(box))
    figure, (first, second) = panels(2, box)
    add_faces(first, view, points, faces, normals, rates[faces[:, 0]], RATES,
              LogNorm(SHOWN * rates.max(), rates.max()), "plastic strain rate (1/s)",
              extend="min")
    add_faces(second, view, points, faces, normals, size, STEPS,
              Normalize(0., max(most, np.finfo(float).tiny)), f"{name} ({unit})")
    opened = "" if left.all() else ", cut open"
    first.set_title(f"{title}\nseen from {view.name()}{opened}")
    second.set_title(f"magnitude of the {name}")
    for axes in (first, second):
        add_directions(axes, view, box)
    save(figure, run, path, cropped=True)


def draw_points(run, path, fields, values, norm, label):
    """Draws material points at some times, coloured by values, with one colour bar."""
    view = View(1., 1.)
    box = view_of([field._replace(points=view.seen(field.points)) for field in fields],
                  lambda size: size / 2.)
    figure, axes = panels(len(fields), box)
    for ax, field, value in zip(axes, fields, values):
        order = np.argsort(field.points @ view.towards)
        size = (np.cbrt(field.data["volume"][order, 0]) if "volume" in field.data else
                np.full(len(order), np.ptp(box, axis=0).max() / 100.))
        drawn = EllipseCollection(1.3 * size, 1.3 * size, 0. * size, units="xy",
                                  offsets=view.seen(field.points)[order],
                                  array=value[order], cmap=STRAINS, norm=norm,
                                  edgecolors="#40404080", linewidths=0.2,
                                  offset_transform=ax.transData)
        ax.add_collection(drawn)
        ax.set_title(f"t = {field.time:.4g} s")
        add_directions(ax, view, box)
    title = f"{plain(run.name)}: {label.rsplit(' (', 1)[0]}, seen from {view.name()}"
    if len(fields) == 1:
        axes[0].set_title(f"{title}, {axes[0].get_title()}")
    else:
        figure.suptitle(title, fontsize=13)
    figure.colorbar(drawn, ax=list(axes), label=label, aspect=40, pad=0.02)
    save(figure, run, path, cropped=True)
