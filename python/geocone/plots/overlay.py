# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lines over fields in the plane: outlines of the body and its soils, obstacles, water,
directions of motion."""

import contextlib

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import PathPatch, Polygon

from geocone.plots.load import reset_of
from geocone.plots.model import Model, draw_structures, outline_of
from geocone.plots.point_values import recovered, vertices_of
from geocone.reader import Missing, ReadError
from geocone.style import draw_free_surface, draw_obstacles, draw_water, obstacles_of

BODY = {"edgecolor": "#303030", "linewidth": 1.}
START = {"edgecolor": "#808080", "linewidth": 0.8, "linestyle": (0, (2, 2))}
SOIL = {"edgecolor": "#303030", "linewidth": 0.8, "linestyle": (0, (5, 2))}
MOST_ARROWS = 24  # along the longer side of the view
MESH_LINES = 6000  # cells, of which lines can be seen


def borders_of(field):
    """Borders of the cells of a field in the plane.

    @return corners of the edges between materials (n, 2), and of those of one cell only"""
    cells = field.cells
    ends = np.stack([cells, np.roll(cells, -1, axis=1)], axis=2).reshape(-1, 2)
    material = field.data["material"][:, 0][ends[:, 0]]
    names = np.sort(vertices_of(field.points)[ends], axis=1)
    _, first, edge, number = np.unique(names, axis=0, return_index=True, return_inverse=True,
                                       return_counts=True)
    second = np.argsort(edge.ravel(), kind="stable")[np.cumsum(number) - 1]
    between = (number == 2) & (material[first] != material[second])
    return ends[first[between]], ends[first[number == 1]]


def triangles_of(cells):
    """The triangles of cells in the plane."""
    return np.concatenate([cells[:, [0, i, i + 1]] for i in range(1, cells.shape[1] - 1)])


def model_of(run):
    """The model of a run in the plane; None where there is none."""
    with contextlib.suppress(ReadError):
        model = Model(run.folder)
        return model if model.data["dimension"] == 2 else None


def clip_to_body(axes, run, time):
    """Cuts what the axes show off at the outline of the body: cells of a background mesh
    reach beyond it. Draws the outlines of body and soils as the scene describes them."""
    model = model_of(run)
    outline = None if model is None else outline_of(model)
    if outline is None:
        return
    if "lattice" not in model.data["body"]:
        for collection in axes.collections:
            collection.set_clip_path(PathPatch(outline, transform=axes.transData))
    draw_model_outlines(axes, model, time, outline)


def stage_at(model, time):
    """Name of the stage of the scene at a time; at its end it is still there."""
    end = 0.
    for stage in model.data["stages"]:
        end += stage["duration_s"]
        if time <= end * (1. + 1e-9):
            break
    return stage["name"]


def draw_model_outlines(axes, model, time, outline, body_look=BODY, soil_look=SOIL):
    """Draws the outlines of the body and of its soils at the start, without what is not yet
    there, and what was excavated before a time."""
    body = PathPatch(outline, fill=False, zorder=4, **body_look)
    if "lattice" not in model.data["body"]:
        axes.add_patch(body)
    absent, begin, polygons = model.absent(), 0., []
    for stage in model.data["stages"]:
        if time > begin:
            absent = absent - set(stage.get("added", ()))
            polygons += [stage["removed"]] if "removed" in stage else []
        begin += stage["duration_s"]
    polygons += [material["region"] for material in model.data["materials"]
                 if "region" in material and material["name"] not in absent]
    for polygon in polygons:
        patch = Polygon(polygon, fill=False, zorder=4, **soil_look)
        axes.add_patch(patch)
        patch.set_clip_path(PathPatch(outline, transform=axes.transData))


def draw_scene(axes, run, field, places=None, obstacles=None):
    """Draws over a field the outlines of body and soils, obstacles and water at its time.

    @param places of the nodes where they are not those of the field
    @param obstacles triangles of the obstacles where they are not at their places
    @return what is drawn"""
    view, before = (axes.get_xlim(), axes.get_ylim()), set(axes.get_children())
    if field.cells.shape[1] < 3:
        model = model_of(run)
        if model is not None and (outline := outline_of(model)) is not None:
            draw_model_outlines(axes, model, field.time, outline, START, START)
    elif run.method == "MPM":
        clip_to_body(axes, run, field.time)
    else:
        places = field.points if places is None else places
        for edges, look in zip(borders_of(field), (SOIL, BODY)):
            axes.add_collection(LineCollection(places[edges], colors=look["edgecolor"], zorder=4,
                                               linewidths=look["linewidth"]), autolim=False)
    draw_obstacles(axes, obstacles_of(run, field.time) if obstacles is None else obstacles)
    draw_water(axes, run, field.time)
    model = model_of(run)
    if model is not None:
        of_bounds = run.method in ("limit load", "strength reduction")  # their levels are no times
        draw_free_surface(axes, model.free_surface(None if of_bounds else field.time))
        draw_structures(axes, model, stage_at(model, field.time), with_names=False)
    axes.set(xlim=view[0], ylim=view[1])
    return [artist for artist in axes.get_children() if artist not in before]


def draw_contours(axes, field, values, norm, colors):
    """Fills smooth contours of values of cells, three to a decade. @return what is drawn"""
    nodes = np.maximum(recovered(field, values), 0.1 * norm.vmin)
    first, last = np.ceil(3. * np.log10(norm.vmin)), np.floor(3. * np.log10(norm.vmax))
    return axes.tricontourf(*field.points.T, triangles_of(field.cells), nodes,
                            levels=10.**(np.arange(first, last + 1.) / 3.),
                            norm=norm, cmap=colors, extend="both")


def magnification(most, view):
    """A round factor by which displacements are drawn, the greatest ones a twentieth of the
    view."""
    wanted = 0.05 * np.max(view[1] - view[0]) / most if most > 0. else 1.
    power = 10.**np.floor(np.log10(wanted))
    return power * max(step for step in (1., 2., 5.) if step * power <= wanted * 1.0001)


def obstacle_displacements(run, time):
    """Displacements (n, 3, 2) of the triangles of obstacles_of() at a time, since the
    displacements of the body were set to zero; None where the fields do not have them."""
    begin = reset_of(run)
    try:
        field, before = run.obstacles(time), run.obstacles(begin)
    except Missing:
        return None
    if "displacement" not in field.data or begin > time:
        return None
    moved = field.data["displacement"][:, :2]
    if begin > 0.:
        if abs(before.time - begin) > 1e-9 * begin or len(before.points) != len(moved):
            return None
        moved = moved - before.data["displacement"][:, :2]
    return moved[field.cells]


def enlarged(vectors, factor, most):
    """Displacements as they are drawn: times a factor, and those above `most` as large as it,
    since single nodes at singular edges would reach across the picture."""
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return factor * vectors * (most / np.maximum(size, most))


def draw_arrows(axes, places, vectors, most):
    """Draws the directions of vectors, one in each square of a lattice over the view, of those
    that are not small.

    @param most the size from which on arrows have full length"""
    low = np.array([axes.get_xlim()[0], axes.get_ylim()[0]])
    size = np.array([np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())])
    step = size.max() / MOST_ARROWS
    length = np.linalg.norm(vectors, axis=1)
    shown = np.flatnonzero((length > 0.05 * most) & np.all(
        (places >= low) & (places <= low + size), axis=1))
    square = np.floor((places[shown] - low) / step).astype(int)
    offset = np.linalg.norm((places[shown] - low) / step - square - 0.5, axis=1)
    order = np.lexsort((offset, square[:, 1], square[:, 0]))  # the nearest to the middles
    _, first = np.unique(square[order], axis=0, return_index=True)
    chosen = shown[order[first]]
    arrows = vectors[chosen] / np.maximum(length[chosen], most)[:, None] * step
    axes.quiver(*places[chosen].T, *arrows.T, angles="xy", scale_units="xy", scale=1., zorder=3.5,
                width=0.0022, headwidth=4., headlength=4.5, color="black")


def draw_mesh(axes, field, places):
    """Draws the lines of a mesh that is not fine."""
    if len(field.cells) <= MESH_LINES:
        axes.add_collection(PolyCollection(places[field.cells], facecolors="none", zorder=3,
                                           edgecolors="#00000040", linewidths=0.2), autolim=False)
