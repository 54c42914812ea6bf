# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers that a publication states beside those of runs."""

import numpy as np

from geocone.report.figures import number, percent, value_of
from geocone.report.paper import energy_numbers, load_numbers, statistics
from geocone.report.schema import (LINE, NUMBER, VALUE, Kind, any_of, between, list_of,
                                   table_of, takes)


def load_of(row, name):
    """A load of a footing (N/m): one of load_numbers(), or 'at 0.5 s'."""
    if name.startswith("at "):
        table = statistics(row)
        time = float(name.removeprefix("at ").removesuffix(" s"))
        return table["load (N/m)"][np.argmin(np.abs(table["time (s)"] - time))]
    return load_numbers(row)[name]


def measured(row, value):
    """The number that 'value' of a line names, of a run."""
    kind, _, name = value.partition(": ")
    if kind in ("load", "load / Prandtl", "load / Prandtl excess"):
        name, _, part = name.partition(" / ")
        load, reference = load_of(row, name), row["summary"]["limit_load"]["reference"]
        if kind == "load":
            return load
        if kind == "load / Prandtl":  # of a width in terms of that of the scene
            return load / reference / float(part or 1)
        return load / reference - 1.
    if kind == "energy":
        return energy_numbers(row)[name]
    found = value_of(row, value)
    if not isinstance(found, (int, float)):
        raise ValueError(f"{value}: no such number in summary.json")
    return found


def row_of(rows, group, axes):
    """The only run of a group with some values of its axes."""
    good = [row for row in rows if row["group"] == group and
            all(row["axes"].get(axis) == value for axis, value in axes.items())]
    if len(good) != 1:
        raise ValueError(f"{len(good)} runs of '{group}' with {axes}")
    return good[0]


def difference(value, stated):
    """A value against a number, in per cent, or against a range, or '-'."""
    if stated is None:
        return "-"
    if not isinstance(stated, list):
        return percent(value / stated - 1., 1)
    low, high = stated
    return ("inside" if low <= value <= high else
            f"{number(value - high, 3)} above" if value > high else
            f"{number(low - value, 3)} below")


LINE_OF_NUMBERS = {"what": LINE, "paper": LINE, "stated": any_of(NUMBER, list_of(NUMBER, 2, 2)),
                   "group": LINE, "run": table_of(VALUE), "value": LINE,
                   "over": table_of(VALUE), "scale": NUMBER, "digits": between(1, 10, True),
                   "why": LINE}
REQUIRED = {"what", "paper", "group", "value"}


@takes("lines", lines=list_of(Kind(
    lambda line: isinstance(line, dict) and REQUIRED <= line.keys() <= LINE_OF_NUMBERS.keys() and
    all(LINE_OF_NUMBERS[key].holds(value) for key, value in line.items()),
    "a table with what, paper, group, value; stated, run, over, scale, digits, why"), 1))
def numbers(rows, options):
    """Head and lines: a number of the paper beside ours. Options: lines, each with what (it
    is), paper (its words), stated (the number, or a range), group and run ({axis = value}),
    value (a key of summary.json; 'load: largest | first | last | late | at 0.5 s'; 'load /
    Prandtl: NAME / WIDTHS'; 'load / Prandtl excess: NAME'; 'energy: NAME'), over (the run
    whose value divides it), scale (a factor), digits, why (they differ)."""
    lines = []
    for line in options["lines"]:
        def value_in(axes, line=line):
            row = row_of(rows, line["group"], axes)
            return row, (measured(row, line["value"]) * line.get("scale", 1.)
                         if row["status"] == "finished" else None)
        row, value = value_in(line.get("run", {}))
        if value is not None and "over" in line:
            _, divisor = value_in(line["over"])
            value = None if divisor is None else value / divisor
        lines.append([
            line["what"], line["paper"],
            f"failed: {row['reason']}" if value is None else
            number(value, line.get("digits", 3)),
            "-" if value is None else difference(value, line.get("stated")),
            line.get("why", "-"),
            "`" + row["command"].replace(" --set 'Output/Pictures = false'", "") + "`"])
    return ["quantity", "paper", "geocone", "difference", "why", "command"], lines
