# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers that a publication states beside those of runs."""

import numpy as np

from geocone.report.figures import number, percent, value_of
from geocone.report.paper import energy_table, statistics
from geocone.report.schema import LINE, NUMBER, VALUE, Kind, any_of, between, list_of, table_of, takes


def load_of(row, name):
    """A load of a footing by its name (N/m): largest, first, last, late (the mean of the
    second half), or at a time in s; None if it has none of this name."""
    table = statistics(row)
    load, time = table["load (N/m)"], table["time (s)"]
    if name.startswith("at "):
        return load[np.argmin(np.abs(time - float(name.removeprefix("at ").removesuffix(" s"))))]
    return {"largest": load.max, "first": lambda: load[0], "last": lambda: load[-1],
            "late": load[time > time[-1] / 2.].mean}[name]()


def energy_of(row, name):
    """A number of the energies of section 5.2 by its name."""
    time, e = energy_table(row)
    loss = e["total"][0] - e["total"][-1]
    return {"released": e["potential"][0], "dissipated": e["dissipation"][-1],
            "loss / released": loss / e["potential"][0],
            "loss / initial": loss / row["summary"]["energy"]["initial_J_per_m"],
            "time of the largest kinetic": time[np.argmax(e["kinetic"])],
            "largest rise of the total": max(0., np.diff(e["total"]).max())}[name]


def measured(row, value):
    """What a run has found, by the words of a line's 'value'."""
    kind, _, name = value.partition(": ")
    if kind == "load":
        return load_of(row, name)
    if kind == "load / Prandtl":  # of a width in terms of that of the scene
        name, _, part = name.partition(" / ")
        return load_of(row, name) / row["summary"]["limit_load"]["reference"] / float(part or 1)
    if kind == "load / Prandtl excess":
        return load_of(row, name) / row["summary"]["limit_load"]["reference"] - 1.
    if kind == "energy":
        return energy_of(row, name)
    found = value_of(row, value)
    if not isinstance(found, (int, float)):
        raise ValueError(f"{value}: no such number in summary.json")
    return found


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
    Prandtl: NAME / WIDTHS'; 'load / Prandtl excess: NAME'; 'energy: NAME'), over (the run whose value divides it), scale (a
    factor), digits, why (they differ)."""
    lines = []
    for line in options["lines"]:
        def found(axes, line=line):
            good = [row for row in rows if row["group"] == line["group"] and
                    all(row["axes"].get(axis) == value for axis, value in axes.items())]
            if len(good) != 1:
                raise ValueError(f"{line['what']}: {len(good)} runs of '{line['group']}' with {axes}")
            return good[0]
        row = found(line.get("run", {}))
        head = [line["what"], line["paper"]]
        rest = [line.get("why", "-"),
                "`" + row["command"].replace(" --set 'Output/Pictures = false'", "") + "`"]
        if row["status"] != "finished":
            lines.append([*head, f"failed: {row['reason']}", "-", *rest])
            continue
        value = measured(row, line["value"]) * line.get("scale", 1.)
        if "over" in line:
            value /= measured(found(line["over"]), line["value"]) * line.get("scale", 1.)
        lines.append([*head, number(value, line.get("digits", 3)),
                      difference(value, line.get("stated")), *rest])
    return ["quantity", "paper", "geocone", "difference", "why", "command"], lines
