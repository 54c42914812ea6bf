# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""model.png of a scene in three dimensions: the body from above, from below where supports
or loads are hidden, and the stages that change it."""

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch

from geocone.plots.model import (LOAD, MOST_STAGES, MOTION, add_legend, arrow_entry, color_of,
                                 draw_arrows, frame, legend_of, notable_stages, states_of,
                                 value_text, words_of)
from geocone.plots.solid import View, add_directions
from geocone.style import plain, save, subplots

# Of supports: apart from those of soils, loads and motions, and from one another.
SUPPORTS = ["#4d4d4d", "#1b7f79", "#8a5a9e", "#7a6a1f", "#3f6fb0", "#a4526b"]
ABOVE = View(1., 1.)
BELOW = View(-1., -1., -np.radians(20.))


def normal_of(face):
    """Twice the area of a face times its normal, outward for corners that are
    counterclockwise there."""
    return np.cross(face[1] - face[0], face[2] - face[0])


def is_seen(condition, view):
    """Whether a view shows the outside of a face, of each one of a condition."""
    normals = np.array([normal_of(np.array(face, dtype=float))
                        for face in condition["faces"]]).reshape(-1, 3)
    return normals @ view.towards > 1e-9 * np.linalg.norm(normals, axis=1)


def seen_faces(condition, view):
    """The faces of a condition whose outside a view shows."""
    return [np.array(face, dtype=float)
            for face, is_shown in zip(condition["faces"], is_seen(condition, view)) if is_shown]


def is_moved(condition):
    """Whether a condition prescribes values that are not zero."""
    return bool(np.any(condition["values"]))


def grid_of(model):
    """Lines (x, y, z) of a grid that the body fills in part, and where it does (nx, ny, nz);
    None for a body of a mesh file, or whose materials have no boxes.

    A body that a formula gives is on its lattice; a box is divided where regions of
    materials and of excavations end."""
    body = model.data["body"]
    if "lattice" in body:
        inside = selected(body["lattice"])
        low, high = (np.array(body["lattice"][end]) for end in ("low", "high"))
        return [np.linspace(low[d], high[d], inside.shape[d] + 1) for d in range(3)], inside
    without_box = {i for i, material in enumerate(model.data["materials"])
                   if i > 0 and "region" not in material}
    if body["shape"] != "box" or without_box & set(model.data["material_of_cell"] or []):
        return None
    boxes = [one[key] for kind, key in (("materials", "region"), ("stages", "removed"))
             for one in model.data[kind] if key in one]
    lines = [np.unique(np.clip([model.low[d], model.high[d], *(
        end[d] for ends in boxes for end in ends)], model.low[d], model.high[d]))
        for d in range(3)]
    return lines, np.ones([len(line) - 1 for line in lines], dtype=bool)


def selected(lattice):
    """The points (nx, ny, nz) of a lattice that a formula selects."""
    return np.array([[[int(c) for c in row] for row in layer]
                     for layer in lattice["layers"]], dtype=bool).transpose(2, 1, 0)


def centres_of(lines):
    """Centres of the cells of a grid (nx, ny, nz, 3)."""
    return np.stack(np.meshgrid(*((line[1:] + line[:-1]) / 2. for line in lines),
                                indexing="ij"), axis=-1)


def in_box(points, ends):
    """Which points lie in a box, whose corners are given."""
    ends = np.sort(np.array(ends, dtype=float), axis=0)
    return np.all((points > ends[0]) & (points < ends[1]), axis=-1)


def selected_at(points, what):
    """Which points are in a box, or in cells of a lattice that a formula selects; those on a
    side of it, too."""
    inside = selected(what) if isinstance(what, dict) else np.ones((1, 1, 1), dtype=bool)
    low, high = np.sort(np.array([what["low"], what["high"]] if isinstance(what, dict) else what,
                                 dtype=float), axis=0)
    part = (points - low) / (high - low)
    cells = np.clip((part * inside.shape).astype(int), 0, np.array(inside.shape) - 1)
    return np.all((part > -1e-9) & (part < 1. + 1e-9), axis=1) & inside[tuple(cells.T)]


def faces_of_grid(lines, there, d, sign):
    """The faces normal to x, y or z (d) between cells that are there and what is not.

    @param sign 1, -1: on the upper, lower side of the cells
    @return cells (n, 3) and corners (n, 4, 3) of the faces, counterclockwise from outside"""
    a, b = (d + 1) % 3, (d + 2) % 3
    neighbour = np.roll(there, -sign, axis=d)
    edge = [slice(None)] * 3
    edge[d] = -1 if sign > 0 else 0
    neighbour[tuple(edge)] = False
    cells = np.argwhere(there & ~neighbour)
    corners = np.empty((len(cells), 4, 3))
    corners[:, :, d] = lines[d][cells[:, d] + (sign > 0)][:, None]
    for corner, (u, v) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))):
        corners[:, corner, a] = lines[a][cells[:, a] + u]
        corners[:, corner, b] = lines[b][cells[:, b] + v]
    return cells, corners[:, ::sign]


def draw_grid(axes, view, lines, colors):
    """Draws the faces of a grid's cells that a view shows, the nearest last.

    @param colors of the cells (nx, ny, nz, 3), not a number where there is nothing"""
    there = ~np.isnan(colors[..., 0])
    signs = np.sign(view.towards).astype(int)
    faces, paint, order = [], [], []
    for d in range(3):
        cells, corners = faces_of_grid(lines, there, d, signs[d])
        faces.append(view.seen(corners.reshape(-1, 3)).reshape(-1, 4, 2))
        paint.append(colors[tuple(cells.T)] * (0.94, 1., 0.86)[d])
        order.append(cells @ signs)
    # Parallel rays pass cells in the order of their numbers.
    nearest = np.argsort(np.concatenate(order), kind="stable")
    paint = np.concatenate(paint)[nearest]
    few = there.sum() < 1000
    axes.add_collection(PolyCollection(
        np.concatenate(faces)[nearest], facecolors=paint, zorder=1, linewidths=0.6 if few else 0.4,
        edgecolors="#50505080" if few else paint))


def is_in_part(model, absent, done):
    """Whether a part of the mesh is not there."""
    names = [material["name"] for material in model.data["materials"]]
    return (any(names[i] in absent for i in set(model.data["material_of_cell"] or []))
            or any(not isinstance(what, str) for what in done))


def remark_of(model, absent, done=()):
    """Names what a picture of the body does not show, for its title."""
    return ("\nwithout the faces inside of the mesh"
            if is_in_part(model, absent, done) and not grid_of(model) else "")


def draw_body(axes, model, view, absent, now=None, done=()):
    """Fills the materials that are there. The parameters are as in model.State."""
    now = now or {}
    names = [material["name"] for material in model.data["materials"]]

    def shown(material):
        return color_of(names.index(now.get(names[material], names[material])))

    of_cell, grid = model.data["material_of_cell"] or [], grid_of(model)
    if of_cell and not (grid and is_in_part(model, absent, done)):
        # The boundary faces of the mesh, the nearest last.
        faces = [np.array(face, dtype=float) for face in model.data["cells"]]
        centres = np.array([face.mean(axis=0) for face in faces])
        there = np.array([names[i] not in absent for i in of_cell])
        for what in done:
            if isinstance(what, str):
                there |= np.array([names[i] == what for i in of_cell])
            else:
                there[selected_at(centres, what)] = False
        order = [i for i in np.argsort(centres @ view.towards) if there[i]]
        axes.add_collection(PolyCollection(
            [view.seen(faces[i]) for i in order], edgecolors="#50505060", linewidths=0.2,
            facecolors=[shown(of_cell[i]) for i in order], zorder=1))
    elif grid:
        lines, inside = grid
        centres = centres_of(lines)
        colors = np.full((*inside.shape, 3), np.nan)

        def cells_of(i):
            region = model.data["materials"][i].get("region")
            return (inside if i == 0 else np.zeros_like(inside) if region is None else
                    inside & in_box(centres, region))

        owner = np.full(inside.shape, -1)
        for i, name in enumerate(names):
            owner[cells_of(i)] = i
        for i, name in enumerate(names):
            if name not in absent:
                colors[owner == i] = to_rgb(shown(i))
        for what in done:
            if isinstance(what, str):
                colors[owner == names.index(what)] = to_rgb(shown(names.index(what)))
            else:
                colors[selected(what) if isinstance(what, dict) else
                       in_box(centres, what)] = np.nan
        draw_grid(axes, view, lines, colors)


def view_of_stages(model):
    """The view from above that shows most of what stages dig away: its sides that are free."""
    boxes = [np.array(stage["removed"]) for stage in model.data["stages"] if "removed" in stage]

    def shown(view):
        free = [view.signs * (ends[:, [0, 2]].max(axis=0) >= model.high[[0, 2]]) +
                view.signs * -1 * (ends[:, [0, 2]].min(axis=0) <= model.low[[0, 2]])
                for ends in boxes]
        return sum(float(np.sum(one)) for one in free)

    return max((View(x, z) for x in (1., -1.) for z in (1., -1.)), key=shown)


def is_behind(triangles, centre, view):
    """Whether triangles (n, 3, 3) are behind a body: its centre is on the eye's side of their
    planes."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return (normals @ view.towards) * np.sum(normals * (centre - triangles[:, 0]), axis=1) > 0.


def is_plane(triangles):
    """Whether all triangles (n, 3, 3) lie in one plane, as those of a half-space."""
    arms = (triangles - triangles[0, 0]).reshape(-1, 3)
    return np.linalg.matrix_rank(arms, tol=1e-9 * np.abs(arms).max()) < 3


def draw_obstacles(axes, model, view):
    """Fills the surfaces of obstacles, those behind the body first. A half-space in front of
    the body is a light shade, which does not hide it. @return entries of the legend"""
    names = []
    for obstacle in model.data["obstacles"]:
        triangles = np.array(obstacle["triangles"], dtype=float).reshape(-1, 3, 3)
        if not len(triangles):
            continue
        triangles = triangles[np.argsort(triangles.mean(axis=1) @ view.towards)]
        behind = is_behind(triangles, (model.low + model.high) / 2., view)
        in_front = "#8c8c8c18" if is_plane(triangles) else "#8c8c8cb0"
        for some, zorder, color in ((triangles[behind], 0.5, "#8c8c8cb0"),
                                    (triangles[~behind], 3, in_front)):
            axes.add_collection(PolyCollection(
                view.seen(some.reshape(-1, 3)).reshape(-1, 3, 2), facecolors=color,
                edgecolors="#606060" if color.endswith("b0") else "none", linewidths=0.3,
                zorder=zorder), autolim=False)
        names.append(plain(obstacle["name"]))
    if not names:
        return {}
    return {f"{', '.join(names)}: " + ("obstacles" if names[1:] else "obstacle"):
            Patch(facecolor="#8c8c8cb0", edgecolor="#606060")}


def faces_on_body(model, faces):
    """The faces of a support where the body is. Those of a body on a lattice are faces of its
    cells: the mesh of its particles reaches farther."""
    if "lattice" not in model.data["body"] or model.data["material_of_cell"]:
        return faces
    lines, inside = grid_of(model)
    steps = np.array([line[1] - line[0] for line in lines])
    ends = np.array([[np.min(face, axis=0), np.max(face, axis=0)] for face in faces])
    normals = np.array([normal_of(np.array(face)) for face in faces])
    found = []
    for d, sign in ((d, sign) for d in range(3) for sign in (1, -1)):
        corners = faces_of_grid(lines, inside, d, sign)[1]
        middles = corners.mean(axis=1)
        is_across = np.ptp(ends[:, :, d], axis=1) < 1e-9 * model.size
        held = np.zeros(len(corners), dtype=bool)
        for low, high in ends[is_across & (normals[:, d] * sign > 0.)]:
            reach = 0.5 * steps * (np.arange(3) == d)  # the lattice ends near the side
            held |= np.all((middles >= low - reach) & (middles <= high + reach), axis=1)
        found.extend(corners[held])
    return found


def held_conditions(model):
    """Supports at rest on faces, with the faces on the body, and their colours."""
    held = [one for one in model.data["supports"] if one["faces"] and not is_moved(one)]
    return [({**one, "faces": faces_on_body(model, one["faces"])}, SUPPORTS[i % len(SUPPORTS)])
            for i, one in enumerate(held)]


def draw_supports(axes, model, view):
    """Fills the faces of supports that are seen. @return entries of the legend"""
    entries = {}
    for condition, color in held_conditions(model):
        axes.add_collection(PolyCollection(
            [view.seen(face) for face in seen_faces(condition, view)],
            facecolors=color + "90", edgecolors=color, linewidths=0.3, zorder=2))
        held = [c for c, given in zip("xyz", condition["prescribed"]) if given]
        when = ", ".join(condition.get("stages", []))
        text = f"{plain(condition['name'])}: fixed in " + (", ".join(held) or
                                                           "the normal direction")
        entries[text + (f" ({plain(when)})" if when else "")] = Patch(
            facecolor=color + "90", edgecolor=color)
    return entries


def loads_of(model):
    """Tractions and supports that move on faces, with their colours and units."""
    kinds = (("supports", MOTION, "m/s"), ("tractions", LOAD, "Pa"))
    return [(one, color, unit) for kind, color, unit in kinds for one in model.data[kind]
            if one["faces"] and is_moved(one)]


def draw_loads(axes, model, view):
    """Arrows of loads at faces that are seen. @return entries of the legend"""
    entries = {}
    for condition, color, unit in loads_of(model):
        axes.add_collection(PolyCollection(
            [view.seen(face) for face in seen_faces(condition, view)],
            facecolors=color + "30", edgecolors="none", zorder=2))
        values = np.array(condition["values"], dtype=float)
        shown = (np.linalg.norm(values, axis=1) > 0.) & is_seen(condition, view)
        places = np.array([np.mean(face, axis=0) for face in condition["faces"]])[shown]
        every = max(1, len(places) // 40)
        if len(places):
            vectors = view.seen(values[shown][::every])
            draw_arrows(axes, view.seen(places[::every]), vectors, -vectors, color,
                        0.1 * model.size)
        text = f"{plain(condition['name'])}: {value_text(values, unit)}"
        entries[text] = arrow_entry(color)
    return entries


def box_of(model, view):
    """Corners of the picture of the body."""
    corners = np.array([[x, y, z] for x in (model.low[0], model.high[0])
                        for y in (model.low[1], model.high[1])
                        for z in (model.low[2], model.high[2])])
    seen = view.seen(corners)
    margin = model.size * np.array([0.12, 0.15 if loads_of(model) else 0.05])
    return np.array([seen.min(axis=0) - 0.12 * model.size, seen.max(axis=0) + margin])


def draw_stages(axes_of, model, stages):
    """A small picture of the body in each of some stages."""
    view = view_of_stages(model)
    for axes, state in zip(axes_of, states_of(model, stages)):
        frame(axes, box_of(model, view))
        draw_body(axes, model, view, state.absent, state.now, state.done)
        draw_obstacles(axes, model, view)
        remark = remark_of(model, state.absent, state.done)
        axes.set_title(f"{words_of(state.stage)}\nseen from {view.name()}{remark}", fontsize=8)
        axes.set(xticks=[], yticks=[])
        axes.set_frame_on(False)


def draw(model, path):
    """Draws the scene from above and a corner, from below where this view hides supports or
    loads, and its stages."""
    hidden = not all(np.all(is_seen(one, ABOVE))
                     for one, *_ in held_conditions(model) + loads_of(model))
    views = [ABOVE, BELOW] if hidden else [ABOVE]
    boxes = [box_of(model, view) for view in views]
    size = np.max([np.ptp(box, axis=0) for box in boxes], axis=0)
    boxes = [box.mean(axis=0) + np.array([-size / 2., size / 2.]) for box in boxes]  # one scale
    stages = notable_stages(model)[:MOST_STAGES]
    w = min(5.5 if hidden else 7., 6. * size[0] / size[1])
    h = w * size[1] / size[0]
    strip = 0.5 + 0.5 * h if stages else 0.
    figure, axes_of = subplots(
        2 if stages else 1, len(views), squeeze=False,
        figsize=(w * len(views), h + strip + 1.),
        gridspec_kw={"height_ratios": [h, strip]} if stages else None)
    entries = legend_of(model)
    for axes, view, box in zip(axes_of[0], views, boxes):
        frame(axes, box)
        draw_body(axes, model, view, model.absent())
        entries.update(draw_obstacles(axes, model, view))
        entries.update(draw_supports(axes, model, view))
        entries.update(draw_loads(axes, model, view))
        add_directions(axes, view, box)
        axes.set_title(f"seen from {view.name()}{remark_of(model, model.absent())}", fontsize=10)
    figure.suptitle(f"{plain(model.name)}: model")
    add_legend(axes_of[0, 0], entries, below=2., centre=1.1 if hidden else 0.5)
    if stages:
        for axes in axes_of[1]:
            axes.axis("off")
        n = max(3, len(stages))
        lower = figure.add_subplot(axes_of[1, 0].get_subplotspec().get_gridspec()[1, :])
        lower.axis("off")
        draw_stages([lower.inset_axes([i / n, 0., 0.96 / n, 0.9]) for i in range(len(stages))],
                    model, stages)
    save(figure, None, path, cropped=True)
