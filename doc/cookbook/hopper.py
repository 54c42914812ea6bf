#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/contact_hopper.png of runs of prm/contact/hopper.prm with smooth and with
rough walls, and prints the discharge, the force on the wall and the stress at the outlet, with
theory:

    hopper.py RUN [RUN ...]     # without runs: theory only

Hour-glass theory is documented in the parameter file. Two extensions are added here,
without fitted parameters.

The jet. Below the outlet the sand, half as wide as w(s), falls as a jet with free sides, which
still converges: u w = u0 w0. Its convergence is stopped by a pressure across it,
P_x = rho u (u w')' (w^2 - x^2)/(2 w), and under lateral compression P_y = P_x/k. With means
over its width, z = ln(w/w0), lengths over w0 and F = u0^2/(g w0), momentum along the jet is

    z''' + z' z" = 3 k (1/F + z' exp(-2 z)),   z(0) = 0, z'(0) = -a, free fall far below,

and the pressure at the outlet is p(r0) = rho u0^2 z"(0)/(3 k), zero where u0^2 <= g r0: the sand
there does not converge faster than it falls.

The turn of principal stresses at a rough wall, to the first order in the angle a (Brennen and
Pearce 1978): shear stress is mu P_t theta/a, so that each place of the cross-section has its own
Mohr circle and the mean of P_r is P_t/K with K < k; the speed falls towards the wall by
d ln u/d theta = -2 tan(2 psi), psi the turn.

To the second order in a, vertical gravity acts on a smooth hopper by g (1 - (4/3) a^2/6) in place
of the mean of its radial part, g (1 - a^2/6), and raises the surface without stress on the axis by
r0 a^2/18: both are less than 1 % of the discharge, and left out."""

import pathlib
import sys

import numpy as np
from scipy.integrate import solve_bvp, solve_ivp

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

HALF_ANGLE, K, R0, R1, BOTTOM, DENSITY = np.radians(15.), 3., 0.2, 0.8, 0.15, 2000.
SIN_PHI, GRAVITY = 0.5, 10.
RADIAL_GRAVITY = GRAVITY * np.sin(HALF_ANGLE) / HALF_ANGLE
MASS = HALF_ANGLE * DENSITY * (R1**2 - R0**2) / 2.  # of half the hopper (kg/m)


def integral(n, r):
    """Of r^n from the outlet to r."""
    return np.log(r / R0) if n == -1. else (r**(n + 1.) - R0**(n + 1.)) / (n + 1.)


def jet_pressure(F):
    """p(r0)/(rho u0^2) of the jet below the outlet."""
    def slope(s, z):
        return np.vstack([z[1], z[2], 3. * K * (1. / F + z[1] * np.exp(-2. * z[0])) - z[1] * z[2]])

    def ends(at, below):
        return np.array([at[0], at[1] + HALF_ANGLE, below[1] + np.exp(2. * below[0]) / F])

    s = np.linspace(0., 6., 200)
    jump, decay = 1. / F - HALF_ANGLE, np.exp(-np.sqrt(3. * K) * s)
    z = np.vstack([-0.5 * np.log1p(2. * s / F) + jump * (1. - decay) / np.sqrt(3. * K),
                   -1. / (F + 2. * s) + jump * decay, -jump * np.sqrt(3. * K) * decay])
    solution = solve_bvp(slope, ends, s, z, tol=1e-8, max_nodes=20000)
    if not solution.success:
        raise RuntimeError(solution.message)
    return solution.y[2, 0] / (3. * K)


F_OF_JET = np.linspace(1., 5., 33) / HALF_ANGLE
P_OF_JET = np.array([jet_pressure(F) for F in F_OF_JET])


def cross_section(friction):
    """P_t over the mean of P_r, the mean of u^2 over the square of that of u, and u at the wall
    over that on the axis."""
    part = np.linspace(0., 1., 2001)  # theta/a
    shear = friction * part  # over P_t
    cos2 = 1. - SIN_PHI**2
    mean = (1. - np.sqrt(1. - cos2 * (1. + shear**2))) / cos2  # of Mohr's circle, over P_t
    turn = shear / (1. - mean)  # tan(2 psi)
    sums = np.concatenate([[0.], np.cumsum(0.5 * (turn[1:] + turn[:-1]))]) * part[1]
    u = np.exp(-2. * HALF_ANGLE * sums)
    return (1. / np.trapz(2. * mean - 1., part), np.trapz(u**2, part) / np.trapz(u, part)**2, u[-1])


class Theory:
    """Hour-glass theory; complete: with the jet and the turn of the principal stresses."""

    def __init__(self, friction, complete=True):
        self.complete = complete
        self.K, self.spread, self.slow = cross_section(friction) if complete else (K, 1., 1.)
        self.m = self.K - 1. + friction * self.K / HALF_ANGLE
        self.t = np.linspace(0., 0.6, 1201)
        self.A, self.r = solve_ivp(lambda t, y: [self.growth(*y), -y[0] / y[1]], (0., 0.6),
                                   [0., R1], t_eval=self.t, rtol=1e-9, atol=1e-11).y
        out = HALF_ANGLE * DENSITY * (R1**2 - self.r**2) / 2.
        v = self.A / R0  # from the outlet to the end of the mesh it falls
        fall = R0 * np.sin(HALF_ANGLE) / HALF_ANGLE - BOTTOM
        later = (np.sqrt(v**2 + 2. * RADIAL_GRAVITY * fall) - v) / RADIAL_GRAVITY
        self.lost = np.interp(self.t, self.t + later, out, left=0.) / MASS

    def outlet(self, A):
        """p(r0)/rho."""
        F = (A / R0)**2 / (GRAVITY * R0 * HALF_ANGLE)
        if not self.complete or F <= F_OF_JET[0]:
            return 0.
        return (A / R0)**2 * max(np.interp(F, F_OF_JET, P_OF_JET), 0.)

    def growth(self, A, r):
        """A' so that p is that of the jet at the outlet and 0 at r."""
        return ((RADIAL_GRAVITY * integral(-self.m, r)
                 - self.spread * A**2 * integral(-self.m - 3., r)
                 - self.outlet(A) * R0**-self.m) / integral(-self.m - 1., r))

    def pressure(self, t, r):
        """p(r) at the time t (Pa)."""
        i = np.searchsorted(self.t, t)
        A = self.A[i]
        r = np.minimum(r, self.r[i])
        return DENSITY * r**self.m * (self.outlet(A) * R0**-self.m
                                      + self.spread * A**2 * integral(-self.m - 3., r)
                                      + self.growth(A, self.r[i]) * integral(-self.m - 1., r)
                                      - RADIAL_GRAVITY * integral(-self.m, r))

    def wall(self, t):
        """The normal force on the wall (N/m)."""
        r = np.linspace(R0, self.r[np.searchsorted(self.t, t)], 2001)
        return np.trapz(self.K * self.pressure(t, r), r)


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
    for friction, complete in ((0., False), (0., True), (0.2, False), (0.2, True)):
        theory = Theory(friction, complete)
        out = HALF_ANGLE * DENSITY * (R1**2 - np.interp([0.2, 0.4], theory.t, theory.r)**2)
        print(f"mu = {friction}, {'complete' if complete else 'hour-glass'}: {100. * np.interp(0.45, theory.t, theory.lost):.2f} % have left "
              f"after 0.45 s, {2. * DENSITY * HALF_ANGLE * np.interp(0.3, theory.t, theory.A):.1f} "
              f"kg/(m s) leave at 0.3 s, {(out[1] - out[0]) / 0.2:.1f} from 0.2 to 0.4 s; wall "
              f"{theory.wall(0.3):.0f} N/m, outlet {theory.pressure(0.3, R0):.0f} Pa, "
              f"speed at the wall over that on the axis {theory.slow:.3f}")
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
    mass.set(xlabel="t (s)", ylabel="discharged sand (%)", xlim=(0., 0.46), ylim=(0., 56.))
    mass.plot([], [], "k--", label="theory")
    mass.legend()
    stress.set(xlabel="r (m)", ylabel="radial pressure (kPa), t = 0.3 s", xlim=(0.15, 0.62),
               ylim=(0., None))
    figure.savefig(ROOT / "doc" / "cookbook" / "contact_hopper.png", dpi=95)


if __name__ == "__main__":
    main()
