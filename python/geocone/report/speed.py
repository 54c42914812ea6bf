# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Speed against error: methods at equal error, not at equal tolerance or mesh.

A group of runs is a method. Its axis `mesh` refines; other axes are cases that must
not be mixed (friction angle, surface of the footing); `repetition` gives the spread
of times.
"""

import math
import statistics
from collections import namedtuple

import numpy as np
from matplotlib.ticker import NullFormatter

from geocone.report.figures import (COLORS, MARKERS, number, percent, plain_ticks,
                                    value_of)
from geocone.report.schema import (LINE, POSITIVE, VALUE, between, list_of, table_of,
                                   takes, words)
from geocone.style import BESIDE, plain, subplots

# A method on a mesh in a case; time (s): median, least and largest of the
# repetitions; ratio: time over that of one factorisation of the same matrix.
Point = namedtuple("Point", "method case mesh error time fastest slowest repetitions "
                   "ratio dofs iterations cost")
UNITS = {"time": "time of the whole run (s)",
         "ratio": "time / one factorisation of the same matrix (-)",
         "dofs": "unknowns (-)"}
AXES = ("error", *UNITS)
SPLIT = [("factorise_s", "factorisation"), ("solve_s", "solution"),
         ("residual_s", "residual"), ("assembly_s", "assembly"),
         ("analyse_s", "symbolic analysis"), ("transfer_s", "transfer, particles"),
         ("commit_s", "update of points")]


def case_of(row):
    """The axes that are neither the mesh nor the repetition, as items."""
    return tuple((name, value) for name, value in row["axes"].items()
                 if name not in ("mesh", "repetition"))


def case_name(case):
    """A case in words."""
    return ", ".join(f"{name} = {value}" if isinstance(value, (int, float)) else value
                     for name, value in case)


def points_of(rows, cost_of="total_s"):
    """The points of all methods: repetitions are one point. Failed runs have none.

    @param cost_of what of the topic "cost" is their time"""
    together = {}
    for row in rows:
        if row["status"] == "finished":
            key = row["group"], case_of(row), row["axes"].get("mesh")
            together.setdefault(key, []).append(row)
    points = []
    for (method, case, mesh), runs in together.items():
        cost = runs[0]["summary"]["cost"]
        times = [run["summary"]["cost"][cost_of] for run in runs]
        one = statistics.median(run["summary"]["cost"]["factorise_s"] /
                                max(1, run["summary"]["cost"]["factorisations"])
                                for run in runs)
        points.append(Point(
            method, case, mesh, value_of(runs[0], "limit_load/relative_error"),
            statistics.median(times), min(times), max(times), len(runs),
            statistics.median(times) / one, runs[0]["summary"]["size"]["dofs"],
            runs[0]["summary"]["newton"]["iterations_mean"], cost))
    return [point for point in points if point.error is not None]


def unique(values):
    """The values in the order of their first appearance."""
    return list(dict.fromkeys(values))


def style(i, method):
    """How the curve of a method is drawn: FEM full, MPM dashed."""
    return {"color": COLORS[i % len(COLORS)], "marker": MARKERS[i % len(MARKERS)],
            "linestyle": "-" if method.startswith("FEM") else (0, (4, 2)),
            "markersize": 5., "linewidth": 1.3}


@takes(x=words(*AXES), y=words(*AXES), columns=between(1, 20, True))
def work_precision(rows, options):
    """Cost against error: a curve for each method, a panel for each case. Options:
    x, y (error, time, ratio, dofs)."""
    points = points_of(rows)
    x, y = options.get("x", "error"), options.get("y", "time")
    cases, methods = unique(p.case for p in points), unique(row["group"] for row in rows)
    n_columns = min(len(cases), options.get("columns", 4))
    n_rows = -(-len(cases) // n_columns)
    figure, axes = subplots(
        n_rows, n_columns, squeeze=False, sharex=True, sharey=True,
        figsize=(2. + 3.3 * n_columns, 0.9 + 3.3 * n_rows))

    def get(point, what):
        return 100. * abs(point.error) if what == "error" else getattr(point, what)
    for ax in axes.flat[len(cases):]:
        ax.remove()
    for ax, case in zip(axes.flat, cases):
        for i, method in enumerate(methods):
            line = [p for p in points if (p.case, p.method) == (case, method)]
            ax.loglog([get(p, x) for p in line], [get(p, y) for p in line],
                      label=plain(method), **style(i, method))
            if y == "time" and x == "error":
                ax.vlines([get(p, x) for p in line], [p.fastest for p in line],
                          [p.slowest for p in line], color=COLORS[i % len(COLORS)],
                          linewidth=3., alpha=0.35)
        ax.set_title(plain(case_name(case)))
        ax.grid(True, which="major")
    words = {"error": "error of the limit load (%)", **UNITS}
    figure.supxlabel(words[x])
    figure.supylabel(words[y])
    plain_ticks(axes.flat[0].xaxis, [get(p, x) for p in points], 4)
    plain_ticks(axes.flat[0].yaxis, [get(p, y) for p in points], 4)
    axes[0, -1].legend(**BESIDE)
    return figure


def time_at(points, error):
    """The time at which the points of a method (in one case) reach an error, by lines
    between them in the logarithms; and whether an end had to be prolonged, at most to
    half of its smallest error. None if it is not reached.

    A method that starts below the error takes the time of its coarsest mesh."""
    pairs = sorted(((abs(p.error), p.time) for p in points), reverse=True)
    if not pairs:
        return None
    if pairs[0][0] <= error:
        return pairs[0][1], False
    for (e0, t0), (e1, t1) in zip(pairs, pairs[1:]):
        if e1 <= error <= e0:
            s = math.log(e0 / error) / math.log(e0 / e1)
            return t0 * (t1 / t0)**s, False
    if len(pairs) > 1 and error >= 0.5 * pairs[-1][0]:
        (e0, t0), (e1, t1) = pairs[-2:]
        if e0 > e1 and t1 > t0:
            s = math.log(e0 / error) / math.log(e0 / e1)
            return t0 * (t1 / t0)**s, True
    return None


@takes(errors=list_of(POSITIVE), time=LINE)
def winners(rows, options):
    """For each case and error the fastest FEM, the fastest MPM, and the factor. Options:
    errors, time = what of the topic "cost" counts."""
    points, lines = points_of(rows, options.get("time", "total_s")), []
    methods = unique(row["group"] for row in rows)
    for case in unique(p.case for p in points):
        for error in options.get("errors", [0.05, 0.02, 0.01, 0.005]):
            best = {}
            for family in ("FEM", "MPM"):
                found = []
                for method in methods:
                    if not method.startswith(family):
                        continue
                    reached = time_at([p for p in points if (p.case, p.method) ==
                                       (case, method)], error)
                    if reached:
                        found.append((*reached, method))
                best[family] = min(found, default=None)
            line = [case_name(case), f"{100. * error:g} %"]
            for family, found in best.items():
                line += ([found[2].removeprefix(family + " "),
                          f"{'~ ' if found[1] else ''}{number(found[0], 2)}"]
                         if found else ["not reached", "-"])
            fem, mpm = best["FEM"], best["MPM"]
            if fem and mpm:
                faster, factor = (("FEM", mpm[0] / fem[0]) if fem[0] <= mpm[0] else
                                  ("MPM", fem[0] / mpm[0]))
                line.append(f"{faster} by {number(factor, 2)}")
            else:
                line.append("FEM" if fem else "MPM" if mpm else "-")
            lines.append(line)
    return (["case", "error", "best FEM", "time (s)", "best MPM", "time (s)", "cheaper"],
            lines)


def order_of(points):
    """The order in h of the last refinement, h taken as dofs^(-1/2); or None."""
    line = sorted(points, key=lambda p: p.dofs)[-2:]
    if len(line) < 2 or not (line[0].error and line[1].error and
                             line[0].error * line[1].error > 0.):
        return None
    return 2. * (math.log(line[0].error / line[1].error) /
                 math.log(line[1].dofs / line[0].dofs))


@takes()
def orders(rows, options):
    """Errors on the finest mesh and observed orders, of each method in each case."""
    points = points_of(rows)
    cases, lines = unique(p.case for p in points), []
    for method in unique(row["group"] for row in rows):
        line = [method]
        for case in cases:
            mine = [p for p in points if (p.case, p.method) == (case, method)]
            if mine:
                finest, order = max(mine, key=lambda p: p.dofs), order_of(mine)
                line.append(f"{percent(finest.error)} ({number(order, 2)})")
            else:
                line.append("-")
        lines.append(line)
    return ["method", *(case_name(case) for case in cases)], lines


@takes(case=table_of(VALUE))
def measured(rows, options):
    """All points of one case, with the spread of times and where they go. Options:
    case = {axis = value}."""
    wanted, lines = options.get("case", {}), []
    for p in points_of(rows):
        if any(dict(p.case).get(name) != value for name, value in wanted.items()):
            continue
        spread = (f"{number(p.fastest, 3)} to {number(p.slowest, 3)}, {p.repetitions}"
                  if p.repetitions > 1 else "1 run")
        lines.append([p.method, p.mesh, p.dofs, percent(p.error), number(p.time, 3),
                      spread, number(p.ratio, 3), p.cost["factorisations"],
                      number(p.iterations, 3),
                      f"{p.cost['peak_memory_MB']:.0f}"])
    return (["method", "mesh", "unknowns", "error", "time (s)", "least to largest, runs",
             "time / factorisation", "factorisations", "iterations per step",
             "memory (MB)"], lines)


@takes(case=table_of(VALUE))
def cost_split(rows, options):
    """Where the time of the finest mesh of each method goes, in one case."""
    wanted, finest = options.get("case", {}), {}
    for p in points_of(rows):
        if all(dict(p.case).get(name) == value for name, value in wanted.items()):
            if p.method not in finest or p.dofs > finest[p.method].dofs:
                finest[p.method] = p
    names = [plain(name) for name in finest]
    figure, axes = subplots(figsize=(9.5, 1.2 + 0.38 * len(names)))
    left = np.zeros(len(names))
    for (key, label), color in zip(SPLIT, COLORS):
        part = np.array([100. * p.cost[key] / p.cost["total_s"]
                         for p in finest.values()])
        axes.barh(names, part, left=left, label=label, color=color)
        left += part
    axes.barh(names, 100. - left, left=left, label="mesh, output, other",
              color="#d8d8d8")
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set(xlim=(0., 100.), xlabel="part of the run's time (%)")
    axes.legend(loc="upper left", bbox_to_anchor=(1.03, 1.))
    return figure


@takes(x=LINE, width=POSITIVE, columns=between(1, 20, True))
def convergence(rows, options):
    """Error against cell size: a panel for each method (group), a curve for each
    friction angle. Options: x = key of the cell size, width = B (m)."""
    groups = unique(row["group"] for row in rows)
    width, key = options.get("width", 0.2), options.get("x", "Mesh/Cell size")
    n_columns = min(len(groups), options.get("columns", 3))
    n_rows = -(-len(groups) // n_columns)
    figure, axes = subplots(n_rows, n_columns, squeeze=False, sharex=True,
                                sharey=True,
                                figsize=(1.6 + 3.3 * n_columns, 0.9 + 3.2 * n_rows))
    all_x, all_y = [], []
    for ax, group in zip(axes.flat, groups):
        mine = [row for row in rows if row["group"] == group and
                row["status"] == "finished"]
        for i, phi in enumerate(unique(row["axes"].get("phi") for row in mine)):
            line = [(value_of(row, key) / width,
                     100. * value_of(row, "limit_load/relative_error"))
                    for row in mine if row["axes"].get("phi") == phi]
            x, y = np.array(sorted(line)).T
            ax.semilogx(x, y, color=COLORS[i], marker=MARKERS[i], markersize=5.,
                        label=f"phi = {phi}°")
            all_x += list(x)
            all_y += list(y)
        ax.axhline(0., color="black", linewidth=1.)
        ax.set_title(plain(group))
    for ax in axes.flat[len(groups):]:
        ax.remove()
    for ax in axes.flat[max(0, len(groups) - n_columns):len(groups)]:
        ax.tick_params(labelbottom=True)
    ticks = sorted(set(all_x))
    axes.flat[0].set_xticks(ticks, [f"B/{1. / x:.3g}" if x < 0.99 else f"{x:.3g} B"
                                    for x in ticks])
    axes.flat[0].xaxis.set_minor_formatter(NullFormatter())
    figure.supxlabel("cell size")
    figure.supylabel("error of the limit load (%)")
    axes.flat[0].legend()
    return figure


@takes()
def load_ratios(rows, options):
    """Load over that of associated flow on the same mesh. The axis `theta` names the
    dilatancy (its label 'associated' is the reference)."""
    loads, cases = {}, []
    for row in rows:
        others = tuple((name, value) for name, value in row["axes"].items()
                       if name != "theta")
        key = row["group"], others
        if key not in cases:
            cases.append(key)
        loads[key, row["axes"]["theta"]] = row
    thetas, lines = unique(row["axes"]["theta"] for row in rows), []
    for group, others in cases:
        base = value_of(loads[(group, others), "associated"], "limit_load/value")
        line = [group, case_name(others)]
        for theta in thetas:
            row = loads.get(((group, others), theta))
            value = row and value_of(row, "limit_load/value")
            if theta == "associated":
                line.append(number(value, 5))
            elif value and base:
                band = [value_of(row, f"limit_load/band_{end}") / base
                        for end in ("low", "high")]
                line.append(f"{value / base:.3f} ({band[0]:.3f} to {band[1]:.3f})")
            else:
                line.append(row["reason"] or "no plateau" if row else "-")
        lines.append(line)
    return ["method", "case", *(f"theta: {theta}" for theta in thetas)], lines
