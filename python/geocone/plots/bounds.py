# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""bounds.png: both bounds of a limit load by mesh, and their gap by mesh and by time;
mechanism.png: how the body fails by either bound, and where on the last mesh the gap is;
dependence.png: what the bounds depend on."""

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from geocone.plots import overlay
from geocone.plots.answer import heading
from geocone.style import (BLUE, COLORS, GREY, RATES, STRAINS, Skipped, add_bar, level, panels,
                           plain, save, sizes_of, subplots, unit_for)

FEWEST = 3  # meshes, from which on a trend can be seen
LEAST = 0.005  # of an elasticity that is shown


def column(table, name):
    """The column of a table whose name begins so, and the unit."""
    full = next(key for key in table if key.startswith(name))
    return table[full], full[len(name):].strip(" ()")


def cells_of(table):
    """The numbers of cells, and their name: triangles, in three dimensions tetrahedra."""
    name = next(key for key in table if key in ("triangles (-)", "tetrahedra (-)"))
    return table[name], name.split()[0]


def draw_bounds(run, path):
    """Draws the bounds against the cells and, of several meshes, the gap against those
    and time."""
    table = run.table("bounds")
    cells, _ = cells_of(table)
    if len(cells) < 2:
        raise Skipped("there is one mesh only")
    trend = len(cells) >= FEWEST
    figure, axes_of = subplots(1, 3 if trend else 1, figsize=(15. if trend else 6.5, 4.4),
                               squeeze=False)
    first, *others = axes_of[0]
    draw_levels(first, run, table)
    if trend:
        draw_gaps(others, run, table)
        figure.suptitle(heading(run), fontsize=13)
    else:
        first.set_title(heading(run))
    for axes in axes_of[0]:
        plain_ticks(axes.xaxis)
    save(figure, run, path)


def plain_ticks(axis):
    """Numbers at 1, 2 and 5 times powers of ten along a logarithmic axis."""
    axis.set_major_locator(LogLocator(subs=(1., 2., 5.)))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def draw_levels(axes, run, table):
    """Draws both bounds of each mesh."""
    cells, name_of_cells = cells_of(table)
    lower, unit = column(table, "lower bound")
    upper, _ = column(table, "upper bound")
    sure = table["certified (-)"] > 0.
    name, factor = ("", 1.) if unit == "-" else unit_for(np.nanmax(np.abs(upper)), unit)
    axes.fill_between(cells, lower / factor, upper / factor, color=BLUE, alpha=0.15,
                      linewidth=0.)
    for values, color, label in ((upper, COLORS[1], "upper bound"),
                                 (lower, BLUE, "lower bound")):
        axes.semilogx(cells, values / factor, "o-", color=color, label=label)
        axes.semilogx(cells[~sure], values[~sure] / factor, "o", color=color,
                      markerfacecolor="white")
    reference = run.value("reference/expected")
    if reference is not None:
        axes.axhline(reference / factor, color="k", linestyle="--", linewidth=1.2,
                     label="reference")
    axes.set(xlabel=name_of_cells, title="bounds",
             ylabel=(f"load ({name})" if name else "load factor (-)"
                     if run.method == "limit load" else "factor of safety (-)"))
    axes.legend()


def draw_gaps(axes_of, run, table):
    """Draws the gap against the cells and against time."""
    cells, name_of_cells = cells_of(table)
    gap = 100. * table["gap (-)"]
    seconds = np.cumsum(table["CPU time (s)"] + table["CPU time of the mesh (s)"])
    tolerance = 100. * float(run.parameters["Analysis/Gap tolerance"])
    for axes, x, label in zip(axes_of, (cells, seconds),
                              (name_of_cells, "CPU time of all meshes (s)")):
        axes.loglog(x, gap, "o-", color=BLUE)
        axes.axhline(tolerance, color=GREY, linestyle=":", label="tolerance")
        axes.set(xlabel=label, ylabel="gap (%)")
    axes_of[0].loglog(cells, gap[-1] * cells[-1] / cells, "k--", linewidth=1.,
                      label=f"one over the {name_of_cells}")
    order = run.value("bounds/order")
    axes_of[0].set_title("gap" if order is None else
                         f"gap: order {order:.2f} in the {name_of_cells}")
    axes_of[1].set_title("gap against time")
    for axes in axes_of:
        axes.legend(loc="lower left")
        plain_ticks(axes.yaxis)


def draw_mechanism(run, path):
    """Draws the mechanisms of both bounds (that of the upper one proves it, that of the lower
    one is its dual), and the triangles' parts of the gap."""
    field, = run.states("bounds")
    if field.cells.shape[1] == 4:
        from geocone.plots import bounds_solid
        bounds_solid.draw_mechanism(run, field, path)
        return
    part = field.data["part_of_gap"][:, 0]
    mechanisms = [(name, of) for name, of in (("velocity", "upper"),
                                              ("velocity_lower", "lower"))
                  if name in field.data]  # runs of earlier versions have the first one only
    view = field.points.min(axis=0), field.points.max(axis=0)
    has_gap = np.any(part > 0.)
    figure, axes_of = panels(len(mechanisms) + has_gap, view)
    for axes, (name, of) in zip(axes_of, mechanisms):
        vectors = field.data[name][:, :2]
        speed = np.linalg.norm(vectors, axis=1)
        most = max(level(speed[field.cells].mean(axis=1), sizes_of(field)),
                   np.finfo(float).tiny)
        drawn = axes.tripcolor(*field.points.T, field.cells, speed / most, shading="gouraud",
                               cmap=STRAINS, vmin=0., vmax=1.)
        overlay.draw_arrows(axes, field.points, vectors, most)
        axes.set_title(f"mechanism of the {of} bound: speed")
        add_bar(axes, drawn, "relative", extend="max")
    if has_gap:
        parts = part[field.cells[:, 0]]
        most = level(parts, np.ones(len(parts)))  # of a triangle each, whatever its area
        mesh = PolyCollection(field.points[field.cells], array=parts,
                              edgecolors="#00000030", linewidths=0.2, cmap=RATES,
                              norm=LogNorm(1e-2 * most, most))
        axes_of[-1].add_collection(mesh)
        axes_of[-1].set_title(f"parts of the gap of {len(field.cells)} triangles")
        add_bar(axes_of[-1], mesh, "over the mean", extend="both")
    for axes in axes_of:
        overlay.draw_scene(axes, run, field)
    figure.suptitle(heading(run), fontsize=13)
    save(figure, run, path, cropped=True)


def dependence_of(run):
    """Parameters on which the bounds of a run depend, the most important first: the name,
    and the elasticities of the lower and the upper bound, nan if not certified."""
    found = []
    for names in run.summary.get("bounds", {}).get("gradients", {}).values():
        for name, parameters in names.items():
            for parameter, of in parameters.items():
                words = parameter.replace("_", " ")
                ends = [np.nan if of[side] is None else of[side]
                        for side in ("elasticity_lower", "elasticity_upper")]
                if np.nanmax(np.abs(ends), initial=0.) >= LEAST:
                    found.append((f"{name}: " + (f"tan({words})" if parameter ==
                                                 "friction_angle" else words), *ends))
    return sorted(found, key=lambda row: -np.nanmax(np.abs(row[1:])))


def draw_dependence(run, path):
    """Draws by how much both bounds change with each parameter."""
    found = dependence_of(run)[::-1]
    if not found:
        raise Skipped("there are no gradients of bounds")
    names, lower, upper = zip(*found)
    figure, axes = subplots(1, 1, figsize=(8., 1.6 + 0.5 * len(found)))
    at = np.arange(len(found))
    axes.barh(at - 0.19, upper, 0.36, color=COLORS[1], label="upper bound")
    axes.barh(at + 0.19, lower, 0.36, color=BLUE, label="lower bound")
    axes.axvline(0., color="k", linewidth=0.8)
    axes.set_yticks(at, [plain(name) for name in names])
    axes.grid(axis="y", visible=False)
    axes.set(xlabel="change in % where the parameter grows by 1 %", title=heading(run))
    axes.legend()
    save(figure, run, path)


def draw_structures(run, path):
    """Draws where structures yield, and their forces."""
    from geocone.plots import bars
    bars.draw_run(run, path)


def pictures(run):
    """Drawing functions by picture."""
    bending = ({"structures.png": draw_structures}
               if (run.folder / "structures.csv").is_file() else {})
    return {"bounds.png": draw_bounds, "mechanism.png": draw_mechanism, **bending,
            "dependence.png": draw_dependence}
