# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies in three dimensions. plastic_strain_rate.png: the faces of the cells that are
seen from where most of the flow is, the body cut open where the flow is inside (by VTK where
it is installed: rendered.py).
plastic_strain.png: material points as balls, by VTK too."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patheffects import withStroke

from geocone.plots.answer import heading, moment
from geocone.plots.point_values import (STRAIN, per_cell, recovered, values_of, vertices_of,
                                        view_of)
from geocone.plots.rendered import can_render, images_of, images_of_balls
from geocone.style import (RATES, SHOWN, STEPS, add_bar, areas_of, level, panels, save,
                           sizes_of)

# Corners of the faces of cells, in VTK's order; triangles have one corner twice.
FACES = {4: [(0, 1, 2, 2), (0, 1, 3, 3), (1, 2, 3, 3), (0, 2, 3, 3)],
         8: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6),
             (3, 0, 4, 7)]}
ON_DARK = [withStroke(linewidth=3., foreground="white")]
HEIGHT = np.radians(30.)  # of the eye above the horizon
HIDDEN = 0.3  # the body is cut open if less than this part of the greatest rate is seen


def outer_faces(points, cells, vertices):
    """The faces that one cell only has.

    @param vertices a number of each point, by which cells are neighbours
    @return the points of the corners (n, 4), and the outward unit normals (n, 3)"""
    corners = cells[:, FACES[cells.shape[1]]]  # cell, face, corner
    flat = corners.reshape(-1, 4)
    own = flat[:, :3] if cells.shape[1] == 4 else flat  # the fourth is the third
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
    """Parallel projection from one of the four corners of the horizon, from above (height
    > 0, rad) or from below.

    towards  unit vector to the eye; right, up  those of the picture"""

    def __init__(self, sign_x, sign_z, height=HEIGHT):
        self.signs, self.below = np.array([sign_x, sign_z]), height < 0.
        self.right = np.array([sign_z, 0., -sign_x]) / np.sqrt(2.)
        level = np.array([sign_x, 0., sign_z]) / np.sqrt(2.)
        self.towards = np.cos(height) * level + np.array([0., np.sin(height), 0.])
        self.up = np.cos(height) * np.array([0., 1., 0.]) - np.sin(height) * level

    def seen(self, points):
        """Where points are in the picture (n, 2)."""
        return points @ np.array([self.right, self.up]).T

    def name(self):
        """Where the eye is."""
        return ", ".join("-+"[int(sign > 0)] + axis for sign, axis in zip(
            self.signs, "xz")) + " and below" * self.below


def facing(faces, normals, view):
    """Those of the faces that a view shows, and their normals."""
    shown = normals @ view.towards > 1e-6
    return faces[shown], normals[shown]


def chosen_view(points, cells, rates, vertices=None):
    """From where most of the flow is seen. If it is hidden, the body is opened: cells in
    front of that of the greatest rate are taken away.

    @param vertices of the points (vertices_of), where they are known
    @return the view, the faces that it shows, their normals, and the corner of the cut, None
        if the body is not opened"""
    vertices = vertices_of(points) if vertices is None else vertices
    views = [View(x, z) for x in (1., -1.) for z in (1., -1.)]
    outer = outer_faces(points, cells, vertices)

    def seen(view):
        shown = rates[facing(*outer, view)[0][:, 0]]
        return (shown.max(), shown.sum()) if len(shown) else (0., 0.)

    best = max(views, key=seen)
    if seen(best)[0] >= HIDDEN * rates.max():
        return best, *facing(*outer, best), None
    centres = points[cells].mean(axis=1)
    fastest = centres[np.argmax(rates[cells[:, 0]])]
    view = max(views, key=lambda view: -np.sum(view.signs * fastest[[0, 2]]))
    in_front = np.all((centres - fastest)[:, [0, 2]] * view.signs > 0., axis=1)
    return view, *facing(*outer_faces(points, cells[~in_front], vertices), view), fastest


def add_faces(axes, view, points, faces, normals, paint):
    """Draws faces from the back to the front, in their colours (n, 4), darker where they
    are seen from the side."""
    depth = points[faces].mean(axis=1) @ view.towards
    order = np.argsort(depth)
    light = 0.75 + 0.25 * np.abs(normals @ np.array([0.25, 0.9, 0.35]))
    paint[:, :3] *= np.minimum(light, 1.)[:, None]
    axes.add_collection(PolyCollection(view.seen(points)[faces[order]],
                                       facecolors=paint[order], edgecolors="#60606060",
                                       linewidths=0.3))


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


def add_image(axes, image, box):
    """Shows an image of the box. @return it"""
    (left, bottom), (right, top) = box
    return axes.imshow(image, extent=(left, right, bottom, top), aspect="equal",
                       interpolation="antialiased", zorder=1)


def box_of_flow(places, moving):
    """Where something moves, with a margin, as far as the body reaches.

    @param places where the corners of the faces are in the picture (n, corners, 2)
    @param moving whether something moves, of each face"""
    shown, body = places[moving].reshape(-1, 2), places.reshape(-1, 2)
    margin = 0.15 * np.ptp(shown, axis=0).max()
    box = (np.maximum(shown.min(axis=0) - margin, body.min(axis=0)),
           np.minimum(shown.max(axis=0) + margin, body.max(axis=0)))
    return box[0] - 0.02 * np.ptp(box), box[1] + 0.02 * np.ptp(box)


def draw_cells(run, field, rates, motion, of_rates, label):
    """Draws the rate of each cell that is seen and its motion; where VTK can be used smooth
    contours of the rates too. The parameters are those of draw_rates.

    @return the figure"""
    name, unit, vectors = motion
    points, cells = field.points, field.cells
    speed = np.linalg.norm(vectors, axis=1)
    vertices = vertices_of(points)
    view, faces, normals, cut = chosen_view(points, cells, rates, vertices)
    size = speed[faces].mean(axis=1)
    box = box_of_flow(view.seen(points)[faces],
                      (rates[faces[:, 0]] > SHOWN * of_rates.vmax) | (size > 0.02 * size.max()))
    of_motion = norm_of(level(size, areas_of(points[faces])))
    images = []
    if can_render():
        first = np.unique(vertices, return_index=True)[1]
        smooth = recovered(field, rates, vertices)[first]
        images = images_of(points[first], vertices[cells], [
            ("cell", part_of(of_rates, per_cell(field, rates)), RATES),
            ("point", part_of(of_rates, smooth), RATES),
            ("point", part_of(of_motion, speed[first]), STEPS)], view, box, cut)
    figure, axes_of = panels(3 if images else 2, box)
    for axes, image in zip(axes_of, images):
        add_image(axes, image, box)
    if not images:
        add_faces(axes_of[0], view, points, faces, normals, RATES(of_rates(rates[faces[:, 0]])))
        add_faces(axes_of[1], view, points, faces, normals, STEPS(of_motion(size)))
    for axes in axes_of[:-1]:
        add_bar(axes, ScalarMappable(of_rates, RATES), label, extend="both")
    add_bar(axes_of[-1], ScalarMappable(of_motion, STEPS), unit, extend="max")
    for axes in axes_of:
        add_directions(axes, view, box)
    axes_of[0].set_title(f"plastic strain rate of the cells, {moment(run, field.time)}\n"
                         f"seen from {view.name()}{', cut open' * (cut is not None)}")
    if images:
        axes_of[1].set_title("smooth contours (nodal recovery)")
    axes_of[-1].set_title(f"magnitude of the {name}")
    return figure


def draw_balls(run, field, rates, motion, of_rates, label):
    """Draws the rate of each point that is seen, and its motion. The parameters are those of
    draw_rates.

    @return the figure"""
    name, unit, vectors = motion
    size = np.linalg.norm(vectors, axis=1)
    look = SolidLook([field], [rates], lambda box: box / 2.)
    figure, axes_of = panels(2, look.box)
    for axes, values, colors, norm, words in (
            (axes_of[0], rates, RATES, of_rates, label),
            (axes_of[1], size, STEPS, norm_of(level(size, sizes_of(field))), unit)):
        look.draw(axes, field, values, colors, norm)
        look.finish(axes)
        add_bar(axes, ScalarMappable(norm, colors), words,
                extend="both" if norm is of_rates else "max")
    axes_of[0].set_title(f"plastic strain rate, {moment(run, field.time)}\n"
                         f"seen from {look.view.name()}")
    axes_of[1].set_title(f"magnitude of the {name}")
    return figure


def draw_rates(run, path, field, rates, motion, of_rates, label):
    """Draws the rate of each cell or ball that is seen, and its motion.

    @param motion name, unit and vectors
    @param of_rates their scale (rates.scale_of)
    @param label unit of the rate"""
    draw = draw_balls if field.cells.shape[1] < 4 else draw_cells
    figure = draw(run, field, rates, motion, of_rates, label)
    figure.suptitle(heading(run), fontsize=13)
    save(figure, run, path, cropped=True)


def part_of(norm, values):
    """Values as parts of a scale; -1 where they are below it."""
    parts = np.full(len(values), -1.)
    shown = values >= norm.vmin
    parts[shown] = np.minimum(norm(values[shown]), 1.)
    return parts


def norm_of(most):
    """A scale from zero to a value, which may be zero."""
    return Normalize(0., max(most, np.finfo(float).tiny))


def seen_values(view, field, values):
    """The values of the points that no other one hides, about."""
    places = view.seen(field.points)
    size = np.ptp(places, axis=0).max() / 100.
    columns, rows = np.floor(places / size).astype(np.int64).T
    nearest = np.argsort(-(field.points @ view.towards))
    pixels = (rows - rows.min()) * (np.ptp(columns) + 1) + columns - columns.min()
    _, first = np.unique(pixels[nearest], return_index=True)
    return values[nearest[first]]


class SolidLook:
    """Drawing of points in space (as points.Look): as balls, by VTK where it can be used,
    from the corner of the horizon from which most of the greatest plastic strains are
    seen at the end, or without them of the greatest values."""

    def __init__(self, fields, values, reach):
        strains = values_of(fields, STRAIN)
        if strains is not None and np.any(strains[-1] > 0.):
            values = strains
        last = np.nan_to_num(values[-1])
        great = last >= np.quantile(last, 0.95)
        self.view = max((View(x, z) for x in (1., -1.) for z in (1., -1.)),
                        key=lambda view: seen_values(view, fields[-1], great).sum())
        # The corners of a body are few of its points: farther than in the plane.
        self.box = view_of([field._replace(points=self.view.seen(field.points))
                            for field in fields], lambda size: 3. * reach(size))
        self.words = f", seen from {self.view.name()}"
        self.by_vtk = True  # until it has drawn nothing

    def draw(self, axes, field, values, colors, norm):
        """Draws the points of a field in the colours of their values. @return what is drawn"""
        size = (np.cbrt(field.data["volume"][:, 0]) if "volume" in field.data else
                np.full(len(values), np.ptp(self.box, axis=0).max() / 100.))
        # Points that fly may have grown without limit.
        size = 1.3 * np.minimum(size, np.quantile(size, 0.98))
        images = self.by_vtk and images_of_balls(
            field.points, size, [("point", part_of(norm, values), colors)], self.view, self.box)
        self.by_vtk = bool(images)
        if images:
            return add_image(axes, images[0], self.box)
        order = np.argsort(field.points @ self.view.towards)  # the nearest in front
        return axes.add_collection(EllipseCollection(
            size[order], size[order], 0. * size, units="xy",
            offsets=self.view.seen(field.points)[order], array=values[order], cmap=colors,
            norm=norm, edgecolors="#40404080", linewidths=0.2,
            offset_transform=axes.transData))

    def finish(self, axes):
        """Further settings of the axes."""
        add_directions(axes, self.view, self.box)

    def surroundings(self, _axes, _run, _field):
        """Nothing yet: outlines in space would hide the points."""
        return []
