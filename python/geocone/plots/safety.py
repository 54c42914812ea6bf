# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""safety.png: how far observed points have moved when the strength was reduced."""

import numpy as np

from geocone.plots.answer import heading
from geocone.style import COLORS, Skipped, save, subplots


def draw_run(run, path):
    """Draws displacements against the reduction of strength, and the factor of safety."""
    table = run.statistics
    if "strength factor (-)" not in table:
        raise Skipped("no stage reduces the strength")
    factor = table["strength factor (-)"]
    reduced = factor != 1.  # what the loads did before is another curve
    if not np.any(reduced):
        raise Skipped("the loads are not carried without a reduction")
    figure, axes = subplots(figsize=(7., 4.6))
    names = sorted({key.rsplit(" ", 2)[0] for key in table
                    if key.startswith("displacement of point")})
    if not names:
        raise Skipped("no points are observed ('Observation/Points')")
    for i, name in enumerate(names):
        moved = np.hypot(table[f"{name} x (m)"], table[f"{name} y (m)"])
        axes.semilogy(factor[reduced], 1e3 * moved[reduced], "o-", color=COLORS[i % len(COLORS)],
                      markersize=3.5, label=name.replace("displacement of ", ""))
    safety = run.summary["safety"]
    if safety["factor"] is not None:
        axes.axvspan(safety["lower"], safety["upper"], color="black", alpha=0.3,
                     linewidth=1.5,
                     label=f"no equilibrium beyond {safety['lower']:.4f} to "
                           f"{safety['upper']:.4f}")
    axes.set(title=heading(run), xlabel="factor F by which c and tan(phi) are divided (-)",
             ylabel="displacement (mm)")
    axes.legend()
    save(figure, run, path)
