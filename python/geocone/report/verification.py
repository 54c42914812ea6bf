# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of studies/verification.toml: limit loads, orders, cost.

`table` has a line for each run. Options: columns, names of COLUMNS; axes, which have a
column each ("group" is that of the run) instead of one with the name of the run, and
their titles if these differ.
"""

import math
import statistics

from geocone.reader import read_table
from geocone.report.figures import percent, value_of
from geocone.report.schema import FLAG, LINE, VALUE, list_of, takes, words

MOVED = 0.00301  # m; loads of a footing that moves on are those beyond


def steps(row):
    """The columns of statistics.csv."""
    return read_table(row["folder"] / "statistics.csv")


def last_ratio(row):
    """Load of the last step over the exact one (-)."""
    limit = row["summary"]["limit_load"]
    return limit["last"] / limit["reference"]


def associated(row, rows):
    """The run of the same group and axes, but with the first `theta`."""
    def others(a):
        return a["group"], {**a["axes"], "theta": None}
    return next(other for other in rows if others(other) == others(row))


def error_of(row):
    """Relative error of the limit load, or None."""
    return value_of(row, "limit_load/relative_error")


def order(row, rows):
    """log2 of the ratio of the errors, that of the run before in its group over its
    own: cells are half as large in each."""
    group = [other for other in rows if other["group"] == row["group"]]
    before = group[group.index(row) - 1] if group.index(row) else None
    if before is None or not error_of(before) or not error_of(row):
        return "-"
    return f"{math.log2(error_of(before) / error_of(row)):.2f}"


def iterations(row):
    """Mean and largest number of iterations per step."""
    newton = row["summary"]["newton"]
    return f"{newton['iterations_mean']:.1f} / {newton['iterations_max']}"


def plateau(row):
    """The loads of a footing that moves, over the exact one."""
    table = steps(row)
    return (table["load (N/m)"][table["displacement (m)"] > MOVED] /
            row["summary"]["limit_load"]["reference"]).tolist()


def count(row, name):
    """A number of the last step that is a count; - if there is none."""
    last = steps(row)[name][-1]
    return f"{last:.0f}" if last else "-"


def number(key, form):
    """The column of a value of the summary."""
    def cell(row, _):
        value = value_of(row, key)
        return "-" if value is None else format(value, form)
    return cell


COLUMNS = {  # the cell of a run; all runs of the table are its second argument
    "unknowns": number("size/dofs", "d"),
    "limit load (N/m)": number("limit_load/value", ".2f"),
    "error": lambda row, _: percent(error_of(row), 3),
    "error of the last load": lambda row, _: percent(last_ratio(row) - 1., 1),
    "order": order,
    "band": lambda row, _: "{band_low:.0f} to {band_high:.0f}".format(
        **row["summary"]["limit_load"]),
    "ratio": lambda row, rows: "{:.3f}".format(
        value_of(row, "limit_load/value") /
        value_of(associated(row, rows), "limit_load/value")),
    "ratio of last loads": lambda row, rows: "{:.3f}".format(
        last_ratio(row) / last_ratio(associated(row, rows))),
    "iterations per step, mean / max": lambda row, _: iterations(row),
    "failed steps": number("newton/failures", "d"),
    "step loop (s)": number("cost/step_loop_s", ".1f"),
    "largest residual": number("newton/residual_max", ".0e"),
    "complementarity": number("quality/complementarity_max", ".0e"),
    "mean": lambda row, _: f"{statistics.mean(plateau(row)):.3f}",
    "standard deviation": lambda row, _: f"{statistics.stdev(plateau(row)):.3f}",
    "last": lambda row, _: f"{last_ratio(row):.3f}",
    "conditions": lambda row, _: count(row, "multiplier rows given (-)"),
    "independent": lambda row, _: count(row, "multipliers (-)")}
SOME = list_of(words(*COLUMNS))


def cells(row, rows, columns):
    """The cells of a run; of one that has failed only the first one says so."""
    if row["status"] != "finished":
        return ["failed", *["-"] * (len(columns) - 1)]
    return [COLUMNS[column](row, rows) for column in columns]


@takes("columns", columns=SOME, axes=list_of(LINE, 1), titles=list_of(LINE, 1), with_group=FLAG)
def table(rows, options):
    """A line for each run: its axes or its name, and some columns."""
    axes, columns = options.get("axes"), options["columns"]
    lines = []
    for row in rows:
        name = ([row["group"] if axis == "group" else row["axes"][axis] for axis in axes]
                if axes else
                [", ".join(filter(None, (row["group"] if options.get("with_group", True)
                                         else "", row["label"])))])
        lines.append([*name, *cells(row, rows, columns)])
    return [*options.get("titles", axes or ["run"]), *columns], lines


@takes("columns", "of", columns=SOME, of=VALUE)
def angles(rows, options):
    """Errors of last loads, a column for each `phi`, their spread, the order of their
    mean, and the columns of the angle `of`. A line for each group and `dx`."""
    phis = list(dict.fromkeys(row["axes"]["phi"] for row in rows))
    lines, means, columns = [], {}, options["columns"]
    for row in rows:
        if row["axes"]["phi"] != options["of"]:
            continue
        parts = [other for other in rows if other["group"] == row["group"] and
                 other["axes"]["dx"] == row["axes"]["dx"]]
        good = all(part["status"] == "finished" for part in parts)
        errors = [last_ratio(part) - 1. for part in parts] if good else []
        # Errors that change their sign have no order.
        before, now = means.get(row["group"]), None
        if good and min(errors) > 0.:
            now = means[row["group"]] = statistics.mean(errors)
        lines.append([
            row["axes"]["dx"], row["group"],
            *(percent(error, 1) for error in errors or [None] * len(phis)),
            f"{100. * (max(errors) - min(errors)):.1f} %" if good else "-",
            f"{math.log2(before / now):.2f}" if before and now else "-",
            *cells(row, rows, columns)])
    return (["dx", "points", *(f"phi = {phi}" for phi in phis), "spread", "order",
             *columns], lines)


@takes()
def elastic_orders(rows, _):
    """Relative errors on the finer one of two meshes of each element, and orders."""
    lines = []
    for element in dict.fromkeys(row["axes"]["element"] for row in rows):
        errors = [row["summary"].get("field_errors") for row in rows
                  if row["axes"]["element"] == element]
        lines.append([element, *(
            f"{errors[1][name]:.2e}, order "
            f"{math.log2(errors[0][name] / errors[1][name]):.2f}" if all(errors)
            else "failed" for name in ("displacement", "stress"))])
    return ["element", "displacement", "stress"], lines
