# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of an element test:
  stress_strain.png   q (or the shear stress) against the strain that changes most
  stress_path.png     q against p, with the surfaces at the start and at the end
  compression.png     ln v against p, if the volume changes
  ratios.png          R and the structure ratio along the path, of laws with them
"""

import itertools

import numpy as np
from matplotlib.ticker import MaxNLocator, NullFormatter, ScalarFormatter

from geocone.reader import Missing
from geocone.style import COLORS, plain, save, subplots, unit_for

SURFACES = {  # by state (0 start, 1 end) and surface (0 yield, 1 subloading): the style
    (0, 0): ("yield surface, start", "#909090", "--"),
    (0, 1): ("subloading surface, start", "#909090", ":"),
    (1, 0): ("yield surface, end", "black", "--"),
    (1, 1): ("subloading surface, end", "black", ":")}
# The others of an axis, whose mean stress q is measured from.
OTHERS = {"xx": ("yy", "zz"), "yy": ("xx", "zz"), "zz": ("xx", "yy")}


class Path:
    """The table of an element test, in the units of the pictures."""

    def __init__(self, run):
        self.run, self.table, self.title = run, run.path, plain(run.name)
        table = self.table
        self.unit, self.factor = unit_for(
            max(np.abs(table["p (Pa)"]).max(), table["q (Pa)"].max()), run.unit("Pa"))
        self.axis = run.summary["axis"]
        self.p, self.q = table["p (Pa)"] / self.factor, table["q (Pa)"] / self.factor
        if self.axis in OTHERS:
            # Negative where the axis is compressed less than the others.
            others = [f"stress {other} (Pa)" for other in OTHERS[self.axis]]
            mean = np.mean([table[other] for other in others if other in table], axis=0)
            self.q = np.where(table[f"stress {self.axis} (Pa)"] > mean, -self.q, self.q)

    def stages(self):
        """The name of each stage and its lines, the last one before included."""
        number = self.table["stage (-)"]
        for i, name in enumerate(self.run.summary["stages"], 1):
            lines = np.flatnonzero(number == i)
            if len(lines):
                yield plain(name, 40), slice(lines[0] - 1, lines[-1] + 1)

    def draw(self, axes, x, y):
        """Draws a curve, each stage in its colour, and a dot at the start."""
        # Many cycles are thin lines, or they would fill the picture.
        width = 0.7 if len(x) > 1500 else 1.4
        for (name, part), color in zip(self.stages(), itertools.cycle(COLORS)):
            axes.plot(x[part], y[part], color=color, label=name, linewidth=width,
                      solid_joinstyle="round")
        axes.plot(x[0], y[0], "o", color="black", markersize=5., zorder=4)


def stress_strain(path):
    """q or the shear stress against the strain of the axis."""
    figure, axes = subplots(figsize=(7., 4.4))
    strain = path.table[f"eps {path.axis} (-)"]
    if path.axis in OTHERS:
        path.draw(axes, -100. * strain, path.q)
        axes.set(xlabel=f"axial strain {path.axis} (%), compression positive",
                 ylabel=f"deviatoric stress q ({path.unit})")
    else:
        path.draw(axes, 200. * strain,
                  path.table[f"stress {path.axis} (Pa)"] / path.factor)
        axes.set(xlabel=f"shear angle 2 eps_{path.axis} (%)",
                 ylabel=f"shear stress {path.axis} ({path.unit})")
    axes.set_title(f"{path.title}: stress and strain")
    axes.legend()
    return figure


def stress_path(path):
    """q against p, with the surfaces; not every law has some."""
    figure, axes = subplots(figsize=(8.6, 4.8))
    path.draw(axes, path.p, path.q)
    try:
        surfaces = path.run.surfaces
    except Missing:
        surfaces = None
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
    axes.set(title=f"{path.title}: stress path", xlabel=f"pressure p ({path.unit})",
             ylabel=f"deviatoric stress q ({path.unit})")
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.), borderaxespad=0.)
    return figure


def compression(path):
    """ln v against p on a logarithmic axis; nothing if the volume is constant."""
    if path.p.min() <= 0. or np.ptp(path.table["ln v (-)"]) < 1e-9:
        return None
    figure, axes = subplots(figsize=(7., 4.4))
    axes.set_xscale("log")
    path.draw(axes, path.p, path.table["ln v (-)"])
    if path.p.max() < 30. * path.p.min():
        # Less than a decade or so: labels at 1, 2, 5 times a power would be too few.
        ticks = [t for t in MaxNLocator(7, steps=[1, 2, 5, 10]).tick_values(
            path.p.min(), path.p.max()) if t > 0.]
        axes.set_xticks(ticks)
        axes.xaxis.set_major_formatter(ScalarFormatter())
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.minorticks_off()
    axes.set(xlabel=f"pressure p ({path.unit})", ylabel="ln v (-)",
             title=f"{path.title}: compression")
    axes.legend()
    return figure


def ratios(path):
    """R and Rb along the path; nothing if the law has none."""
    if "R (-)" not in path.table:
        return None
    figure, (first, second) = subplots(2, 1, figsize=(7.6, 5.4), sharex=True)
    way = 100. * path.table["strain path (-)"]
    path.draw(first, way, path.table["R (-)"])
    path.draw(second, way, path.table["Rb (-)"])
    first.axhline(1., color="black", linewidth=1., linestyle="--")
    first.set(ylabel="subloading ratio R (-)", title=f"{path.title}: ratios",
              ylim=(0., 1.05))
    second.set(xlabel="length of the strain path (%)", ylabel="structure ratio Rb (-)")
    if np.ptp(path.table["Rb (-)"]) < 1e-9:
        second.set_ylim(path.table["Rb (-)"][0] - 0.5, path.table["Rb (-)"][0] + 0.5)
    first.legend()
    return figure


def pictures(run):
    """Drawing functions of the pictures of an element test, by name."""
    path = Path(run)

    def saves(draw):
        def draw_and_save(_, file):
            if (figure := draw(path)) is not None:
                save(figure, run, file)
        return draw_and_save
    return {f"{draw.__name__}.png": saves(draw)
            for draw in (stress_strain, stress_path, compression, ratios)}
