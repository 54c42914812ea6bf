# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""model.png: the scene before its first step: soils with a legend, mesh, supports, loads,
water, obstacles, structures, observed points, and the stages that change the body."""

import json
import math
from typing import NamedTuple

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.legend_handler import HandlerPatch
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrow, Patch, PathPatch, Polygon
from matplotlib.path import Path as Outline
from matplotlib.transforms import offset_copy

from geocone.parameter_file import IncludeError, parameters_of
from geocone.reader import Missing, ReadError, mass_unit, reason
from geocone.style import (WATER, draw_free_surface, draw_table, plain, save, subplots, table_of,
                           unit_for)

FILE = "model.json"
# Light enough for symbols, clear to colour-blind readers, and by lightness on paper.
SOILS = ["#e3d3ae", "#b99f77", "#cfdccb", "#9fb3bf", "#e8c3a8", "#c9bedb", "#8f8676", "#f2ead2"]
SUPPORT, LOAD, MOTION = "#303030", "#b02020", "#0060a0"
STRUCTURE = "#5a2d82"
MOST_STAGES = 6  # small pictures of stages
MOST_NUMBERS = 12  # sides of a hole, with numbers


class Model:
    """The description of a scene.

    data        what model.json says (source/output/model_file.cc)
    parameters  {"Section/Name": text}"""

    def __init__(self, folder):
        try:
            self.data = json.loads((folder / FILE).read_text())
            self.parameters = parameters_of(folder / "parameters.prm")
            self.name = self.data["name"]
            self.low, self.high = (np.array(self.data[end], dtype=float)
                                   for end in ("low", "high"))
        except FileNotFoundError as problem:
            raise Missing(f"there is no file '{problem.filename}'")
        except (OSError, ValueError, LookupError, TypeError, IncludeError,
                RecursionError) as problem:
            raise ReadError(f"the model of '{folder}' cannot be read: {reason(problem)}")
        self.size = float(np.max(self.high - self.low))
        # Of one number: 1 kg, or 1 t where forces are in kN (kg).
        self.mass_unit = mass_unit(self.parameters)

    @property
    def stress_unit(self):
        """The unit of stresses in its numbers."""
        return "Pa" if self.mass_unit == 1. else "kPa"

    def materials(self):
        """Names of the materials that are drawn, with their places in the list."""
        return [(i, material["name"]) for i, material in enumerate(self.data["materials"])]

    def free_surface(self, time=None):
        """Segments (n, 2, 2) of the last free surface of the flow up to a time (s), or up to
        that of 'Seepage/Time'."""
        if time is None:
            time = float(self.parameters.get("Seepage/Time", 0.))
        segments = []
        for surface in self.data.get("free_surfaces", []):
            if surface["time_s"] <= time * (1. + 1e-9):
                segments = surface.get("segments", [])  # none in three dimensions
        return np.array(segments, dtype=float).reshape(-1, 2, 2)

    def absent(self):
        """Names of the materials that are not there at the start: those that a stage adds, and
        those without a region that a stage makes of others."""
        names = [name for _, name in self.materials()]
        there = {names[i] for i in self.data["material_of_cell"] or [0]} | {
            material["name"] for material in self.data["materials"] if "region" in material}
        added = {name for stage in self.data["stages"] for name in stage.get("added", ())}
        made = {name for stage in self.data["stages"]
                for name in stage.get("changed", {}).values()}
        return added | (made - there)

    def properties(self, name):
        """A material in a line: its law and what describes its strength."""
        value = {key: self.parameters.get(f"Materials/{name}/{key}") for key in (
            "Type", "Density", "Unit weight", "Saturated unit weight", "Cohesion",
            "Friction angle", "Dilatancy angle", "Tensile strength", "Undrained strength")}

        def number(key):
            try:
                return float(value[key])
            except (TypeError, ValueError):
                return None

        parts = [value["Type"]] if value["Type"] else []
        for key, symbol in (("Cohesion", "c"), ("Undrained strength", "$s_u$")):
            if number(key) is not None:
                parts.append(f"{symbol} = {number(key) * self.mass_unit / 1e3:g} kPa")
        for key, symbol in (("Friction angle", "φ"), ("Dilatancy angle", "ψ")):
            if number(key) is not None:
                parts.append(f"{symbol} = {number(key):g}°")
        if number("Tensile strength") is not None:
            unit, size = unit_for(number("Tensile strength"), self.stress_unit)
            parts.append(f"$\\sigma_t$ = {number('Tensile strength') / size:g} {unit}")
        weights = [("Unit weight", "γ"), ("Saturated unit weight", "$\\gamma_{sat}$")]
        for key, symbol in weights:
            if number(key):  # 0: not given
                parts.append(f"{symbol} = {number(key) * self.mass_unit / 1e3:.4g} kN/m³")
        if number("Density") is not None and not number("Unit weight"):
            parts.append(f"ρ = {number('Density') * self.mass_unit:g} kg/m³")
        return ", ".join(parts)


def color_of(material):
    """The colour of a material by its place in the list."""
    return SOILS[material % len(SOILS)]


class State(NamedTuple):
    """The body in a stage.

    absent  names of the materials that are not there yet
    now  {name: name} what each material has become
    done  what has been taken away (polygons or lattices) and added (names), in this order
    table, end  water table (n, 2) in it, and its end (s)"""

    stage: dict
    absent: set
    now: dict
    done: list
    table: np.ndarray
    end: float


def states_of(model, stages):
    """The states of the body in some of the stages, as those before have left it."""
    absent, done, table, end = model.absent(), [], water_of(model), 0.
    now = {name: name for _, name in model.materials()}
    for stage in model.data["stages"]:
        end += stage["duration_s"]
        added, changed = stage.get("added", []), stage.get("changed", {})
        absent = absent - {*added, *changed.values()}
        now = {name: changed.get(last, last) for name, last in now.items()}
        done = done + [stage[key] for key in ("removed", "removed_lattice")
                       if key in stage] + added
        table = np.array(stage.get("water_table", table), dtype=float)
        if stage in stages:
            yield State(stage, absent, now, done, table, end)


def is_left_turning(polygon):
    """Whether the vertices (n, 2) of a polygon are counterclockwise."""
    x, y = np.array(polygon, dtype=float).T
    return x @ np.roll(y, -1) - y @ np.roll(x, -1) > 0.


def outline_of(model):
    """The outline of the body with its holes as a clip path; None where cells or a lattice
    show it."""
    outline = model.data["body"].get("outline")
    if outline is None:
        return None
    loops = []
    for polygon in [outline, *model.data["body"].get("holes", {}).values()]:
        # Holes run the other way: paths are filled where they wind around.
        if is_left_turning(polygon) != (polygon is outline):
            polygon = polygon[::-1]
        loops.append(Outline(np.array([*polygon, polygon[0]], dtype=float), closed=True))
    return Outline.make_compound_path(*loops)


def draw_lattice(axes, lattice, color, **options):
    """Fills what a formula selects."""
    rows = np.array([[int(c) for c in row] for row in lattice["rows"]], dtype=float)
    image = np.zeros((*rows.shape, 4))
    image[...] = to_rgba(color)
    image[..., 3] *= rows
    (x0, y0), (x1, y1) = lattice["low"], lattice["high"]
    return axes.imshow(image, extent=(x0, x1, y0, y1), origin="lower", aspect="equal",
                       interpolation="nearest", **options)


def draw_soils(axes, model, absent=(), now=None, done=()):
    """Fills the materials. The parameters are as in State."""
    now = now or {}
    names = [name for _, name in model.materials()]
    cells, of_cell = model.data["cells"], model.data["material_of_cell"] or []
    outline = outline_of(model)

    def clip(patch):
        axes.add_patch(patch)
        if outline is not None:
            patch.set_clip_path(PathPatch(outline, transform=axes.transData))

    def shown(material):
        return color_of(names.index(now.get(names[material], names[material])))

    def fill_cells(there, zorder):
        axes.add_collection(PolyCollection(
            [cells[i] for i in there], facecolors=[shown(of_cell[i]) for i in there],
            edgecolors="face", linewidths=0.3, zorder=zorder))

    def fill_region(material, color, zorder):
        region = model.data["materials"][material].get("region")
        if region is not None:
            clip(Polygon(region, linewidth=0., zorder=zorder, facecolor=color))

    if of_cell:
        fill_cells([i for i, m in enumerate(of_cell) if names[m] not in absent], 1)
    else:
        body = model.data["body"]
        if "lattice" in body:
            draw_lattice(axes, body["lattice"], shown(0), zorder=1)
        elif outline is not None:
            axes.add_patch(PathPatch(outline, facecolor=shown(0), linewidth=0., zorder=1))
        for i, name in enumerate(names):
            fill_region(i, "white" if name in absent else shown(i), 1.1)
    is_dug = False
    for zorder, what in zip(np.linspace(1.4, 1.5, len(done)), done):
        if isinstance(what, dict):
            draw_lattice(axes, what, "#ffffff", zorder=zorder)
        elif not isinstance(what, str):
            clip(Polygon(what, facecolor="white", edgecolor="#808080", hatch="//", linewidth=0.8,
                         linestyle="--", zorder=zorder))
        elif is_dug and of_cell:
            fill_cells([i for i, m in enumerate(of_cell) if names[m] == what], zorder)
        elif is_dug:
            fill_region(names.index(what), shown(names.index(what)), zorder)
        is_dug = is_dug or not isinstance(what, str)


def draw_outlines(axes, model):
    """The outlines of the body and of its regions."""
    outline = outline_of(model)
    for material in model.data["materials"]:
        if "region" in material:
            patch = Polygon(material["region"], fill=False, edgecolor="#606060", linewidth=0.7,
                            zorder=2)
            axes.add_patch(patch)
            if outline is not None:
                patch.set_clip_path(PathPatch(outline, transform=axes.transData))
    if outline is not None and "lattice" not in model.data["body"]:
        axes.add_patch(PathPatch(outline, fill=False, edgecolor="#404040", linewidth=1.,
                                 zorder=2))


def draw_mesh(axes, model):
    """The cells, faintly; not of fine meshes, whose lines would hide the soil."""
    cells = model.data["cells"]
    width = 0.4 if len(cells) < 2000 else 0.2
    if 0 < len(cells) < 12000:
        axes.add_collection(PolyCollection(cells, facecolors="none", edgecolors="#00000040",
                                           linewidths=width, zorder=1.6))


def segments_of(faces):
    """The straight segments that faces of the boundary make together (n, 2, 2), with the body
    on the left as of faces."""
    faces = np.array(faces, dtype=float).reshape(-1, 2, 2)
    tolerance = 1e-6 * max(np.ptp(faces.reshape(-1, 2), axis=0).max(), 1e-300)
    lines = {}
    for a, b in faces:
        along = (b - a) / max(np.linalg.norm(b - a), 1e-300)
        offset = along[0] * a[1] - along[1] * a[0]
        key = (*np.round(along, 6), round(offset / (100. * tolerance)))
        lines.setdefault(key, []).append((a @ along, b @ along, a, b))
    segments = []
    for parts in lines.values():
        parts.sort(key=lambda part: part[0])
        end, start, last = parts[0][1:]
        for begin, finish, a, b in parts[1:]:
            if begin > end + tolerance:
                segments.append((start, last))
                start, last, end = a, b, finish
            elif finish > end:
                last, end = b, finish
        segments.append((start, last))
    return np.array(segments)


def spaced(faces, distance):
    """Places along faces in the plane, about a distance apart, on arcs of many chords too.

    @return indices of the nearest faces, places (n, 2), outward unit normals (n, 2)"""
    places, normals = [], []
    for a, b in segments_of(faces):
        x, y = b - a
        length = max(math.hypot(x, y), 1e-300)
        n = max(1, min(60, round(length / distance)))
        normal = np.array([y, -x]) / length
        for k in range(n):
            place = a + (k + 0.5) / n * (b - a)
            if not any(other @ normal > 0.5 and np.linalg.norm(near - place) < 0.6 * distance
                       for near, other in zip(places, normals)):
                places.append(place)
                normals.append(normal)
    places = np.array(places)
    middles = np.array(faces, dtype=float).mean(axis=1)
    index = np.array([np.argmin(np.sum((middles - x)**2, axis=1)) for x in places])
    return index, places, np.array(normals)


def value_text(values, unit):
    """The range of the magnitudes of vectors, with a unit."""
    sizes = np.linalg.norm(values, axis=1)
    prefix, size = unit_for(float(sizes.max()), unit)
    low, high = sizes.min() / size, sizes.max() / size
    return (f"{high:.4g} {prefix}" if high - low <= 1e-6 * high else
            f"{low:.3g} to {high:.4g} {prefix}")


def acts_in(member, stage):
    """Whether a structure or a condition acts in a stage."""
    stages = member.get("stages", [])
    return not stages or stage in stages


def draw_supports(axes, model):
    """Supports: ticks where no component may move, rollers where one may, arrows
    where it is moved. @return entries of the legend"""
    entries = {}
    step = model.size / 40.
    for condition in model.data["supports"]:
        if not condition["faces"]:
            continue
        when = ", ".join(condition.get("stages", []))
        values = np.array(condition["values"], dtype=float)
        index, places, outward = spaced(condition["faces"], step)
        moved = np.linalg.norm(values[index], axis=1) > 0.
        if np.any(moved):
            draw_arrows(axes, places[moved], values[index][moved], outward[moved], MOTION,
                        0.09 * model.size)
            text = f"{condition['name']}: {value_text(values, 'm/s')}"
            entries[plain(f"{text} ({when})" if when else text)] = arrow_entry(MOTION)
        held = ~moved
        if not np.any(held):
            continue
        x, n = places[held], outward[held]
        t = np.stack([-n[:, 1], n[:, 0]], axis=1)
        axes.add_collection(LineCollection(segments_of(condition["faces"]), colors=SUPPORT,
                                           linewidths=1.4, zorder=4))
        if all(condition["prescribed"]) or condition["normal"] and any(condition["prescribed"]):
            ticks = np.stack([x, x + 0.45 * step * (n - 0.8 * t)], axis=1)
            axes.add_collection(LineCollection(ticks, colors=SUPPORT, linewidths=0.8, zorder=4))
            text = f"{condition['name']}: fixed ({when})" if when else "fixed"
            entries[plain(text)] = Line2D([], [], color=SUPPORT, markersize=9,
                                          marker=[(-0.6, -0.8), (0., 0.)])
        else:
            x = x + 0.25 * step * n
            axes.plot(*x.T, "o", color=SUPPORT, markerfacecolor="white", markersize=3.6,
                      markeredgewidth=0.8, zorder=4, linestyle="none")
            text = f"{condition['name']}: roller ({when})" if when else "roller"
            entries[plain(text)] = Line2D([], [], color=SUPPORT, marker="o", markersize=4.,
                                          markerfacecolor="white")
    return entries


def draw_acting(axes, model, stage):
    """The conditions of some stages that act in this one: a bar along their faces, and
    an arrow where they move."""
    for condition in model.data["supports"]:
        if condition.get("stages") and condition["faces"] and acts_in(condition, stage):
            values = np.array(condition["values"], dtype=float)
            index, places, outward = spaced(condition["faces"], model.size)
            moved = np.linalg.norm(values[index], axis=1) > 0.
            axes.add_collection(LineCollection(
                segments_of(condition["faces"]), zorder=4, linewidths=3.,
                colors=MOTION if np.any(moved) else SUPPORT))
            if np.any(moved):
                draw_arrows(axes, places[moved], values[index][moved], outward[moved], MOTION,
                            0.09 * model.size)


def arrow_entry(color):
    """The entry of arrows in a legend."""
    return FancyArrow(0., 0., 1., 0., color=color, width=0.05, length_includes_head=True)


class ArrowHandler(HandlerPatch):
    """Draws the arrow of a legend."""

    def create_artists(self, legend, handle, x, y, width, height, size, transform):
        arrow = FancyArrow(x, y + height / 2., width, 0., width=0.12 * height,
                           head_width=0.8 * height, length_includes_head=True,
                           color=handle.get_facecolor(), transform=transform)
        return [arrow]


def add_legend(axes, entries, below, centre=0.5):
    """Adds the legend under the axes.

    @param below so many points
    @param centre of the legend, in widths of the axes"""
    axes.legend(entries.values(), entries.keys(), loc="upper center", frameon=False,
                bbox_to_anchor=(centre, 0.), fontsize=8.5, ncols=1 if len(entries) < 5 else 2,
                bbox_transform=offset_copy(axes.transAxes, axes.figure, y=-below,
                                           units="points"),
                handler_map={FancyArrow: ArrowHandler()})


def draw_arrows(axes, places, vectors, outward, color, length):
    """Arrows whose tips are at the places if they point into the body, else their tails."""
    sizes = np.linalg.norm(vectors, axis=1)
    arrows = length * vectors / max(sizes.max(), 1e-300)
    into = np.sum(vectors * outward, axis=1) < 0.
    tails = np.where(into[:, None], places - arrows, places)
    axes.quiver(*tails.T, *arrows.T, color=color, angles="xy", scale_units="xy", scale=1.,
                width=0.0028, headwidth=4.5, headlength=5., zorder=5)


def draw_tractions(axes, model):
    """Tractions as arrows. @return entries of the legend"""
    entries = {}
    for condition in model.data["tractions"]:
        values = np.array(condition["values"], dtype=float).reshape(-1, 2)
        sizes = np.linalg.norm(values, axis=1)
        if not len(values) or not sizes.max() > 0.:
            continue
        index, places, outward = spaced(condition["faces"], model.size / 45.)
        length = 0.1 * model.size
        if np.linalg.norm(outward.mean(axis=0)) < 0.2:  # all around, e.g. a hole
            length = min(length, 0.3 * np.ptp(places, axis=0).min())
        draw_arrows(axes, places, values[index], outward, LOAD, length)
        text = f"{plain(condition['name'])}: {value_text(values, model.stress_unit)}"
        entries[text] = arrow_entry(LOAD)
    return entries


def draw_obstacles(axes, model, with_names=True):
    """Obstacles where they begin."""
    for obstacle in model.data["obstacles"]:
        triangles = np.array(obstacle["triangles"], dtype=float)
        if not len(triangles):
            continue
        axes.add_collection(PolyCollection(triangles, facecolors="#8c8c8c", edgecolors="face",
                                           linewidths=0.5, zorder=3), autolim=False)
        if not with_names:
            continue
        inside = np.clip(triangles.reshape(-1, 2), *np.array(
            [axes.get_xlim(), axes.get_ylim()]).T).mean(axis=0)
        axes.text(*inside, plain(obstacle["name"]), fontsize=8, ha="center", va="center",
                  color="white", zorder=6, clip_on=True)


def draw_structures(axes, model, stage=None, with_names=True):
    """Anchors, struts, geogrids and plates as lines with their names.

    @param stage name of one, to draw only what is there then"""
    for structure in model.data.get("structures", []):
        if stage is not None and not acts_in(structure, stage):
            continue
        points = np.array(structure["points"], dtype=float)
        look = ({"linewidth": 3.} if structure["type"] == "plate" else
                {"linewidth": 2., "marker": "o", "markersize": 3.5})
        axes.plot(*points.T, color=STRUCTURE, zorder=5, solid_capstyle="butt", **look)
        if with_names:
            width, height = np.ptp(points, axis=0)
            place = ({"xytext": (5., 0.), "ha": "left", "va": "center"} if height > width else
                     {"xytext": (0., 5.), "ha": "center", "va": "bottom"})
            axes.annotate(plain(structure["name"]), points.mean(axis=0), **place,
                          textcoords="offset points", fontsize=8, color=STRUCTURE, zorder=6,
                          annotation_clip=True)


def draw_side_names(axes, model):
    """Names of the sides beside their middles, and of holes in them, as conditions call
    them."""
    body = model.data["body"]
    style = {"textcoords": "offset points", "va": "center", "fontsize": 7,
             "color": "#303030", "zorder": 6, "bbox": {
                 "boxstyle": "round,pad=0.15", "fc": "white", "ec": "#909090", "lw": 0.5,
                 "alpha": 0.85}}
    without_number = set()
    n = len(body.get("outline", ()))
    for name, hole in body.get("holes", {}).items():
        axes.annotate(plain(name), np.mean(hole, axis=0), xytext=(0., 0.), ha="center", **style)
        if len(hole) > MOST_NUMBERS:
            without_number.update(str(i) for i in range(n, n + len(hole)))
        n += len(hole)
    for name, ends in body.get("sides", {}).items():
        if name in without_number:
            continue
        a, b = np.array(ends)
        inward = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
        # Long names begin or end at the side, not across it.
        away = "center" if abs(inward[0]) < 0.3 else "left" if inward[0] > 0. else "right"
        axes.annotate(plain(name), (a + b) / 2., ha=away,
                      xytext=(11. if away == "center" else 7.) * inward, **style)


def view_of(model):
    """Corners of the view: the body, tractions' arrows and the mesh of particles."""
    corners = np.array([model.low, model.high, *(
        point for structure in model.data.get("structures", []) for point in structure["points"])])
    held = [point for condition in model.data["supports"] for face in condition["faces"]
            for point in face]
    if held and not model.data["material_of_cell"]:
        corners = np.concatenate([corners, np.array(held)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    loads = any(np.any(condition["values"]) for kind in ("tractions", "supports")
                for condition in model.data[kind])
    margin = 0.06 * model.size
    table = water_of(model)
    if len(table):
        high = np.maximum(high, [high[0], table[:, 1].max()])
    return low - margin, high + [margin, 2.2 * margin if loads else margin]


def water_of(model):
    """The piezometric line of the start (n, 2)."""
    return table_of(model.parameters.get("Water/Table", ""))


def legend_of(model):
    """Entries of the soils."""
    absent = model.absent()
    entries = {}
    for i, name in model.materials():
        text = f"{plain(name)}" + (" (later)" if name in absent else "")
        properties = model.properties(name)
        entries[f"{text}: {properties}" if properties else text] = Patch(
            facecolor=color_of(i), edgecolor="#606060", linewidth=0.6)
    return entries


def notable_stages(model):
    """The stages whose beginning or end looks otherwise than what was before. The picture
    of the model shows all structures and conditions."""
    notable, before = [], None
    for stage in model.data["stages"]:
        acting = [acts_in(member, stage["name"]) for kind in ("supports", "structures")
                  for member in model.data.get(kind, [])]
        if (acting != before if before is not None else not all(acting)) or any(
                key in stage for key in ("removed", "removed_lattice", "added", "changed",
                                         "water_table", "water_levels")):
            notable.append(stage)
        before = acting
    return notable


def words_of(stage):
    """Changes of a stage, in a few words."""
    words = []
    if "removed" in stage or "removed_lattice" in stage:
        words.append("excavation")
    if "added" in stage:
        words.append("adds " + ", ".join(stage["added"]))
    for before, after in stage.get("changed", {}).items():
        words.append(f"{before} becomes {after}")
    if "water_table" in stage or "water_levels" in stage:
        words.append("water level")
    if "strength_factor" in stage:
        words.append(f"strength / {stage['strength_factor']:g}")
    return plain(stage["name"]) + (": " + plain("; ".join(words)) if words else "")


def frame(axes, view):
    """Sets the view of axes."""
    axes.set(xlim=(view[0][0], view[1][0]), ylim=(view[0][1], view[1][1]), aspect="equal")
    axes.grid(False)


def draw_stages(axes_of, model, stages, view):
    """A small picture of the body in each of some stages."""
    for axes, state in zip(axes_of, states_of(model, stages)):
        stage = state.stage
        frame(axes, view)
        draw_soils(axes, model, state.absent, state.now, state.done)
        draw_outlines(axes, model)
        draw_obstacles(axes, model, with_names=False)
        draw_structures(axes, model, stage["name"], with_names=False)
        draw_acting(axes, model, stage["name"])
        draw_table(axes, state.table)
        draw_free_surface(axes, model.free_surface(state.end))
        axes.set_title(words_of(stage), fontsize=8)
        axes.set(xticks=[], yticks=[])


def draw_plane(model, path):
    """The picture of a scene in the plane."""
    view = view_of(model)
    width, height = view[1] - view[0]
    stages = notable_stages(model)[:MOST_STAGES]
    w = min(9., max(3.5, 7. * width / height))
    h = w * height / width
    strip = 0. if not stages else (w / max(3, len(stages))) * height / width + 0.5
    figure, axes_of = subplots(
        2 if stages else 1, 1, squeeze=False, figsize=(w, h + strip + 0.8),
        gridspec_kw={"height_ratios": [h, strip]} if stages else None)
    main = axes_of[0, 0]
    frame(main, view)
    draw_soils(main, model, model.absent())
    draw_mesh(main, model)
    draw_outlines(main, model)
    draw_obstacles(main, model)
    draw_structures(main, model)
    entries = {**legend_of(model), **draw_supports(main, model), **draw_tractions(main, model)}
    draw_side_names(main, model)
    table = water_of(model)
    draw_table(main, table)
    surface = model.free_surface()
    draw_free_surface(main, surface)
    if len(surface):
        entries["free surface"] = Line2D([], [], color=WATER)
    if len(table):
        entries["water table"] = Line2D([], [], color=WATER, linestyle="--")
    points = np.array(model.data["observed_points"], dtype=float).reshape(-1, 2)
    if len(points):
        main.plot(*points.T, "P", color="black", markersize=6, markeredgecolor="white",
                  zorder=6, linestyle="none")
        entries["observed points"] = Line2D([], [], color="black", marker="P", linestyle="none")
    main.set(xlabel="x (m)", ylabel="y (m)", title=f"{plain(model.name)}: model")
    add_legend(main, entries, below=36.)
    if stages:
        lower = axes_of[1, 0]
        lower.axis("off")
        n = max(3, len(stages))
        insets = [lower.inset_axes([i / n, 0., 0.96 / n, 0.9]) for i in range(len(stages))]
        draw_stages(insets, model, stages, view)
    save(figure, None, path, cropped=True)


def draw(folder, path):
    """Draws the model in the folder of a run or of a check.
    @throw Missing where there is none, ReadError if it is damaged"""
    model = Model(folder)
    if model.data["dimension"] == 2:
        draw_plane(model, path)
    else:
        from geocone.plots import model_solid
        model_solid.draw(model, path)


def draw_run(run, path):
    """Draws the model of a run."""
    draw(run.folder, path)
