# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of an element test for scripts/plot, which hands itself over as `plot`:
  stress_strain.png   q (or the shear stress) against the strain that changes most
  stress_path.png     q against p, with the surfaces at the start and at the end
  compression.png     ln v against p, if the volume changes
  ratios.png          R and the structure ratio along the path, of laws with them
"""

import itertools

import numpy as np
from matplotlib.ticker import MaxNLocator, NullFormatter, ScalarFormatter

SURFACES = {  # by state (0 start, 1 end) and surface (0 yield, 1 subloading): the style
    (0, 0): ("yield surface, start", "#909090", "--"),
    (0, 1): ("subloading surface, start", "#909090", ":"),
    (1, 0): ("yield surface, end", "black", "--"),
    (1, 1): ("subloading surface, end", "black", ":")}
# The others of an axis, whose mean stress q is measured from.
OTHERS = {"xx": ("yy", "zz"), "yy": ("xx", "zz"), "zz": ("xx", "yy")}


class Path:
    """The table of an element test, in the units of the pictures."""

    def __init__(self, plot, table, summary):
        self.plot, self.table, self.summary = plot, table, summary
        self.name, self.factor = plot.unit_for(
            max(np.abs(table["p (Pa)"]).max(), table["q (Pa)"].max()), "Pa")
        self.axis = summary["axis"]
        self.p, self.q = table["p (Pa)"] / self.factor, table["q (Pa)"] / self.factor
        if self.axis in OTHERS:
            # Negative where the axis is compressed less than the others.
            others = [f"stress {other} (Pa)" for other in OTHERS[self.axis]]
            mean = np.mean([table[other] for other in others if other in table], axis=0)
            self.q = np.where(table[f"stress {self.axis} (Pa)"] > mean, -self.q, self.q)

    def stages(self):
        """The name of each stage and its lines, the last one before included."""
        number = self.table["stage (-)"]
        for i, name in enumerate(self.summary["stages"], 1):
            lines = np.flatnonzero(number == i)
            if len(lines):
                yield self.plot.plain(name, 40), slice(lines[0] - 1, lines[-1] + 1)


def curve(axes, path, x, y):
    """Draws a curve, each stage in its colour, and a dot at the start."""
    # Many cycles are thin lines, or they would fill the picture.
    width = 0.7 if len(x) > 1500 else 1.4
    for (name, part), color in zip(path.stages(), itertools.cycle(path.plot.COLORS)):
        axes.plot(x[part], y[part], color=color, label=name, linewidth=width,
                  solid_joinstyle="round")
    axes.plot(x[0], y[0], "o", color="black", markersize=5., zorder=4)


def stress_strain(path, title):
    """q or the shear stress against the strain of the axis."""
    figure, axes = path.plot.subplots(figsize=(7., 4.4))
    strain = path.table[f"eps {path.axis} (-)"]
    if path.axis in OTHERS:
        curve(axes, path, -100. * strain, path.q)
        axes.set(xlabel=f"axial strain {path.axis} (%), compression positive",
                 ylabel=f"deviatoric stress q ({path.name})")
    else:
        curve(axes, path, 200. * strain,
              path.table[f"stress {path.axis} (Pa)"] / path.factor)
        axes.set(xlabel=f"shear angle 2 eps_{path.axis} (%)",
                 ylabel=f"shear stress {path.axis} ({path.name})")
    axes.set_title(f"{title}: stress and strain")
    axes.legend()
    return figure


def stress_path(path, surfaces, title):
    """q against p, with the surfaces."""
    figure, axes = path.plot.subplots(figsize=(8.6, 4.8))
    curve(axes, path, path.p, path.q)
    for (state, surface), (label, color, style) in SURFACES.items():
        if surfaces is None:
            break
        parts = [np.column_stack([surfaces["p (Pa)"], surfaces["q (Pa)"]])[
            (surfaces["state"] == i) & (surfaces["surface"] == surface)]
                 for i in (0, 1)]
        # Of a surface that does not change one is enough.
        if constant := np.array_equal(*parts):
            label = label.split(",")[0]
        if len(parts[state]) and not (constant and state == 1):
            axes.plot(*parts[state].T / path.factor, linestyle=style, color=color,
                      linewidth=1.2, label=label, zorder=1.5)
    axes.axhline(0., color="#606060", linewidth=0.8, zorder=1.)
    axes.set(xlabel=f"pressure p ({path.name})", ylabel=f"deviatoric stress q ({path.name})",
             title=f"{title}: stress path")
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.), borderaxespad=0.)
    return figure


def compression(path, title):
    """ln v against p on a logarithmic axis; nothing if the volume is constant."""
    if path.p.min() <= 0. or np.ptp(path.table["ln v (-)"]) < 1e-9:
        return None
    figure, axes = path.plot.subplots(figsize=(7., 4.4))
    axes.set_xscale("log")
    curve(axes, path, path.p, path.table["ln v (-)"])
    if path.p.max() < 30. * path.p.min():
        # Less than a decade or so: labels at 1, 2, 5 times a power would be too few.
        ticks = [t for t in MaxNLocator(7, steps=[1, 2, 5, 10]).tick_values(
            path.p.min(), path.p.max()) if t > 0.]
        axes.set_xticks(ticks)
        axes.xaxis.set_major_formatter(ScalarFormatter())
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.minorticks_off()
    axes.set(xlabel=f"pressure p ({path.name})", ylabel="ln v (-)",
             title=f"{title}: compression")
    axes.legend()
    return figure


def ratios(path, title):
    """R and Rb along the path."""
    if "R (-)" not in path.table:
        return None
    figure, (first, second) = path.plot.subplots(2, 1, figsize=(7.6, 5.4), sharex=True)
    way = 100. * path.table["strain path (-)"]
    curve(first, path, way, path.table["R (-)"])
    curve(second, path, way, path.table["Rb (-)"])
    first.axhline(1., color="black", linewidth=1., linestyle="--")
    first.set(ylabel="subloading ratio R (-)", title=f"{title}: ratios", ylim=(0., 1.05))
    second.set(xlabel="length of the strain path (%)", ylabel="structure ratio Rb (-)")
    if np.ptp(path.table["Rb (-)"]) < 1e-9:
        second.set_ylim(path.table["Rb (-)"][0] - 0.5, path.table["Rb (-)"][0] + 0.5)
    first.legend()
    return figure


def figures(plot, run, table, surfaces):
    """The names and figures of all pictures; surfaces may be None."""
    path = Path(plot, table, run.summary)
    for name, figure in (
            ("stress_strain.png", stress_strain(path, run.name)),
            ("stress_path.png", stress_path(path, surfaces, run.name)),
            ("compression.png", compression(path, run.name)),
            ("ratios.png", ratios(path, run.name))):
        if figure is not None:
            yield name, figure
