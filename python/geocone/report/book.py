# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The book of certified answers: brackets of limit loads and factors of safety, each verified by
scripts/check_certificate, beside published values.

A published value is exact, an upper or lower bound, an estimate, or that of another problem. An
exact value outside the bracket, an upper bound below it or a lower bound above it contradicts the
bracket. An estimate outside differs from the exact value by at least its distance from the
bracket. Values of other problems are not compared.
"""

import json
import math
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from geocone.report.figures import COLORS, MARKERS, number, percent
from geocone.report.schema import LINE, STANDINGS, takes
from geocone.runner import ROOT
from geocone.style import RATES, areas_of, level, plain, subplots


def bracket(row):
    """Both bounds, over the divisor of a check; nan if not certified."""
    bounds = row["summary"].get("bounds", {})
    return [math.nan if bounds.get(side) is None else bounds[side] / row["check"].get("divisor", 1.)
            for side in ("lower", "upper")]


def published(row):
    """The published values of a row's problem: number, standing, source."""
    values = row["check"].get("published", [])
    return values.get(str(row["axes"].get(row["check"].get("by"))), []) if isinstance(
        values, dict) else values


def name_of(row):
    """The problem, in words."""
    return ", ".join(word for word in (row["group"], row["label"]) if word)


def rounding(value):
    """The half of the last digit of a text; of a number, one of the sixth digit."""
    if isinstance(value, str):
        return 0.5 * 10.**-len(value.partition(".")[2])
    return 10.**(math.floor(math.log10(abs(value))) - 5) if value else 0.


def compared(low, high, printed, kind, source):
    """A published value beside a bracket, in words.
    @throw ValueError if it contradicts the bracket"""
    if kind == "other problem":
        return f"{number(printed, 6)}, {kind} ({source})"
    value, digits = float(printed), rounding(printed)
    above, below = value - high > digits, low - value > digits
    if (kind == "exact" and (above or below) or kind == "upper bound" and below or
            kind == "lower bound" and above):
        raise ValueError(f"{value:g} ({kind}, {source}) contradicts {low:.7g} to {high:.7g}")
    if above or below:
        near = high if above else low
        if kind == "estimate" and isinstance(printed, str):  # whatever it was before rounding
            value += -digits if above else digits
        where = percent((value - near) / abs(near), 1) + (
            " or more" if kind == "estimate" else f" from the {'upper' if above else 'lower'}")
    else:
        where = "-" if math.isnan(low + high) else "inside"
    return f"{number(printed, 6)}, {kind}: {where} ({source})"


def verified(folder):
    """The verdict of scripts/check_certificate on a run: proved, with the largest residual, or the
    reason why not."""
    said = subprocess.run([ROOT / "scripts" / "check_certificate", folder], check=False,
                          capture_output=True, text=True)
    if said.returncode:
        return "NOT PROVED: " + " ".join(
            line.partition("NOT PROVED: ")[2] for line in said.stdout.splitlines()).strip()
    sizes = [float(size) for line in said.stdout.splitlines()
             for size in re.findall(r"\de-\d+", line.partition("residuals: ")[2])]
    return f"proved ({max(sizes, default=0.):.0e})"


@takes()
def brackets(rows, _):
    """Each run: bracket, gap, verdict of the checker with the largest residual, published values
    of the group's check.
    @throw ValueError if a published value contradicts a bracket"""
    with ThreadPoolExecutor() as pool:  # each waits for a program
        verdicts = pool.map(verified, [row["folder"] for row in rows])
    lines = []
    for row, verdict in zip(rows, verdicts):
        low, high = bracket(row)
        lines.append([
            name_of(row), number(low, 5), number(high, 5),
            "-" if math.isnan(low + high) else f"{100. * (high - low) / abs(low):.2f} %",
            row["reason"] or verdict,
            "; ".join(compared(low, high, *one) for one in published(row)) or "-",
            "`" + re.sub(r" --set 'Output/(Fields|Pictures|Expectations) =[^']*'", "",
                         row["command"]) + "`"])
    return ["problem", "lower bound", "upper bound", "gap", "checker", "published",
            "command"], lines


@takes()
def chart(rows, _):
    """Brackets as error bars about their middle, with the published values of their problems."""
    figure, axes = subplots(figsize=(9.5, 1.2 + 0.24 * len(rows)))
    seen = set()
    for i, row in enumerate(rows):
        low, high = bracket(row)
        middle, size = (low + high) / 2., abs(low + high) / 2.
        axes.errorbar(0., i, xerr=50. * (high - low) / size, color=COLORS[0], capsize=3.,
                      linewidth=2.)
        for value, kind, _ in published(row):
            if kind == "other problem":
                continue
            number_of = STANDINGS.index(kind)
            axes.plot(100. * (float(value) - middle) / size, i, MARKERS[number_of],
                      color=COLORS[1 + number_of], markersize=5.,
                      label=None if kind in seen else kind)
            seen.add(kind)
    axes.set_yticks(range(len(rows)), [plain(name_of(row)) for row in rows])
    axes.tick_params(axis="y", labelsize=8)
    axes.set(xlabel="difference from the middle of the bracket (%)", ylim=(len(rows) - 0.4, -0.6))
    axes.set_xscale("symlog", linthresh=2.)
    left, right = axes.get_xlim()
    ticks = [tick for tick in (-50, -20, -10, -5, -2, -1, 0, 1, 2, 5, 10, 20, 50)
             if left <= tick <= right]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    if seen:
        axes.legend()
    return figure


@takes("x", "xlabel", "ylabel", x=LINE, xlabel=LINE, ylabel=LINE)
def curves(rows, options):
    """Brackets as error bars against an axis of the groups: a curve for each group and for each
    value of its other axes. Options: x = axis; xlabel, ylabel."""
    figure, axes = subplots(figsize=(7.5, 4.6))
    names = {}
    for row in rows:
        others = [f"{key} = {value}" if isinstance(value, (int, float)) else value
                  for key, value in row["axes"].items() if key != options["x"]]
        names.setdefault(", ".join([row["group"], *others]), []).append(row)
    for i, (name, own) in enumerate(names.items()):
        x = [row["axes"][options["x"]] for row in own]
        low, high = np.array([bracket(row) for row in own]).T
        axes.errorbar(x, (low + high) / 2., yerr=(high - low) / 2., label=plain(name),
                      color=COLORS[i % len(COLORS)], marker=MARKERS[i % len(MARKERS)],
                      markersize=3., capsize=3., linewidth=1.)
    axes.set(xlabel=options["xlabel"], ylabel=options["ylabel"])
    axes.legend()
    return figure


@takes()
def mechanisms(rows, _):
    """Speeds of the velocities that prove the upper bounds."""
    columns = 5
    count = math.ceil(len(rows) / columns)
    figure, panels = subplots(count, columns, figsize=(15., 2.1 * count), squeeze=False)
    for axes, row in zip(panels.ravel(), rows):
        data = json.loads((row["folder"] / "certificate_upper.json").read_text())
        x, cells = np.array(data["vertices"]), np.array(data["triangles"])
        speed = np.linalg.norm(data["velocity"]["vertices"], axis=1)
        axes.tripcolor(*x.T, cells, speed, cmap=RATES, shading="gouraud", vmin=0.,
                       vmax=level(speed[cells].mean(axis=1), areas_of(x[cells])) or 1.)
        axes.set_aspect("equal")
        axes.set_title(plain(name_of(row)), fontsize=7)
    for axes in panels.ravel():
        axes.axis("off")
    return figure
