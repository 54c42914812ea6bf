# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""shakedown.png: the shakedown factors by mesh; cycle.png: plastic strains of a cycle at the
upper factor, what remains of them, and the residual stress of the lower factor."""

import numpy as np

from geocone.plots import overlay
from geocone.plots.answer import heading
from geocone.plots.bounds import plain_ticks
from geocone.style import (BLUE, COLORS, GREY, STRAINS, Skipped, add_bar, level, panels, plain,
                           save, sizes_of, subplots, unit_for)


SMALLEST = 0.01  # per cent of an error that is shown


def draw_factors(run, path):
    """Draws the factors of all meshes."""
    table = run.table("shakedown")
    cells = table["triangles (-)"]
    if len(cells) < 2:
        raise Skipped("there is one mesh only")
    lower, upper = table["lower factor (-)"], table["upper factor (-)"]
    figure, (axes, errors) = subplots(1, 2, figsize=(11., 4.4))
    axes.fill_between(cells, lower, upper, color=BLUE, alpha=0.15, linewidth=0.)
    for name, color, style, label in (
            ("proven upper bound (-)", "k", "s--", "proven upper bound"),
            ("upper factor (-)", COLORS[1], "o-", "upper factor"),
            ("lower factor (-)", BLUE, "o-", "lower factor"),
            ("factor at first yield (-)", GREY, ":", "first yield")):
        if np.any(np.isfinite(table[name])):
            axes.semilogx(cells, table[name], style, color=color, label=label)
    reference = run.value("reference/expected")
    if reference is not None:
        axes.axhline(reference, color="k", linestyle="-.", linewidth=1.2, label="reference")
    axes.set(xlabel="triangles", ylabel="factor of the loads that vary (-)",
             title=f"shakedown factors: {plain(run.value('shakedown/mode'))}")
    for name, label in (("gap (-)", "gap of the factors"),
                        ("error of elastic stresses (-)", "error of elastic stresses")):
        errors.loglog(cells, np.maximum(100. * table[name], SMALLEST), "o-", label=label)
    errors.set(xlabel="triangles", ylabel="%", title="errors")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.5 * (high - low))  # room for the legend
    for one in (axes, errors):
        one.legend()
        plain_ticks(one.xaxis)
    plain_ticks(errors.yaxis)
    figure.suptitle(heading(run), fontsize=13)
    save(figure, run, path)


def draw_cycle(run, path):
    """Draws plastic strains of a cycle and residual stresses."""
    field, = run.states("shakedown")
    first = field.cells[:, 0]
    total = field.data["plastic_strain_of_cycle"][first, 0]
    net = field.data["net_plastic_strain"][first, 0]
    residual = field.data["residual_stress_xx"][:, 0]
    most = max(level(total, sizes_of(field)), np.finfo(float).tiny)
    view = field.points.min(axis=0), field.points.max(axis=0)
    figure, axes_of = panels(3, view)
    for axes, values, title in ((axes_of[0], total, "plastic strain of a cycle"),
                                (axes_of[1], net, "what remains of it")):
        drawn = axes.tripcolor(*field.points.T, field.cells, facecolors=values / most,
                               cmap=STRAINS, vmin=0., vmax=1.)
        axes.set_title(title)
        add_bar(axes, drawn, "relative", extend="max")
    unit, factor = unit_for(np.abs(residual).max(), run.unit("Pa"))
    largest = max(level(np.abs(residual)[first], sizes_of(field), 0.002) / factor,
                  np.finfo(float).tiny)
    drawn = axes_of[2].tripcolor(*field.points.T, field.cells, residual / factor,
                                 shading="gouraud", cmap="RdBu_r", vmin=-largest, vmax=largest)
    axes_of[2].set_title("residual stress xx")
    add_bar(axes_of[2], drawn, unit, extend="both")
    for axes in axes_of:
        overlay.draw_scene(axes, run, field)
    figure.suptitle(f"{heading(run)}: {plain(run.value('shakedown/mode'))}", fontsize=13)
    save(figure, run, path, cropped=True)


def pictures(_run):
    """Drawing functions of the pictures of a shakedown analysis, by name."""
    return {"shakedown.png": draw_factors, "cycle.png": draw_cycle}
