# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""structures.png of strict bounds: where plates, geogrids, anchors and struts yield in the
mechanism of the upper bound, and axial forces and moments of the lower bound."""

import numpy as np
from matplotlib.collections import LineCollection

from geocone.plots.answer import heading
from geocone.plots.model import STRUCTURE, Model
from geocone.plots.plates import draw_body
from geocone.style import COLORS, Skipped, plain, save, subplots, unit_for

LEAST = 0.02  # of the largest rate, from which on a point counts as yielding
NEAR = 1.7  # times the largest force, up to which strengths are shown
MOST_NAMES = 12  # curves in a legend
YIELDS, HINGES = COLORS[1], COLORS[3]


class Bar:
    """Lines of the table of a structure, and its strengths, None if unlimited."""

    def __init__(self, structure, table, lines, parameters):
        self.name, self.kind = structure["name"], structure["type"]
        self.columns = {name.rpartition(" (")[0]: values[lines] for name, values in table.items()}
        self.x = np.stack([self["x"], self["y"]], axis=1)

        def strength(entry, automatic=None):
            text = parameters.get(f"Structures/{self.name}/{entry}", "automatic")
            return (automatic if text == "automatic" else
                    None if text == "unlimited" else float(text))

        self.tensile = strength("Tensile strength")
        self.compressive = strength("Compressive strength",
                                    0. if self.kind == "geogrid" else None)
        self.moment = strength("Moment capacity") if self.kind == "plate" else None

    def __getitem__(self, name):
        return self.columns[name]

    def pieces(self):
        """Pairs of neighbouring lines on one edge."""
        n = len(self.x)
        if self.kind in ("plate", "geogrid"):
            return [(i, i + 1) for i in range(n - 1) if i % 3 != 2]
        return [(0, 1)]


def bars_of(run):
    """The structures of a run that are in its table."""
    table, model = run.table("structures"), Model(run.folder)
    bars = []
    for i, structure in enumerate(model.data.get("structures", [])):
        lines = table["structure"] == i + 1
        if lines.any():
            bars.append(Bar(structure, table, lines, run.parameters))
    if not bars:
        raise Skipped("there are no structures")
    return bars, model


def draw_yielding(axes, bars, model):
    """Draws the structures in the body: parts that yield axially, and hinges."""
    draw_body(axes, model)
    strain = max(np.abs(bar["plastic axial strain rate"]).max() for bar in bars)
    turn = max(np.abs(bar["plastic rotation rate"]).max() for bar in bars)
    yields = hinges = False
    for bar in bars:
        rate = np.abs(bar["plastic axial strain rate"])
        parts = {False: [], True: []}
        for i, j in bar.pieces():
            # Rates below 1e-4/m at 1 m/s are rounding of the solver.
            parts[bool(min(rate[i], rate[j]) > max(LEAST * strain, 1e-4))].append(bar.x[[i, j]])
        look = "--" if bar.kind in ("anchor", "strut") else "-"
        axes.add_collection(LineCollection(parts[False], colors=STRUCTURE, linewidths=1.6,
                                           linestyles=look, zorder=6))
        axes.add_collection(LineCollection(
            parts[True], colors=YIELDS, linewidths=3., linestyles=look, zorder=7,
            label=None if yields or not parts[True] else "yields axially"))
        yields = yields or bool(parts[True])
        rotation = np.abs(bar["plastic rotation rate"])
        at = rotation > max(LEAST * turn, 1e-4)
        if at.any():
            axes.scatter(*bar.x[at].T, s=18. + 60. * rotation[at] / turn, color=HINGES, zorder=8,
                         edgecolors="white", linewidths=0.6,
                         label=None if hinges else "hinge, larger where it turns faster")
            hinges = True
    axes.set_title("where structures yield in the upper bound", fontsize=10)
    if yields or hinges:
        axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.18), ncol=2)


def draw_forces(axes, bars, quantity, unit, strengths_of):
    """Draws a force along the structures in the lower bound, with the strengths dashed."""
    most = max(np.abs(bar[quantity]).max() for bar in bars)
    unit, size = unit_for(max(most, 1e-300), unit)
    for i, bar in enumerate(bars):
        color = COLORS[i % len(COLORS)]
        axes.plot(bar["distance along it"], bar[quantity] / size, color=color, linewidth=1.4,
                  label=plain(bar.name))
        for strength in strengths_of(bar):
            if strength and abs(strength) < NEAR * most:
                axes.plot(bar["distance along it"][[0, -1]], 2 * [strength / size], color=color,
                          linestyle="--", linewidth=0.9)
    axes.axhline(0., color="k", linewidth=0.6)
    axes.set(xlabel="distance along it (m)", ylabel=f"{quantity} ({unit})")
    axes.set_title(f"{quantity} of the lower bound", fontsize=10)
    if 1 < len(bars) <= MOST_NAMES:
        axes.legend(fontsize=7)


def draw_run(run, path):
    """Draws where structures yield, their axial forces and the moments of plates."""
    bars, model = bars_of(run)
    plates = [bar for bar in bars if bar.kind == "plate"]
    figure, axes_of = subplots(1, 3 if plates else 2, figsize=(15. if plates else 11., 4.4),
                               gridspec_kw={"width_ratios": [1.5, 1., 1.][:3 if plates else 2]})
    draw_yielding(axes_of[0], bars, model)
    draw_forces(axes_of[1], bars, "axial force", run.unit("N/m"),
                lambda bar: (bar.tensile, -bar.compressive if bar.compressive else None))
    if plates:
        draw_forces(axes_of[2], plates, "bending moment", run.unit("N m/m"),
                    lambda bar: (bar.moment, -bar.moment) if bar.moment else ())
    figure.suptitle(heading(run) + "; dashed: strengths", fontsize=13)
    save(figure, run, path)
