# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""bounds.png: both bounds of a limit load and their gap, by mesh and by time;
mechanism.png: the last mesh, where its gap is, and how the body fails by either bound."""

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
    figure, (first, second, third) = subplots(1, 3, figsize=(15., 4.4))
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
    tolerance = 100. * float(run.parameters["Analysis/Gap tolerance"])
    order = run.value("bounds/order")
    for axes, x, label in (second, cells, "triangles"), (third, seconds,
                                                         "CPU time of all meshes (s)"):
        axes.loglog(x, gap, "o-", color=BLUE)
        axes.axhline(tolerance, color=GREY, linestyle=":", label="tolerance")
        axes.set(xlabel=label, ylabel="gap (%)")
    second.loglog(cells, gap[-1] * cells[-1] / cells, "k--", linewidth=1.,
                  label="one over the triangles")
    for axes in second, third:
        axes.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    second.set_title("gap" if order is None else
                     f"gap: order {order:.2f} in the triangles")
    third.set_title("gap against time")
    second.legend(loc="lower left")
    third.legend(loc="lower left")
    for axes in (first, second, third):
        axes.xaxis.set_major_locator(LogLocator(subs=(1., 2., 5.)))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())
    save(figure, run, path)


def speed_of(field, name):
    """The speed of a mechanism over one that two hundredths of the area exceed: sand at
    the corner of a footing may be shot out."""
    speed = np.linalg.norm(field.data[name], axis=1)
    corners = field.points[field.cells]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] -
                                                             corners[:, 0]).T
    mean = speed[field.cells].mean(axis=1)
    order = np.argsort(mean)
    area = np.cumsum(np.abs(ax * by - ay * bx)[order])
    most = mean[order][np.searchsorted(area, 0.98 * area[-1])]
    return speed / most if most > 0. else speed


def draw_mechanism(run, path):
    """Draws the triangles' parts of the gap, and the speeds of the mechanisms of both
    bounds: that of the upper one proves it, that of the lower one is its dual."""
    field, = run.states("bounds")
    part = field.data["part_of_gap"][:, 0]
    if not np.any(part > 0.):
        raise Skipped("there is no gap")
    low, high = field.points.min(axis=0), field.points.max(axis=0)
    # Runs of earlier versions have the first one only.
    mechanisms = [(name, of) for name, of in (("velocity", "upper"),
                                              ("velocity_lower", "lower"))
                  if name in field.data]
    figure, axes_of = panels(1 + len(mechanisms), (low, high))
    first = axes_of[0]
    mesh = PolyCollection(field.points[field.cells], array=part[field.cells[:, 0]],
                          edgecolors="#00000030", linewidths=0.2, cmap=RATES,
                          norm=LogNorm(1e-2 * part.max(), part.max()))
    first.add_collection(mesh)
    first.set_title(f"{plain(run.name)}: parts of the gap of {len(field.cells)} "
                    "triangles")
    add_bar(first, mesh, "over the mean", extend="min")
    for axes, (name, of) in zip(axes_of[1:], mechanisms):
        drawn = axes.tripcolor(*field.points.T, field.cells, speed_of(field, name),
                               shading="gouraud", cmap=STRAINS, vmin=0., vmax=1.)
        axes.set_title(f"speed of the mechanism of the {of} bound")
        add_bar(axes, drawn, "over the largest", extend="max")
    for axes in axes_of:
        draw_water(axes, run)
    save(figure, run, path, cropped=True)


def pictures(_run):
    """Drawing functions by picture."""
    return {"bounds.png": draw_bounds, "mechanism.png": draw_mechanism}
