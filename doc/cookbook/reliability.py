#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/reliability.png of a run of prm/reliability/slope.prm: the interval of the
probability of failure against the number of samples, and a sample that fails, with the factor of
its strength and its mechanism:

    reliability.py RUN"""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402


def draw_interval(axes, run, table):
    verdict = table["verdict (-)"]
    n = table["sample (-)"]
    failed, undecided = np.cumsum(verdict < 0), np.cumsum(verdict == 0)
    axes.fill_between(n, failed / n, (failed + undecided) / n, step="post", color=style.ORANGE,
                      label="failed to failed + undecided", linewidth=0.)
    axes.plot(n, failed / n, color=style.ORANGE, linewidth=1.)
    limits = [run.value(f"reliability/limit_{side}") for side in ("lower", "upper")]
    for limit in limits:
        axes.axhline(limit, color=style.BLUE, linestyle="--",
                     label="limits, confidence 0.95" if limit == limits[0] else None)
    axes.set(xlabel="number of samples", ylabel="probability of failure (-)", xscale="log",
             xlim=(10, n[-1]), ylim=(0., 2. * limits[1]))
    axes.legend()


def draw_sample(axes, run):
    field = run.fields("sample")
    x, y = field.points[:, 0], field.points[:, 1]
    cells = np.arange(len(x)).reshape(-1, 3)
    factor = field.point_data["cohesion_factor"][::3]
    mesh = Triangulation(x, y, cells)
    picture = axes.tripcolor(mesh, factor, cmap="viridis_r")
    axes.figure.colorbar(picture, ax=axes, label="strength over its mean (-)", shrink=0.7)
    v = field.point_data["velocity"]
    centre = [a[cells].mean(axis=1) for a in (x, y, v[:, 0], v[:, 1])]
    speed = np.hypot(centre[2], centre[3])
    moves = speed > 0.05 * speed.max()
    axes.quiver(*[a[moves] for a in centre], color="k", scale=15. * speed.max(), width=0.002)
    axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")


def main(folder):
    run = geocone.read(folder)
    table = run.table("samples")
    figure = Figure(figsize=(11., 3.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1., 1.6))
    draw_interval(left, run, table)
    draw_sample(right, run)
    figure.savefig(pathlib.Path(__file__).with_suffix(".png"), dpi=110)


if __name__ == "__main__":
    main(sys.argv[1])
