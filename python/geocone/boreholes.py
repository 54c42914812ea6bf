# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Begins a parameter file from a table of boreholes: the ground, its layers and the water as
straight lines from borehole to borehole."""

import argparse
import csv
import math
import os
import re
import sys
from pathlib import Path

from geocone.dxf import text_of_scene, without_doubles
from geocone.files import write_whole

COLUMNS = ["borehole", "x", "top", "soil"]
END, WATER = "end", "water"


class TableError(Exception):
    """A table that holds no layers, with what is allowed and the remedy."""


def boreholes_of(file: str | os.PathLike) -> list[tuple[float, dict[str, float]]]:
    """Reads the boreholes of a table, by x: the levels (m) of the tops of the soils."""
    places, tops = {}, {}
    try:
        with open(file, newline="", encoding="utf-8-sig") as stream:
            rows = csv.DictReader(stream, skipinitialspace=True)
            if rows.fieldnames != COLUMNS:
                raise TableError(f"'{file}' has the columns {rows.fieldnames}\n"
                                 f"  allowed: {', '.join(COLUMNS)}")
            for row in rows:
                name, soil = str(row["borehole"]).strip(), str(row["soil"]).strip()
                x, top = float(row["x"]), float(row["top"])
                if not (math.isfinite(x) and math.isfinite(top)):
                    raise ValueError("a number is not finite")
                if not re.fullmatch(r"[\w -]{1,60}", soil):
                    raise ValueError(f"a soil may not be called {soil!r}")
                if places.setdefault(name, x) != x or soil in tops.setdefault(name, {}):
                    raise TableError(f"line {rows.line_num} of '{file}': the borehole '{name}' "
                                     f"has another x, or '{soil}' a second time\n"
                                     "  remedy:  give a lower layer of a soil its own name")
                tops[name][soil] = top
    except (OSError, UnicodeDecodeError, csv.Error, ValueError, TypeError) as error:
        raise TableError(f"'{file}' is no table of boreholes: {error}") from error
    boreholes = sorted((places[name], tops[name]) for name in places)
    if len({x for x, _ in boreholes}) < max(2, len(boreholes)):
        raise TableError(f"'{file}' has {len(boreholes)} boreholes\n"
                         "  allowed: two or more, at different x")
    for name, levels in tops.items():
        if min(levels, key=levels.get) != END or len(levels.keys() - {WATER}) < 2:
            raise TableError(f"the borehole '{name}' has no soil above the row '{END}'\n"
                             f"  remedy:  give the depth that was reached as the soil '{END}'")
    return boreholes


def order_of(boreholes: list[tuple[float, dict[str, float]]]) -> list[str]:
    """Orders the soils from the top, as each borehole has them."""
    logs = [[soil for soil in sorted(levels, key=levels.get, reverse=True)
             if soil not in (END, WATER)] for _, levels in boreholes]
    order = []
    while any(logs):
        free = [log[0] for log in logs if log and not any(log[0] in other[1:] for other in logs)]
        if not free:
            raise TableError("boreholes have the same soils in different orders\n"
                             "  remedy:  give layers that are not the same different names")
        order.append(free[0])
        logs = [log[1:] if log and log[0] == free[0] else log for log in logs]
    return order


def scene_of(file: str | os.PathLike) -> str:
    """Writes the parameter file of a table of boreholes. Where a borehole does not meet a
    soil, its layer has no thickness there."""
    boreholes = boreholes_of(file)
    names = order_of(boreholes)
    lines = {name: [] for name in names}
    for x, levels in boreholes:
        below = levels[END]
        for name in reversed(names):
            below = levels.get(name, below)
            lines[name].append((x, below))
    bottom = min(levels[END] for _, levels in boreholes)
    ground = lines[names[0]]
    size = max(boreholes[-1][0] - boreholes[0][0], max(y for _, y in ground) - bottom)
    outline = without_doubles([(ground[0][0], bottom), (ground[-1][0], bottom), *ground[::-1]],
                              1e-9 * size)
    water = [(x, levels[WATER]) for x, levels in boreholes if WATER in levels]
    return text_of_scene(f"the boreholes {Path(file).name}", outline, names,
                         [(name, "Region below", lines[name]) for name in names[1:]],
                         water, [], 1e-9 * size)


def main(arguments: list[str], prog: str) -> int:
    """Writes the parameter file of a table of boreholes; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog=prog, description=__doc__ + f" The table (CSV) has the columns {', '.join(COLUMNS)}:"
        f" a row for the top (level, m) of each layer, for the water ('{WATER}'), and for the "
        f"depth that was reached ('{END}').")
    parser.add_argument("table", type=Path)
    parser.add_argument("scene", type=Path, help="the new parameter file")
    options = parser.parse_args(arguments)
    try:
        if options.scene.exists():
            raise TableError(f"'{options.scene}' exists\n  remedy:  give another name")
        write_whole(options.scene, scene_of(options.table))
    except TableError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0
