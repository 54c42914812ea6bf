# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""newton.png: the residuals of each step, and how fast they fall."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator

from geocone.style import GREY, STEPS, plain, save, subplots


def draw_attempts(axes, table, residual):
    """Draws the residuals of the attempts at all steps, a line for each.
    @return the lines of the table and the colour of each attempt, and the colour bar"""
    scale = ScalarMappable(Normalize(1., max(2., table["step"][-1])), STEPS)
    attempts = []
    starts = np.flatnonzero(table["iteration"] == 0.)[1:]
    for rows in np.split(np.arange(len(residual)), starts):
        failed = table["converged"][rows[0]] == 0.
        color = GREY if failed else scale.to_rgba(table["step"][rows[0]])
        axes.semilogy(table["iteration"][rows], residual[rows], color=color, marker="o",
                      markersize=3.5, linewidth=1.2, linestyle=":" if failed else "-")
        attempts.append((rows, color))
    if np.any(table["converged"] == 0.):
        axes.plot([], [], color=GREY, linestyle=":", marker="o", markersize=3.5,
                  label="failed, the step was cut")
        axes.legend()
    axes.set(xlabel="iteration", ylabel="relative residual (-)")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    return attempts, {"mappable": scale, "label": "step",
                      "ticks": MaxNLocator(6, integer=True)}


def draw_run(run, path):
    """Draws newton.png."""
    table = run.newton
    residual = table["relative residual (-)"]
    residual = np.where(residual > 0., residual, np.nan)
    limits = (np.nanmin([*residual, 1e-12]) / 3., np.nanmax([*residual, 1.]) * 3.)
    figure, (axes, order) = subplots(1, 2, figsize=(10.5, 4.6),
                                     gridspec_kw={"width_ratios": [3., 2.]})
    attempts, bar = draw_attempts(axes, table, residual)
    axes.set(title=f"{plain(run.name)}: Newton's method", ylim=limits)
    for rows, color in attempts:
        r, full = residual[rows], table["step length (-)"][rows[1:]] == 1.
        order.loglog(r[:-1][full], r[1:][full], "o", color=color, markersize=3.5)
    x = np.array([1e-16, 1.])
    order.plot(x, x**2, "k--", linewidth=1.2, label="quadratic: slope 2")
    order.plot(x, x, ":", color="#606060", label="no decrease")
    order.legend(loc="upper left")
    order.set(title="iterations of full length", xlim=limits, ylim=limits,
              xlabel="relative residual before (-)",
              ylabel="relative residual after (-)")
    figure.colorbar(ax=order, pad=0.02, **bar)
    save(figure, run, path)
