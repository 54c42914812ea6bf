# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""bounds.png: both bounds of a limit load and their gap, by mesh and by time;
mechanism.png: the last mesh, where its gap is, and how the body fails."""

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from geocone.style import (BLUE, COLORS, GREY, RATES, STRAINS, Skipped, add_bar,
                           draw_water, panels, plain, save, subplots, unit_for)


def column(table, name):
    """The column of a table whose name begins so, and the unit."""
    full = next(key for key in table if key.startswith(name))
    return table[full], full[len(name):].strip(" ()")


def draw_bounds(run, path):
    """Draws the bounds against the triangles, and the gap against those and time."""
    table = run.table("bounds")
    cells = table["triangles (-)"]
    lower, unit = column(table, "lower bound")
    upper, _ = column(table, "upper bound")
    sure = table["certified (-)"] > 0.
    name, factor = ("", 1.) if unit == "-" else unit_for(np.nanmax(np.abs(upper)), unit)
    figure, (first, second) = subplots(1, 2, figsize=(11., 4.4))
    first.fill_between(cells, lower / factor, upper / factor, color=BLUE, alpha=0.15,
                       linewidth=0.)
    for values, color, label in ((upper, COLORS[1], "upper bound"),
                                 (lower, BLUE, "lower bound")):
        first.semilogx(cells, values / factor, "o-", color=color, label=label)
        first.semilogx(cells[~sure], values[~sure] / factor, "o", color=color,
                       markerfacecolor="white")
    reference = run.value("reference/expected")
    if reference is not None:
        first.axhline(reference / factor, color="k", linestyle="--", linewidth=1.2,
                      label="reference")
    what = ("factor of safety" if run.method == "strength reduction" else "limit load")
    first.set(xlabel="triangles", title=f"{plain(run.name)}: bounds of the {what}",
              ylabel=(f"load ({name})" if name else
                      "load factor (-)" if what == "limit load" else f"{what} (-)"))
    first.legend()
    gap = 100. * table["gap (-)"]
    seconds = np.cumsum(table["CPU time (s)"] + table["CPU time of the mesh (s)"])
    second.loglog(cells, gap, "o-", color=BLUE)
    second.set(xlabel="triangles", ylabel="gap (%)", title="gap between the bounds")
    tolerance = 100. * float(run.parameters["Analysis/Gap tolerance"])
    second.axhline(tolerance, color=GREY, linestyle=":", label="tolerance")
    x = np.array([cells[0], cells[-1]])
    second.loglog(x, gap[-1] * cells[-1] / x, "k--", linewidth=1.,
                  label="one over the triangles")
    for i in (0, len(cells) // 2, len(cells) - 1):
        second.annotate(f"{seconds[i]:.2g} s", (cells[i], gap[i]), fontsize=9,
                        xytext=(6, 6), textcoords="offset points")
    second.legend(loc="lower left")
    for axes in (first, second):
        axes.xaxis.set_major_locator(LogLocator(subs=(1., 2., 5.)))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())
    second.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    save(figure, run, path)


def draw_mechanism(run, path):
    """Draws the triangles' parts of the gap, and the speed of the mechanism."""
    field, = run.states("bounds")
    part = field.data["part_of_gap"][:, 0]
    if not np.any(part > 0.):
        raise Skipped("there is no gap")
    low, high = field.points.min(axis=0), field.points.max(axis=0)
    figure, (first, second) = panels(2, (low, high))
    mesh = PolyCollection(field.points[field.cells], array=part[field.cells[:, 0]],
                          edgecolors="#00000030", linewidths=0.2, cmap=RATES,
                          norm=LogNorm(1e-2 * part.max(), part.max()))
    first.add_collection(mesh)
    first.set_title(f"{plain(run.name)}: parts of the gap of {len(field.cells)} "
                    "triangles")
    add_bar(first, mesh, "over the mean", extend="min")
    speed = np.linalg.norm(field.data["velocity"], axis=1)
    # Sand at the corner of a footing may be shot out: two hundredths of the whole
    # area may be faster than the colours tell.
    corners = field.points[field.cells]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] -
                                                             corners[:, 0]).T
    mean = speed[field.cells].mean(axis=1)
    order = np.argsort(mean)
    area = np.cumsum(np.abs(ax * by - ay * bx)[order])
    most = mean[order][np.searchsorted(area, 0.98 * area[-1])]
    drawn = second.tripcolor(*field.points.T, field.cells, speed / most,
                             shading="gouraud", cmap=STRAINS, vmin=0., vmax=1.)
    second.set_title("speed of the mechanism of the upper bound")
    add_bar(second, drawn, "over the largest", extend="max")
    for axes in (first, second):
        draw_water(axes, run)
    save(figure, run, path, cropped=True)


def pictures(_run):
    """What draws each picture."""
    return {"bounds.png": draw_bounds, "mechanism.png": draw_mechanism}
