# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures and tables that any study may show.

Each function takes the rows of the runs (runs.Computer.row) and the options of the
study file, and returns a figure of matplotlib, or the head and lines of a table.
"""

import math

import numpy as np
from matplotlib.ticker import FuncFormatter, NullFormatter

from geocone.plots.load import curve_of, draw_lines
from geocone.reader import ReadError, Run, leaves
from geocone.report.schema import FLAG, LINE, NAME, list_of, takes
from geocone.runner import ROOT
from geocone.style import BESIDE, COLORS as FEW, Skipped, plain, subplots, unit_for

COLORS = [*FEW, "#8B5A2B", "#6A3D9A", "#000000"]
MARKERS = "osD^vP*Xh<"


def value_of(row, key):
    """Value of a row for a key: an axis, or a path in the summary; or None."""
    return row["axes"].get(key, leaves(row["summary"]).get(key))


def number(value, digits=4):
    """A number of a table."""
    if value is None or value == "":
        return "-"
    if not isinstance(value, (int, float)):
        return str(value)
    return (f"{value:.0f}" if 10**digits <= abs(value) < 1e8 else f"{value:.{digits}g}")


def percent(value, digits=2):
    """A relative error of a table."""
    return "-" if value is None else f"{100. * value:+.{digits}f} %"


def plain_ticks(axis, values, n=5):
    """Plain numbers 1, 2, 5 at the ticks of a logarithmic axis."""
    low, high = min(values), max(values)
    ticks = [m * 10.**e for e in range(math.floor(math.log10(low)) - 1,
                                       math.ceil(math.log10(high)) + 1)
             for m in (1, 2, 5) if 0.8 * low <= m * 10.**e <= 1.25 * high]
    if len(ticks) > 2 * n:
        ticks = [tick for tick in ticks if f"{tick:e}"[0] == "1"]
    axis.set_ticks(ticks)
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.6g}"))
    axis.set_minor_formatter(NullFormatter())


@takes("file", file=NAME)
def picture(_, options):
    """A picture of doc/images that no runs are in, by its file name."""
    return ROOT / "doc" / "images" / options["file"]


@takes("columns", columns=list_of(list_of(LINE, 2, 2), 1))
def columns(rows, options):
    """The table of some keys: options 'columns' = [[title, key], ...], where the key
    may end with ' %' for relative numbers. Failed runs give their reason."""
    wanted = options["columns"]
    lines = []
    for row in rows:
        line = [row["group"], row["label"]]
        for _, key in wanted:
            value = value_of(row, key.removesuffix(" %"))
            line.append(percent(value) if key.endswith(" %") and value is not None
                        else number(value))
        lines.append([*line, row["reason"] or "-"])
    if not any(row["reason"] for row in rows):
        return (["runs", "", *(title for title, _ in wanted)],
                [line[:-1] for line in lines])
    return ["runs", "", *(title for title, _ in wanted), "failed"], lines


@takes(with_group=FLAG)
def load_displacement(rows, options):
    """Load-displacement curves of all rows, with their references."""
    curves, names = [], []
    for row in rows:
        try:
            curves.append(curve_of(Run(row["folder"])))
            names.append(plain(", ".join(word for word in (
                row["group"] if options.get("with_group", True) else "", row["label"])
                if word)))
        except (ReadError, Skipped):
            continue
    figure, axes = subplots(figsize=(9.5, 4.6))
    if not curves:
        axes.text(0.5, 0.5, "no run has a curve", ha="center")
        return figure
    size = np.max(np.abs(np.concatenate([curve.load for curve in curves])))
    unit = unit_for(size, "N/m")
    draw_lines(axes, names, curves, unit)
    axes.set(xlabel="displacement (mm)", ylabel=f"load ({unit[0]})")
    axes.legend(**BESIDE, title="limit load")
    return figure
