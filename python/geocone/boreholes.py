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
from collections.abc import Iterator
from pathlib import Path

from geocone.dxf import text_of_scene, without_doubles
from geocone.files import write_whole

COLUMNS = ["borehole", "x", "top", "soil"]
END, WATER = "end", "water"


class TableError(Exception):
    """A table that holds no layers, with what is allowed and the remedy."""


def rows_of(file: str | os.PathLike) -> Iterator[tuple[int, str, float, float, str]]:
    """Reads the rows of a table that have any text: number of the line, borehole, x, top (m)
    and soil."""
    with open(file, newline="", encoding="utf-8-sig") as stream:
        rows = csv.reader(stream, skipinitialspace=True)
        columns = next(rows, [])
        if columns != COLUMNS:
            raise TableError(f"'{file}' has the columns {', '.join(columns) or '(none)'}\n"
                             f"  allowed: {', '.join(COLUMNS)}" + (
                                 "\n  remedy:  separate values by commas, and write numbers "
                                 "with decimal points" if ";" in "".join(columns) else ""))
        for row in rows:
            values = [value.strip() for value in row]
            if not any(values):
                continue
            where = f"line {rows.line_num} of '{file}'"
            if len(values) != len(COLUMNS):
                raise TableError(f"{where} has {len(values)} values\n"
                                 f"  allowed: {len(COLUMNS)}: {', '.join(COLUMNS)}\n"
                                 "  remedy:  write numbers with decimal points; commas separate "
                                 "values")
            name, x, top, soil = values
            try:
                numbers = float(x), float(top)
            except ValueError:
                numbers = (math.nan,)
            if not all(map(math.isfinite, numbers)):
                raise TableError(f"{where} has x = '{x}' and top = '{top}'\n"
                                 "  allowed: finite numbers\n"
                                 "  remedy:  write them with decimal points and without units")
            yield rows.line_num, name, *numbers, soil


def boreholes_of(file: str | os.PathLike) -> list[tuple[float, dict[str, float]]]:
    """Reads the boreholes of a table, by x: the levels (m) of the tops of the soils."""
    places, tops = {}, {}
    spelling = {word: word for word in (END, WATER)}
    try:
        for line, name, x, top, soil in rows_of(file):
            where = f"line {line} of '{file}'"
            if not re.fullmatch(r"[\w -]{1,60}", soil) or soil == "Names":
                raise TableError(f"{where}: a soil may not be called {soil!r}\n"
                                 "  allowed: up to 60 letters, digits, blanks, underscores and "
                                 "hyphens; not 'Names'")
            same = spelling.setdefault(soil.casefold(), soil)
            if same != soil:
                raise TableError(f"{where}: '{soil}' differs from '{same}' only in capitals\n"
                                 f"  remedy:  write '{same}' if it is the same")
            if places.setdefault(name, x) != x or soil in tops.setdefault(name, {}):
                raise TableError(f"{where}: the borehole '{name}' has another x, or '{soil}' a "
                                 "second time\n"
                                 "  remedy:  give a lower layer of a soil its own name")
            tops[name][soil] = top
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise TableError(f"'{file}' is no table of boreholes: {error}" + (
            "\n  remedy:  save it as UTF-8" if isinstance(error, UnicodeDecodeError) else
            "")) from error
    boreholes = sorted((places[name], tops[name]) for name in places)
    if len({x for x, _ in boreholes}) < max(2, len(boreholes)):
        raise TableError(f"'{file}' has {len(boreholes)} boreholes\n"
                         "  allowed: two or more, at different x")
    for name, levels in tops.items():
        soils = [level for soil, level in levels.items() if soil not in (END, WATER)]
        if END not in levels or not soils or max(soils) <= levels[END]:
            raise TableError(f"the borehole '{name}' has no soil above the row '{END}'\n"
                             f"  remedy:  give the depth that was reached as the soil '{END}'")
        if min(soils) < levels[END]:
            raise TableError(f"the borehole '{name}' has a soil below the row '{END}'\n"
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
    soil, its layer has no thickness there; below its end, the last soil that it met goes on."""
    boreholes = boreholes_of(file)
    names = order_of(boreholes)
    lines = {name: [] for name in names}
    bottom = min(levels[END] for _, levels in boreholes)
    for x, levels in boreholes:
        below = bottom
        for name in reversed(names):
            below = levels.get(name, below)
            lines[name].append((x, below))
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
    except (TableError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0
