#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/round_cavity.png: the pressure in an expanding cavity in clay, exact and by
runs of prm/axisymmetric/cavity_expansion.prm, _cylinder.prm, and of the latter by finite elements
(small strains). Prints the errors:

    cavity_expansion.py [SPHERE CYLINDER FEM]     # folders; without them: exact values only

Exact: at the point that was at r0 when the cavity began to open are r, the radial stress s
and the hoop stress t (tension positive); k = 2 for the sphere, 1 for the cylinder. With
logarithmic strains e_r = ln(dr/dr0), e_t = ln(r/r0) both Hooke's law and, where
t - s = 2 s_u, the change of volume, which is elastic, give dr/dr0; and equilibrium is
ds/dr = k (t - s)/r. Both are integrated from the free outer side at b inwards, where the
displacement is that for which the wall is at a."""

import csv
import pathlib
import sys

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

S_U, G, NU, B, HEIGHT = 1e4, 5e5, 0.49, 30., 0.2
LAMBDA = 2. * G * NU / (1. - 2. * NU)


def pressure(k, a):
    """p/s_u where a wall that was at 1 is at a."""
    def rates(r0, y):
        r, s = y
        e_t = np.log(r / r0)
        e_r = (s - k * LAMBDA * e_t) / (LAMBDA + 2. * G)
        t = LAMBDA * (e_r + k * e_t) + 2. * G * e_t
        if t - s > 2. * S_U:
            t = s + 2. * S_U
            trace = s + 2. * t if k == 2 else (1. + NU) * (s + t)
            volume = np.exp(trace / (3. * LAMBDA + 2. * G))
            stretch = volume * (r0 / r) ** k
        else:
            stretch = np.exp(e_r)
        return [stretch, k * (t - s) / r * stretch]

    def wall(u):
        end = solve_ivp(rates, [B, 1.], [B + u, 0.], method="LSODA", rtol=1e-9, atol=1e-8,
                        max_step=B / 50.).y[:, -1]
        return end[0], -end[1] / S_U

    u = (a ** (k + 1) - 1.) / ((k + 1) * B ** k)  # without change of volume
    u = brentq(lambda v: wall(v)[0] - a, 0.2 * u, 2. * u, xtol=1e-12, rtol=1e-12)
    return wall(u)[1]


def computed(folder, k, moves=True):
    """Radii at the end and pressures over s_u of the steps of a run; the force of a step acts
    on the wall where it is when the step begins, or, with small strains, at the start."""
    with open(pathlib.Path(folder) / "statistics.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    a = np.array([1. + 0.1 * float(row["time (s)"]) for row in rows])
    before = np.concatenate([[1.], a[:-1]]) if moves else np.ones_like(a)
    area = 0.5 * (np.pi * before) ** 2 if k == 2 else 2. * np.pi * before * HEIGHT
    return a, np.array([float(row["load (N)"]) for row in rows]) / area / S_U


def main():
    marks = np.array([1.02, 1.05, 1.1, 1.2, 1.35, 1.5, 1.75, 2.])
    exact = {k: np.array([pressure(k, a) for a in marks]) for k in (1, 2)}
    for k, name, factor in ((2, "sphere", 4. / 3.), (1, "cylinder", 1.)):
        limit = factor * (1. + np.log(G / S_U * (1. - marks ** -(k + 1.))))
        print(f"{name}: a, p/s_u, and without change of volume in an infinite body")
        for row in zip(marks, exact[k], limit):
            print("  {:.2f}  {:.4f}  {:.4f}".format(*row))
    if len(sys.argv) != 4:
        return
    figure = Figure(figsize=(6., 4.), layout="constrained")
    axes = figure.add_subplot()
    fine = np.concatenate([1. + np.geomspace(1e-3, 0.1, 30), np.linspace(1.11, 2., 40)])
    for k in (2, 1):
        axes.plot(fine, [pressure(k, a) for a in fine], "k--", label="exact" if k == 2 else None)
    for folder, k, label, color in zip(
            sys.argv[1:], (2, 1, 1),
            ("sphere, MPM", "cylinder, MPM", "cylinder, FEM: small strains"), style.COLORS):
        a, p = computed(folder, k, moves=not label.endswith("strains"))
        axes.plot(a, p, color=color, label=label)
        print(label, ", ".join(f"{100. * (np.interp(m, a, p) / e - 1.):+.2f} % at {m}"
                               for m, e in zip(marks, exact[k])))
    axes.set(xlabel="radius of the cavity over the initial one",
             ylabel="pressure over $s_u$", xlim=(1., 2.), ylim=(0., None))
    axes.grid(True)
    axes.legend()
    figure.savefig(ROOT / "doc" / "cookbook" / "round_cavity.png", dpi=110)


if __name__ == "__main__":
    main()
