#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/mud.png of a run of prm/consolidation/mud_mpm.prm, with finite differences
of the equation in material coordinates that its parameter file gives, and prints the errors:

    mud.py MUD
"""

import pathlib
import sys

import numpy as np
from scipy.integrate import solve_ivp
from scipy.sparse import diags

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

M, WEIGHT, FLUID, MOBILITY = 1e4 / 0.9, 680. * 9.81, 5.5e9, 1e-7 / 9810.
LOWEST, HIGHEST = 0.0112702, 0.9887298  # material coordinates of the observed points (m)


def differences(times, n=400):
    """Pressures at the lowest and displacements of the highest points."""
    d = 1. / n
    Z = (np.arange(n) + 0.5) * d

    def pressure(e):
        return WEIGHT * (1. - Z) + M * e

    def rate(_, e):
        p, flow = pressure(e), np.zeros(n + 1)
        flow[1:-1] = MOBILITY * np.exp(-(e[1:] + e[:-1]) / 2.) * (p[1:] - p[:-1]) / d
        flow[-1] = -MOBILITY * p[-1] / (d / 2.)
        return np.exp(-e) * (flow[1:] - flow[:-1]) / d / (1. + M / FLUID)

    start = -WEIGHT * (1. - Z) / (1. + M / FLUID) / FLUID
    pattern = diags([np.ones(n - 1), np.ones(n), np.ones(n - 1)], [-1, 0, 1])
    y = solve_ivp(rate, (0., times[-1]), start, "BDF", times, rtol=1e-8, atol=1e-10,
                  jac_sparsity=pattern).y.T
    nodes = np.arange(n + 1) * d
    return (np.array([np.interp(LOWEST, Z, pressure(e)) for e in y]),
            np.array([np.interp(HIGHEST, nodes, np.append(0., np.cumsum(np.exp(e) - 1.) * d))
                      for e in y]))


def main(folder):
    table = geocone.Run(folder).statistics
    t = np.asarray(table["time (s)"])
    p = np.asarray(table["excess pore pressure of point 1 (Pa)"])
    u = np.asarray(table["displacement of point 2 y (m)"])
    p_exact, u_exact = differences(t)
    print(f"t = {t[-1]:g} s: pressure {p[-1]:.2f} Pa ({100. * (p[-1] / p_exact[-1] - 1.):+.2f} %), "
          f"settlement {-u[-1]:.5f} m ({100. * (u[-1] / u_exact[-1] - 1.):+.2f} %)")
    figure = Figure(figsize=(9., 3.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    days = t / 86400.
    for axes, ours, exact, label in ((left, p / 1e3, p_exact / 1e3, "pressure at the base (kPa)"),
                                     (right, -u, -u_exact, "settlement of the surface (m)")):
        axes.plot(days, exact, color="0.2", lw=1.2, label="finite differences")
        axes.plot(days[::8], ours[::8], "o", ms=3.5, label="material points")
        axes.set(xlabel="time (days)", ylabel=label, xlim=(0., None), ylim=(0., None))
    left.legend(frameon=False)
    figure.savefig(ROOT / "doc/cookbook/mud.png", dpi=110)


main(sys.argv[1])
