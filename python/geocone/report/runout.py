# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Columns of sand that collapse (studies/runout.toml), and power laws k a^n of the
aspect ratio a = H0/L0. The columns are 1 m wide."""

import numpy as np
from matplotlib.ticker import FixedLocator, NullLocator

from geocone.parameter_file import parameters_of
from geocone.reader import read_table
from geocone.report.schema import takes
from geocone.style import COLORS, plain, subplots

TICKS = (0.5, 1., 1.5, 2., 3., 4., 6., 8., 10., 15., 20., 30.)
MASS, FARTHEST, TOP = "99 % of the mass", "farthest point", "highest point"
# Of experiments of plane flow with a > 2.3: k, n, and the label of its axis.
LAWS = {"run-out": (1.9, 2. / 3., "(L - L$_0$)/L$_0$ (-)"),
        "final height": (1., 1. / 3., "H/L$_0$ (-)")}
MEASURED = {MASS: "run-out", FARTHEST: "run-out", TOP: "final height"}


def aspect_of(row):
    """The aspect ratio of a column."""
    parameters = parameters_of(row["folder"] / "parameters.prm")
    return float(parameters["Geometry/Box"].replace(";", ",").split(",")[3])


def measures(rows):
    """Aspect ratios and what was measured, by its name, of the finished columns."""
    rows = [row for row in rows if row["status"] == "finished"]
    a = np.array([aspect_of(row) for row in rows])
    states = [row["summary"]["state"] for row in rows]
    return a, {MASS: np.array([state["right_front_m"] - 1. for state in states]),
               FARTHEST: np.array([state["x_largest_m"] - 1. for state in states]),
               TOP: np.array([state["y_largest_m"] for state in states])}


def fit(a, values):
    """k and n of the power law k a^n that is nearest."""
    n, log_k = np.polyfit(np.log(a), np.log(values), 1)
    return np.exp(log_k), n


@takes()
def laws(rows, _):
    """Results of the first group beside the laws of experiments, in logarithms."""
    group = rows[0]["group"]
    a, measured = measures([row for row in rows if row["group"] == group])
    figure, both = subplots(1, 2, figsize=(9.5, 4.2))
    line = np.array([0.9 * min(a), 1.1 * max(a)])
    for axes, (law, (k, n, label)) in zip(both, LAWS.items()):
        axes.loglog(line, k * line**n, "k--", label=f"experiments: {k:g} a$^{{{n:.2f}}}$")
        series = {name: values for name, values in measured.items()
                  if MEASURED[name] == law}
        for (name, values), color, marker in zip(series.items(), COLORS, "o^"):
            k, n = fit(a, values)
            axes.loglog(a, values, marker, color=color, label=plain(name))
            axes.loglog(line, k * line**n, color=color, linewidth=1.2,
                        label=f"{k:.2f} a$^{{{n:.2f}}}$")
        heights = np.concatenate([*series.values()])
        axes.set(title=f"{law}, {plain(group)}", ylabel=label,
                 xlabel="aspect ratio a = H$_0$/L$_0$ (-)",
                 ylim=(0.7 * heights.min(), 1.5 * heights.max()))
        for axis, ticks in ((axes.xaxis, a), (axes.yaxis, TICKS)):
            axis.set_major_locator(FixedLocator(ticks))
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter("{x:g}")
        axes.legend(fontsize=9)
    return figure


@takes()
def fits(rows, _):
    """The power laws of each group."""
    def text(k, n):
        return f"{k:.2f} a^{n:.2f}"
    lines = []
    for group in dict.fromkeys(row["group"] for row in rows):
        a, measured = measures([row for row in rows if row["group"] == group])
        if len(a) > 1:
            lines.append([group, f"{min(a):g} to {max(a):g}",
                          *(text(*fit(a, values)) for values in measured.values())])
    lines.append(["experiments", "> 2.3", *(text(*LAWS[law][:2])
                                            for law in MEASURED.values())])
    return ["runs", "a", *(f"{law}, {name}" for name, law in MEASURED.items())], lines


@takes()
def table(rows, _):
    """A line for each column."""
    lines = []
    for row in rows:
        if row["status"] != "finished":
            lines.append([row["group"], row["label"], "failed", *["-"] * 6])
            continue
        state, energy = row["summary"]["state"], row["summary"]["energy"]
        a = aspect_of(row)
        front = read_table(row["folder"] / "statistics.csv")["x of 99 % of the mass (m)"]
        loss = energy["numerical_loss_J_per_m"] / energy["gravity_work_J_per_m"]
        rest = energy["kinetic_J_per_m"] / energy["largest_kinetic_J_per_m"]
        lines.append([
            row["group"], f"{a:g}", f"{state['right_front_m']:.2f}",
            f"{state['x_largest_m']:.2f}", f"{state['y_largest_m']:.2f}",
            f"{front[-1] - front[-1 - len(front) // 6]:.1e}", f"{rest:.1e}",
            f"{100. * loss:.1f} %", f"{state['volume_m2'] / a:.2f}"])
    return ["runs", "a", "L (m)", "farthest point (m)", "final height (m)",
            "front in the last sixth (m)", "kinetic to largest kinetic energy",
            "numerical loss", "volume"], lines
