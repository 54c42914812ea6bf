#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/images/cavity.png: pressure in a cavity that is widened in cohesionless
Mohr-Coulomb soil, of runs of prm/validation/cavity.prm and exact:

    cavity.py LABEL=RUN [LABEL=RUN ...]     # without runs: the exact pressures only

The exact curve is that of Yu and Houlsby (1991) for logarithmic strains, by quadrature.
Stresses over the initial p0, lengths over the radius c of the plastic zone, compression
positive; alpha, beta = (1 + sin)/(1 - sin) of phi and theta. In the plastic zone
equilibrium and strength give s_r = s_c r^-(1 - 1/alpha), s_c = 2 alpha/(1 + alpha); the
flow rule beta e_r + e_t = h(s_r) with h of the elastic strains; so
    r0^(1/beta) dr0 = r^(1/beta) exp(h/beta) dr,
from the cavity to c, where the elastic displacement is (s_c - 1)/(2 G)."""

import csv
import pathlib
import sys

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402


def pressure(ratio, phi=40., theta=10., nu=0.3, G=100.):
    """p/p0 where the radius of the cavity is ratio times the initial one."""
    alpha, beta = ((1. + s) / (1. - s) for s in np.sin(np.radians([phi, theta])))
    s_c = 2. * alpha / (1. + alpha)
    compliance = (1. - nu) / (2. * G)  # (1 - nu^2)/E

    def h(s_r):
        r, t = s_r - 1., s_r / alpha - 1.
        return compliance * (beta * (r - nu / (1. - nu) * t) + t - nu / (1. - nu) * r)

    def stress(r):
        return s_c * r ** (1. / alpha - 1.)

    n = 1. + 1. / beta
    c0 = 1. - (s_c - 1.) / (2. * G)

    def widened(a):
        swept = quad(lambda r: r ** (1. / beta) * np.exp(h(stress(r)) / beta), a, 1.,
                     limit=500)[0]
        left = c0 ** n - n * swept
        return a / left ** (1. / n) if left > 0. else 1e9

    return stress(brentq(lambda a: widened(a) - ratio, 1e-3, 0.9999))


def main():
    for phi, theta in ((40, 0), (40, 10), (30, 15)):
        print(f"phi = {phi}, theta = {theta}: p/p0 =",
              ", ".join(f"{pressure(r, phi, theta):.4f} at {r}" for r in (1.1, 1.2, 1.5, 2)))
    runs = [argument.split("=", 1) for argument in sys.argv[1:]]
    if not runs:
        return
    figure = Figure(figsize=(6., 4.), layout="constrained")
    axes = figure.add_subplot()
    axes.set_prop_cycle(color=style.COLORS)
    radii = np.linspace(1.01, 2., 60)
    axes.plot(radii, [pressure(r) for r in radii], "k--", label="exact (Yu, Houlsby)")
    for label, folder in runs:
        with open(pathlib.Path(folder) / "statistics.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        a = np.array([1. + 0.1 * float(row["time (s)"]) for row in rows])
        p = np.abs([float(row["load (N/m)"]) for row in rows]) / a / 1e5
        axes.plot(a, p, label=label)
        print(label, ", ".join(f"{100. * (np.interp(r, a, p) / pressure(r) - 1.):+.1f} % at {r}"
                               for r in (1.02, 1.05, 1.1, 1.2, 1.35, 1.5, 1.75, 2)))
    axes.set(xlabel="radius a (m)", ylabel="pressure over $p_0$ (-)", xlim=(1., 2.),
             ylim=(0., None), title="cavity in sand, φ = 40°, θ = 10°")
    axes.grid(True)
    axes.legend()
    figure.savefig(ROOT / "doc" / "images" / "cavity.png", dpi=120)


if __name__ == "__main__":
    main()
