# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Begins a parameter file from a drawing: the body, its layers and the water as lines of a DXF
file, by the names of their layers in it."""

import argparse
import os
import re
import sys
from pathlib import Path

from geocone.files import write_whole

Points = list[tuple[float, float]]

METRES = {0: 1., 1: 0.0254, 2: 0.3048, 4: 1e-3, 5: 1e-2, 6: 1.}  # of $INSUNITS
UNITS = {"m": 1., "cm": 1e-2, "mm": 1e-3, "ft": 0.3048, "in": 0.0254}
FLATNESS = 1e-3  # of arcs and splines, over the size of the drawing


class DrawingError(Exception):
    """A drawing that holds no model, with what is allowed and the remedy."""


def area(points: Points) -> float:
    """The area of a polygon, positive if its vertices run counterclockwise."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, [*points[1:], points[0]])) / 2


def joined(pieces: list[Points], tolerance: float) -> list[Points]:
    """Joins pieces whose ends meet; closed lines repeat their first point."""
    def meet(a, b):
        return max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= tolerance

    lines = []
    left = [list(piece) for piece in pieces]
    while left:
        line = left.pop(0)
        found = True
        while found and not meet(line[0], line[-1]):
            found = False
            for piece in left:
                for candidate in (piece, piece[::-1]):
                    if meet(line[-1], candidate[0]):
                        line += candidate[1:]
                    elif meet(line[0], candidate[-1]):
                        line = candidate[:-1] + line
                    else:
                        continue
                    left.remove(piece)
                    found = True
                    break
                if found:
                    break
        lines.append(line)
    return lines


def without_doubles(points: Points, tolerance: float) -> Points:
    """Leaves out points that repeat the one before."""
    kept = []
    for point in points:
        if not kept or max(abs(point[0] - kept[-1][0]), abs(point[1] - kept[-1][1])) > tolerance:
            kept.append(point)
    return kept


def lines_of(file: str | os.PathLike,
             unit: float | None) -> tuple[dict[str, list[Points]], float]:
    """Reads the lines of a drawing.

    Parameters
    ----------
    file
        Path of the DXF file.
    unit
        Length of its unit (m); None: as the drawing says.

    Returns
    -------
    lines : dict
        Lines (m) by the names of their layers; closed ones repeat their first point.
    tolerance : float
        Distance within which points are the same (m).

    Raises
    ------
    DrawingError
    """
    try:
        import ezdxf
        from ezdxf import path
    except ImportError as error:
        raise DrawingError("drawings are read by ezdxf, which is not installed\n"
                           "  remedy:  apt install python3-ezdxf (or pip install ezdxf)") from error
    try:
        drawing = ezdxf.readfile(file)
    except (OSError, ezdxf.DXFError) as error:
        raise DrawingError(f"'{file}' is no DXF file that can be read: {error}") from error
    if unit is None:
        code = drawing.header.get("$INSUNITS", 0)
        if code not in METRES:
            raise DrawingError(f"'{file}' has lengths in the unit {code} of $INSUNITS\n"
                               "  allowed: metres, centimetres, millimetres, feet, inches\n"
                               f"  remedy:  give --unit {' | '.join(UNITS)}")
        unit = METRES[code]
    pieces = {}
    kinds = "LINE LWPOLYLINE POLYLINE SPLINE ARC CIRCLE ELLIPSE"
    paths = [(entity.dxf.layer, path.make_path(entity))
             for entity in drawing.modelspace().query(kinds)]
    size = max((max(abs(v.x), abs(v.y)) for _, one in paths for v in one.control_vertices()),
               default=0.)
    for layer, one in paths:
        points = [(unit * v.x, unit * v.y) for v in one.flattening(FLATNESS * (size or 1.))]
        pieces.setdefault(layer, []).append(points)
    tolerance = 1e-6 * size * unit
    return {layer: [without_doubles(line, tolerance) for line in joined(parts, tolerance)]
            for layer, parts in pieces.items()}, tolerance


def text(points: Points) -> str:
    """Writes points as a parameter."""
    return "; ".join(f"{x:.10g}, {y:.10g}" for x, y in points)


def section(name: str, lines: list[str]) -> str:
    """Writes a subsection of a parameter file."""
    inside = "".join(f"  {line}\n" for line in lines)
    return f"subsection {name}\n{inside}end\n"


def supports(body: Points, tolerance: float) -> tuple[list[int], list[int]]:
    """Finds the sides of the body on its base, and the upright ones at its ends."""
    low = min(y for _, y in body)
    ends = min(x for x, _ in body), max(x for x, _ in body)
    base, upright = [], []
    for number, (a, b) in enumerate(zip(body, [*body[1:], body[0]])):
        if max(a[1], b[1]) - low <= tolerance:
            base.append(number)
        elif any(max(abs(a[0] - x), abs(b[0] - x)) <= tolerance for x in ends):
            upright.append(number)
    return base, upright


def scene_of(file: str | os.PathLike, unit: float | None = None, body: str | None = None,
             water: str = "water", holes: str = "holes") -> str:
    """Writes the parameter file of a drawing.

    The greatest closed line is the body; another closed line is a hole on the layer of holes,
    else a region, and an open one the top of what lies below it, of a material that has the
    name of the layer.

    Parameters
    ----------
    file
        Path of the DXF file.
    unit
        Length of its unit (m); None: as the drawing says.
    body, water, holes
        Names of layers.

    Returns
    -------
    str
        Text of the parameter file.

    Raises
    ------
    DrawingError
        If there is no body, or an open line turns back.
    """
    layers, tolerance = lines_of(file, unit)
    closed = [(layer, line[:-1]) for layer, lines in layers.items() for line in lines
              if len(line) > 3 and max(abs(line[0][0] - line[-1][0]),
                                       abs(line[0][1] - line[-1][1])) <= tolerance]
    empty = [line for layer, line in closed if layer.lower() == holes.lower()]
    closed = [pair for pair in closed if pair[0].lower() != holes.lower()]
    candidates = [pair for pair in closed if body in (None, pair[0])]
    if not candidates:
        raise DrawingError(
            f"'{file}' has no closed line{'' if body is None else f' on the layer {body!r}'}\n"
            f"  allowed: layers with a closed line: {', '.join(sorted({c[0] for c in closed}))}\n"
            "  remedy:  draw the body as a closed polyline, or as lines whose ends meet")
    body_layer, outline = max(candidates, key=lambda pair: abs(area(pair[1])))
    closed.remove((body_layer, outline))
    if area(outline) < 0.:
        outline = outline[::-1]
    first = min(range(len(outline)), key=lambda i: outline[i][::-1])  # the lowest, at the left
    outline = outline[first:] + outline[:first]

    parts = []  # layer, parameter, points
    tops = []
    table = None
    for layer, lines in layers.items():
        for line in lines:
            if max(abs(line[0][0] - line[-1][0]), abs(line[0][1] - line[-1][1])) <= tolerance:
                continue
            rising = line if line[0][0] < line[-1][0] else line[::-1]
            if any(b[0] <= a[0] for a, b in zip(rising, rising[1:])):
                raise DrawingError(f"the open line on the layer '{layer}' turns back at some x\n"
                                   "  allowed: open lines from left to right, closed lines\n"
                                   "  remedy:  close it: it then is the outline of a region")
            if layer.lower() == water.lower():
                table = rising
            else:
                tops.append((layer, rising))
    # From the top: each layer covers those before it.
    tops.sort(key=lambda pair: -sum(y for _, y in pair[1]) / len(pair[1]))
    parts += [(layer, "Region below", line) for layer, line in tops]
    parts += [(layer, "Region polygon", line) for layer, line in closed]

    names = []
    for layer in [body_layer, *(part[0] for part in parts)]:
        name = re.sub(r"[^\w -]", "_", layer).strip() or "soil"
        same = sum(other == name or other.startswith(name + " ") for other in names)
        names.append(name if same == 0 else f"{name} {same + 1}")
    return text_of_scene(f"the drawing {Path(file).name}, lengths in m", outline, names, parts,
                         table, empty, tolerance)


def text_of_scene(source: str, outline: Points, names: list[str], parts: list[tuple],
                  table: Points | None, empty: list[Points], tolerance: float) -> str:
    """Writes a parameter file that names its soils, of which the laws are not known.

    Parameters
    ----------
    source
        What it was made from.
    outline, empty
        The body, counterclockwise, and its holes.
    names
        Names of the materials; the first one is that of the body.
    parts
        Of each other material a name, a parameter of its region and points.
    table
        The water, if there is any.
    tolerance
        Distance within which points are the same (m).
    """
    size = (abs(area(outline)) ** 0.5) / 20.
    result = [f"# From {source}. Choose the law of each "
              "material and\n# its parameters, then look at it: "
              "geocone --dry-run THIS_FILE --picture\n",
              section("Analysis", ["set Kind = strength reduction"]),
              section("Geometry", ["set Shape   = polygon", f"set Polygon = {text(outline)}",
                                   *([f"set Holes   = {' | '.join(map(text, empty))}"]
                                     if empty else []),
                                   *(f"# side {i}: from {text([a])} to {text([b])}" for i, (a, b)
                                     in enumerate(zip(outline, [*outline[1:], outline[0]])))]),
              section("Mesh", ["set Type      = unstructured", "set Cells     = triangles",
                               f"set Cell size = {size:.3g}"])]
    materials = [f"set Names = {', '.join(names)}"]
    for name, (_, parameter, points) in zip(names, [(None, None, None), *parts]):
        lines = [f"set {'Type':14} = linear elastic # e.g. Mohr-Coulomb",
                 f"set {'Unit weight':14} = 19000 # N/m3"]
        if parameter:
            lines.append(f"set {parameter:14} = {text(points)}")
        materials += section(name, lines).splitlines()
    result.append(section("Materials", materials))
    if table:
        result.append(section("Water", [f"set Table = {text(table)}"]))
    result.append(section("Gravity", ["set Acceleration = 0, -9.81"]))
    base, upright = supports(outline, tolerance)
    held = [("base", base, ["set Velocity x = 0", "set Velocity y = 0"]),
            ("ends", upright, ["set Velocity x = 0"])]
    conditions = [f"set Names = {', '.join(name for name, sides, _ in held if sides)}"]
    for name, sides, values in held:
        if sides:
            conditions += section(
                name, [f"set Sides = {', '.join(map(str, sides))}", *values]).splitlines()
    result.append(section("Boundary conditions", conditions))
    return "".join(result)


def main(arguments: list[str], prog: str) -> int:
    """Writes the parameter file of a drawing; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog=prog, description=__doc__ + " The greatest closed line is the body; another closed "
        "line is a region, and an open one the top of what lies below it, of a material named "
        "as the layer; the open line on the layer 'water' is the water, closed ones on the "
        "layer 'holes' are holes of the body.")
    parser.add_argument("drawing", type=Path)
    parser.add_argument("scene", type=Path, help="the new parameter file")
    parser.add_argument("--unit", choices=UNITS, help="of the drawing; default: as it says")
    parser.add_argument("--body", metavar="LAYER", help="layer of the body's outline")
    parser.add_argument("--water", metavar="LAYER", default="water")
    parser.add_argument("--holes", metavar="LAYER", default="holes")
    options = parser.parse_args(arguments)
    try:
        if options.scene.exists():
            raise DrawingError(f"'{options.scene}' exists\n  remedy:  give another name")
        write_whole(options.scene, scene_of(options.drawing, UNITS.get(options.unit),
                                            options.body, options.water, options.holes))
    except (DrawingError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0
