#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/contact_hopper.png of runs of prm/contact/hopper.prm with smooth and with
rough walls, and prints how much sand has left, how hard the wall is pressed and which stress
there is at the outlet, beside hour-glass theory:

    hopper.py RUN [RUN ...]     # without runs: theory only

The theory is told in the parameter file."""

import pathlib
import sys

import numpy as np
from scipy.integrate import solve_ivp

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

HALF_ANGLE, K, R0, R1, BOTTOM, DENSITY = np.radians(15.), 3., 0.2, 0.8, 0.15, 2000.
RADIAL_GRAVITY = 10. * np.sin(HALF_ANGLE) / HALF_ANGLE
MASS = HALF_ANGLE * DENSITY * (R1**2 - R0**2) / 2.  # of half the hopper (kg/m)


def integral(n, r):
    """Of r^n from the outlet to r."""
    return np.log(r / R0) if n == -1. else (r**(n + 1.) - R0**(n + 1.)) / (n + 1.)


class Theory:
    def __init__(self, friction):
        self.m = K - 1. + friction * K / HALF_ANGLE
        self.t = np.linspace(0., 0.6, 1201)
        self.A, self.r = solve_ivp(lambda t, y: [self.growth(*y), -y[0] / y[1]], (0., 0.6),
                                   [0., R1], t_eval=self.t, rtol=1e-9, atol=1e-11).y
        out = HALF_ANGLE * DENSITY * (R1**2 - self.r**2) / 2.
        v = self.A / R0  # from the outlet to the end of the mesh it falls
        fall = R0 * np.sin(HALF_ANGLE) / HALF_ANGLE - BOTTOM
        later = (np.sqrt(v**2 + 2. * RADIAL_GRAVITY * fall) - v) / RADIAL_GRAVITY
        self.lost = np.interp(self.t, self.t + later, out, left=0.) / MASS

    def growth(self, A, r):
        """A' so that p is 0 at the outlet and at r."""
        return ((RADIAL_GRAVITY * integral(-self.m, r) - A**2 * integral(-self.m - 3., r))
                / integral(-self.m - 1., r))

    def pressure(self, t, r):
        """p(r) at the time t (Pa)."""
        i = np.searchsorted(self.t, t)
        A = self.A[i]
        r = np.minimum(r, self.r[i])
        return DENSITY * r**self.m * (A**2 * integral(-self.m - 3., r)
                                      + self.growth(A, self.r[i]) * integral(-self.m - 1., r)
                                      - RADIAL_GRAVITY * integral(-self.m, r))

    def wall(self, t):
        """The normal force on the wall (N/m)."""
        r = np.linspace(R0, self.r[np.searchsorted(self.t, t)], 2001)
        return np.trapz(K * self.pressure(t, r), r)


def lost(run):
    """Times and the parts of the points that have left."""
    times = run.times("points")
    n = np.array([len(run.fields("points", time=t).points) for t in times])
    return np.array(times), 1. - n / n[0]


def wall_force(run, t):
    """Mean normal and tangential forces on the wall within 25 ms of t (N/m)."""
    near = np.abs(run.statistics["time (s)"] - t) < 0.025
    x, y = (run.statistics[f"reaction wall {c} (N/m)"][near].mean() for c in "xy")
    c, s = np.cos(HALF_ANGLE), np.sin(HALF_ANGLE)
    return -c * x + s * y, s * x + c * y


def radial_stress(run, t):
    """Radii and mean radial pressures of the points between them (Pa)."""
    field = run.fields("points", time=t)
    x, y = field.points[:, 0], field.points[:, 1]
    r = np.hypot(x, y)
    s = field.point_data
    p = -(s["stress_xx"] * x**2 + 2. * s["stress_xy"] * x * y + s["stress_yy"] * y**2) / r**2
    edges = np.arange(R0 - 0.03, 0.61, 0.03)
    bins = np.digitize(r, edges)
    kept = [i for i in range(1, len(edges)) if (bins == i).any()]
    return (np.array([0.5 * (edges[i - 1] + edges[i]) for i in kept]),
            np.array([p[bins == i].mean() for i in kept]))


def main():
    for friction in (0., 0.2):
        theory = Theory(friction)
        print(f"mu = {friction}: {100. * np.interp(0.45, theory.t, theory.lost):.2f} % have left "
              f"after 0.45 s, {2. * DENSITY * HALF_ANGLE * np.interp(0.3, theory.t, theory.A):.1f} "
              f"kg/(m s) leave at 0.3 s; wall {theory.wall(0.3):.0f} N/m")
    runs = [geocone.read(folder) for folder in sys.argv[1:]]
    if not runs:
        return
    figure = Figure(figsize=(10.4, 4.2), layout="constrained")
    body, mass, stress = figure.subplots(1, 3, width_ratios=(0.95, 1., 1.))
    field = runs[0].fields("points", time=0.3)
    speed = np.hypot(*field.point_data["velocity"][:, :2].T)
    for sign in (-1., 1.):
        drawn = body.scatter(sign * field.points[:, 0], field.points[:, 1], c=speed, s=1.6,
                             cmap=style.STEPS, vmin=0., linewidths=0.)
        body.plot([sign * r * np.sin(HALF_ANGLE) for r in (R0, 0.84)],
                  [r * np.cos(HALF_ANGLE) for r in (R0, 0.84)], "k", linewidth=1.5)
    body.set(aspect="equal", xlabel="x (m)", ylabel="y (m)", title="t = 0.3 s, smooth")
    figure.colorbar(drawn, ax=body, label="speed (m/s)", shrink=0.85)
    for run, color in zip(runs, style.COLORS):
        friction = float(run.parameters["Obstacles/wall/Friction coefficient"])
        theory = Theory(friction)
        t, part = lost(run)
        mass.plot(t, 100. * part, "o", color=color, markersize=4, label=f"$\\mu$ = {friction:g}")
        mass.plot(theory.t, 100. * theory.lost, "--", color=color)
        r, p = radial_stress(run, 0.3)
        stress.plot(r, p / 1e3, "o", color=color, markersize=4)
        r_theory = np.linspace(R0, 0.6, 200)
        stress.plot(r_theory, theory.pressure(0.3, r_theory) / 1e3, "--", color=color)
        expected = np.interp(t, theory.t, theory.lost)
        rate, of_theory = (q[(t > 0.39) & (t < 0.41)] - q[(t > 0.19) & (t < 0.21)]
                           for q in (part, expected))
        normal, tangential = wall_force(run, 0.3)
        print(f"{run.folder}: {100. * part[-1]:.2f} % have left, {part[-1] / expected[-1] - 1.:+.3f}; "
              f"{2. * MASS * rate[0] / 0.2:.1f} kg/(m s) from 0.2 to 0.4 s, "
              f"{rate[0] / of_theory[0] - 1.:+.3f}; wall {normal:.0f} N/m, "
              f"{normal / theory.wall(0.3) - 1.:+.3f}, friction {tangential / normal:.3f} of it; "
              f"p at r = {r[1]:.3f}: {p[1]:.0f} Pa, theory {theory.pressure(0.3, r[1]):.0f}")
    mass.set(xlabel="t (s)", ylabel="sand that has left (%)", xlim=(0., 0.46), ylim=(0., 56.))
    mass.plot([], [], "k--", label="theory")
    mass.legend()
    stress.set(xlabel="r (m)", ylabel="radial pressure (kPa), t = 0.3 s", xlim=(0.15, 0.62),
               ylim=(0., None))
    figure.savefig(ROOT / "doc" / "cookbook" / "contact_hopper.png", dpi=95)


if __name__ == "__main__":
    main()
