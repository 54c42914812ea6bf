# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How pictures look, and how they are written: colours, units, axes, disks, files.

pyplot is not used: it takes long to load, and keeps figures that nobody shows."""

import contextlib
import io
import os
import textwrap

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import (EllipseCollection, LineCollection, PolyCollection,
                                    TriMesh)
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

from geocone.files import add_to_list, claim, write_whole
from geocone.reader import Missing

# Okabe and Ito's colours and these maps are clear to colour-blind readers too.
BLUE, ORANGE, GREY, WATER = "#0072B2", "#E69F00", "#a0a0a0", "tab:blue"
COLORS = [BLUE, "#D55E00", "#009E73", "#CC79A7", ORANGE, "#56B4E9", "#505050"]
STEPS = ListedColormap(matplotlib.colormaps["viridis"](np.linspace(0., 0.92, 256)))
RATES = ListedColormap(matplotlib.colormaps["magma_r"](np.linspace(0.06, 1., 256)))
RATES.set_extremes(under="#ececec", bad="#ececec")
STRAINS, RATIOS = matplotlib.colormaps["viridis"], matplotlib.colormaps["cividis"]
for colors in STRAINS, RATIOS:
    colors.set_extremes(under="#d4d4d4", bad="#d4d4d4")  # hardly deformed
SHOWN = 1e-3  # a rate below this part of level() is drawn as none: it is elastic noise
EXCEEDED = 0.02  # part of the area whose values are beyond the end of the colours
MOST_PATHS = 3000  # that a vector file has of one collection
# A legend's place. Its lines are as long as dashes need to be seen.
BESIDE = {"loc": "upper left", "bbox_to_anchor": (1., 1.02), "handlelength": 3.}

matplotlib.rcdefaults()  # not what a file in the folder of the call may say, e.g. to run TeX
matplotlib.rcParams.update({
    "font.size": 11, "axes.titlesize": 12, "legend.fontsize": 10,
    "axes.grid": True, "grid.color": "#e0e0e0", "axes.axisbelow": True,
    "legend.framealpha": 1., "legend.edgecolor": "#c0c0c0",
    "savefig.dpi": 200, "savefig.bbox": "tight", "savefig.pad_inches": 0.08})


class PlotError(Exception):
    """Error that ends the drawing, reported to the user."""


class Skipped(Exception):
    """Why a picture is not drawn."""


def in_plane(field):
    """@throw Skipped if the points of a field are in three dimensions"""
    if field.points.shape[1] == 3:
        raise Skipped("points that stay are drawn in the plane only")


def plain(text, longest=100):
    """A text from outside as a picture may show it: none of it is typeset as
    mathematics, nor hidden from a legend, as matplotlib does with '$' and '_'."""
    text = "".join(c if c.isprintable() else "?" for c in str(text))
    if len(text) > longest:
        text = text[:longest - 1] + "…"
    return (" " if text.startswith("_") else "") + text.replace("$", r"\$")


def unit_for(size, name):
    """The unit in which numbers up to a size are given: its name and value. Numbers in kPa,
    kN or kJ, of scenes in these units, are shown in these or in larger ones."""
    if name.startswith(("kPa", "kN", "kJ")):
        name, value = unit_for(max(1e3 * size, 1e4), name[1:])
        return name, value / 1e3
    power = (2 if size >= 1e7 else 1 if size >= 1e4 else 0 if size >= 1e-2 or size == 0.
             else -1 if size >= 1e-5 else -2 if size >= 1e-8 else -3)
    return ["", "k", "M", "n", "µ", "m"][power] + name, 1e3**power


def subplots(*shape, figsize, **options):
    """A figure and its axes, as pyplot's."""
    figure = Figure(figsize, dpi=matplotlib.rcParams["savefig.dpi"],
                    layout=ConstrainedLayoutEngine(h_pad=0.07, w_pad=0.07))
    FigureCanvasAgg(figure)
    return figure, figure.subplots(*shape, **options)


def level(values, areas, part=EXCEEDED):
    """Value that a part of the area exceeds, where colours end: a few extreme places, as the
    edge of a footing or a node without mass, do not set the scale."""
    order = np.argsort(values)
    below = np.cumsum(areas[order])
    return values[order][min(np.searchsorted(below, (1. - part) * below[-1]), len(order) - 1)]


def areas_of(corners):
    """Areas of triangles or quadrilaterals, given their corners (n, 3 or 4, dimension)."""
    sides = corners[:, 1:] - corners[:, :1]
    sides = np.pad(sides, ((0, 0), (0, 0), (0, 3 - sides.shape[2])))
    return 0.5 * np.linalg.norm(np.cross(sides[:, :-1], sides[:, 1:]).sum(axis=1), axis=1)


def sizes_of(field):
    """Areas of the cells of a field in the plane or their volumes in space (of hexahedra as
    if they were parallelepipeds), or areas or volumes of its points."""
    if field.cells.shape[1] > 2:
        corners = field.points[field.cells]
        if corners.shape[2] == 2:
            return areas_of(corners)
        edges = [1, 3, 4] if corners.shape[1] == 8 else [1, 2, 3]
        return np.abs(np.linalg.det(corners[:, edges] - corners[:, :1]))
    of_points = field.data.get("area", field.data.get("volume"))  # area: of an axisymmetric body
    return np.ones(len(field.points)) if of_points is None else of_points[:, 0]


def columns_of(n, ratio):
    """Columns of n panels, each so many times as wide as high: a figure not much wider or
    higher than a page, without empty places as far as possible."""
    def badness(columns):
        rows = -(-n // columns)
        return abs(np.log(ratio * columns / rows / 1.5)) + 4. * (rows * columns - n) / n
    return min(range(1, n + 1), key=badness)


def panels(n, view):
    """A figure with n equal axes that show the view, (low, high) corners."""
    width, height = view[1] - view[0]
    ratio = width / height
    columns = columns_of(n, ratio)
    shape = np.array([-(-n // columns), columns])
    # Of many panels only the outer ones have labels.
    w = min((4.5 if shape.min() > 1 or columns > 2 else 6.) * min(1., max(0.4, ratio)), 8. * ratio)
    labels = [1.9, 1.] if n < 3 else [0.6, 0.5]
    figure, axes = subplots(*shape, squeeze=False,
                            figsize=shape[::-1] * ([w, w / ratio] + np.array(labels)))
    for ax in axes.flat:
        ax.set(xlim=(view[0][0], view[1][0]), ylim=(view[0][1], view[1][1]),
               aspect="equal", xlabel="x (m)", ylabel="y (m)")
        ax.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
        ax.grid(False)
    for ax in axes.flat[n:]:
        ax.remove()
    return figure, axes.flat[:n]


def add_bar(axes, drawn, label, **options):
    """Adds a colour bar as high as the axes."""
    bar = axes.inset_axes([1.02, 0., 0.025, 1.])
    axes.figure.colorbar(drawn, cax=bar, label=label, **options)


def table_of(text):
    """A piezometric line of a parameter file, x, y; x, y; ..., as an array (n, 2)."""
    return np.array([tuple(map(float, point.split(","))) for point in text.split(";")
                     if point.strip()])


def water_tables(run, time=None):
    """The piezometric lines of a run at a time, or at its end, as arrays of x, y: that of the
    start or of the last stage that has led to another one; while a stage does, both."""
    try:
        tables = [table_of(run.parameters.get("Water/Table", ""))]
    except Missing:
        return []
    if time is None:
        try:
            time = float(run.statistics["time (s)"][-1])
        except (Missing, KeyError, IndexError):  # of bounds, which know no stages
            time = 0.
    begin = 0.
    for stage in run.parameters.get("Loading/Stages", "").split(","):
        section = f"Loading/{stage.strip()}/"
        end = begin + float(run.parameters.get(section + "Duration", 1.))
        table = table_of(run.parameters.get(section + "Water table", ""))
        if len(table) and time > begin:
            tables = [table] if time >= end * (1. - 1e-9) else [tables[-1], table]
        begin = end
    return [table for table in tables if len(table)]


def draw_table(axes, table):
    """Draws a piezometric line (n, 2), with its triangle."""
    if len(table) == 0:
        return
    x, y = table.T
    low, high = axes.get_xlim()
    x, y = [min(low, x[0]), *x, max(high, x[-1])], [y[0], *y, y[-1]]
    axes.autoscale(False)
    axes.plot(x, y, color=WATER, linewidth=1.5, linestyle=(0, (6, 2)), zorder=4.5)
    place = low + 0.96 * (high - low)
    axes.plot(place, np.interp(place, x, y), "v", color=WATER, markersize=7,
              markerfacecolor="white", zorder=4.5)


def draw_free_surface(axes, surface):
    """Draws the segments (n, 2, 2) of the free surface of a flow."""
    axes.add_collection(LineCollection(surface, colors=WATER, linewidths=1.5, zorder=4.5),
                        autolim=False)


def draw_water(axes, run, time=None):
    """Draws the tables of the water of a run, if there are any, at a time or at its end."""
    for table in water_tables(run, time):
        draw_table(axes, table)


def obstacles_of(run, time=None):
    """The triangles (n, 3, 2) that the obstacles of a run in the plane fill at a time, or at
    its end; none where there are no obstacles."""
    none = np.empty((0, 3, 2))
    try:
        field = run.obstacles(time)
    except Missing:
        return none
    return field.points[field.cells] if field.points.shape[1] == 2 else none


def draw_obstacles(axes, triangles):
    """Draws the triangles of obstacles in the plane. @return what is drawn"""
    drawn = PolyCollection(triangles, facecolors="#8c8c8c", edgecolors="face", linewidths=0.5)
    axes.add_collection(drawn, autolim=False)
    return drawn


def with_obstacles(run, view):
    """A view (low, high) made so large that obstacles which reach into it at the end are
    seen, by a tenth of its size at most."""
    low, high = (np.array(corner, dtype=float) for corner in view)
    margin = 0.1 * np.max(high - low)
    corners = obstacles_of(run).reshape(-1, 2)
    near = corners[np.all((corners >= low - margin) & (corners <= high + margin), axis=1)]
    if len(near):
        low, high = np.minimum(low, near.min(axis=0)), np.maximum(high, near.max(axis=0))
    return low, high


def disks(axes, field, values):
    """A disk for each point of a field, coloured by its value, the greatest in front;
    its size is that of the point, as far as is known."""
    points = field.points
    if "volume" in field.data:
        area = field.data.get("area", field.data["volume"])  # of an axisymmetric body
        size = 1.2 * np.sqrt(area[:, 0])
        # Points that fly may have grown without limit.
        size = np.minimum(size, np.quantile(size, 0.98))
    else:
        # About as large as the smaller triangles around the points: the larger
        # ones may bridge what is outside of the domain.
        corners = Triangulation(*points.T).triangles
        (ax, ay), (bx, by) = (np.diff(points[corners[:, [0, i]]], axis=1)[:, 0].T
                              for i in (1, 2))
        area = np.repeat(np.abs(ax * by - ay * bx), 3)
        number = np.bincount(corners.ravel(), minlength=len(points))
        order = np.lexsort((area, corners.ravel()))
        size = 0.9 * np.sqrt(area[order][np.cumsum(number) - number + number // 3])
    view = np.ptp([axes.get_xlim(), axes.get_ylim()], axis=1)
    upwards = np.argsort(values)
    size = np.maximum(size, view.max() / 500.)[upwards]
    return EllipseCollection(size, size, 0. * size, units="xy", linewidths=0.,
                             offsets=points[upwards], array=values[upwards],
                             offset_transform=axes.transData)


# Folders of the runs whose warning is in a picture.
warned = set()


def annotate(figure, run):
    """Says under the title of a picture that its run has not finished, and at the foot
    of the run's first picture what it warned of."""
    if run.status != "finished":
        title = figure._suptitle or figure.axes[0].title
        title.set_text(title.get_text() + "\n ")
        figure.axes[0].annotate(
            plain(run.status.split(" remedy:")[0]), (0.5, 0.), xycoords=title,
            ha="center", va="bottom", fontsize=9, color="#c00000", in_layout=False,
            annotation_clip=False)
    if run.warnings and run.folder not in warned:
        warned.add(run.folder)
        more = len(run.warnings) - 1
        text = f"warning: {plain(run.warnings[0], 300)}" + (
            f" (+ {more} more, see log.txt)" if more else "")
        figure.text(0.01, -0.01, textwrap.fill(text, int(16. * figure.get_figwidth())),
                    fontsize=8, color="#606060", va="top")


def rasterize(figure):
    """Makes fields of many cells images in vector files, which would be huge otherwise."""
    for axes in figure.findobj(Axes):
        for collection in axes.collections:
            paths = max(len(collection.get_paths()), len(collection.get_offsets()))
            if isinstance(collection, TriMesh) or paths > MOST_PATHS:
                collection.set_rasterized(True)


def write_figure(figure, paths, cropped):
    """Writes a figure into files. One with equal axes or a foot is cropped, which
    draws it twice."""
    if not cropped:
        figure.get_layout_engine().execute(figure)
        figure.set_layout_engine("none")
    rasterize(figure)
    for path in paths:
        try:
            with matplotlib.rc_context({"savefig.bbox": "tight" if cropped else None}):
                stream = io.BytesIO()
                figure.savefig(stream, format=path.suffix[1:], **(
                    {"pil_kwargs": {"compress_level": 3}} if path.suffix == ".png" else {}))
                write_whole(path, stream.getvalue())
        except (OSError, ValueError) as problem:
            raise PlotError(f"'{path}' cannot be written: {problem}")


# Lists of figures that are kept and not written, the innermost one last.
keeping = []


@contextlib.contextmanager
def kept():
    """The list of the figures that are saved within: they are kept, and not written."""
    keeping.append([])
    try:
        yield keeping[-1]
    finally:
        keeping.pop()


# Processes that write figures: number, where their errors are read, the files.
writers = []


def save(figure, run, *paths, cropped=False):
    """Writes the figure of a run, or of several (None), as a process of its own: most
    of the time goes into this. finish() waits for them."""
    if keeping:
        keeping[-1].append(figure)
        return
    for path in paths:
        claim(path)
    if run:
        annotate(figure, run)
        cropped = cropped or bool(figure.texts)
    while len(writers) >= len(os.sched_getaffinity(0)):
        finish(1)
    source, sink = os.pipe()
    process = os.fork()
    if process == 0:
        error = b""
        try:
            write_figure(figure, paths, cropped)
        except Exception as problem:  # reported by the parent
            error = str(problem).encode("utf-8", "replace")
        os.write(sink, error)
        os._exit(0 if not error else 1)
    os.close(sink)
    writers.append((process, source, paths))


def finish(most=None):
    """Waits for figures, all or some, and prints the names of their files."""
    for process, source, paths in writers[:most]:
        writers.pop(0)
        with open(source, "rb") as pipe:
            error = pipe.read().decode()
        if os.waitpid(process, 0)[1] != 0:
            raise PlotError(error or f"'{paths[0]}' cannot be written")
        for path in paths:
            add_to_list(path)
            print(path)
