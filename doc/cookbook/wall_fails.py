#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/contact_wall_fails.png of runs of prm/contact/wall_fails.prm: the first one
at some times, the way of the wall of all of them; and prints this way beside that of two rigid
blocks:

    wall_fails.py RUN [RUN ...]     # without runs: theory only

The theory is documented in the parameter file."""

import pathlib
import sys

import numpy as np
from scipy.optimize import minimize

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

GRAVITY, RAMP, HEEL, SAND = 10., 0.5, 0.625, 2000.
WALL = 2400. * ((0.3 + HEEL) * 0.1 + 0.1)  # kg/m
WEDGE = SAND / np.sqrt(3.)
LEFT = WALL + SAND * HEEL - WEDGE / 2.  # the wall with the sand that moves as it does
CRITICAL = SAND * GRAVITY / 6. / (GRAVITY * (WALL + SAND * HEEL))


def acceleration(friction, dilatancy=np.pi / 6.):
    """Of the wall, by rigid blocks (m/s^2)."""
    fall = 0.5 * np.tan(np.pi / 3. - dilatancy)  # of the wedge, over the way of the wall
    s = np.sqrt(3.) / 2.
    share = 0.5 - friction * s  # what of the wedge's force on the block drives it
    at_rest, slope = WEDGE * GRAVITY / (2. * s), WEDGE * (fall / s + 1.) / 2.
    return (at_rest * share - friction * LEFT * GRAVITY) / (LEFT + slope * share)


def planes(friction):
    """For theta = phi: angles of the planes from the horizontal (degrees), for which the sand's
    accelerations, given the wall's, make sum m (u^2/2 - g u) least, and a of the wall (m/s^2)."""
    phi, wall = np.pi / 6., WALL + SAND * HEEL

    def parts(left, right):
        """Masses beside the vertical plane, way and fall of the wedge over the way of the wall."""
        m = SAND / 2. / np.tan([left, right])
        w = np.sin(left - phi) / np.sin(left + right - 2. * phi)
        return m[0], m.sum(), w, w * np.sin(right - phi)

    def acceleration_of(left, right):
        m_left, m, w, fall = parts(left, right)
        u, across = np.array([-w * np.cos(right - phi), -fall]), left - phi
        return np.linalg.solve(
            [[m * u[0], -np.sin(across), np.sin(right - phi)],
             [m * u[1], -np.cos(across), -np.cos(right - phi)],
             [wall - m_left, friction * np.cos(across) - np.sin(across), 0.]],
            GRAVITY * np.array([0., -m, -friction * (wall - m_left)]))[0]

    def least(angles, a):
        m_left, m, w, fall = parts(*angles)
        return (m * w**2 - m_left) * a**2 / 2. - m * GRAVITY * fall * a

    best = np.radians([60., 60.])
    for _ in range(40):
        best = minimize(least, best, args=(acceleration_of(*best),), method="Nelder-Mead",
                        options={"xatol": 1e-9, "fatol": 1e-12}).x
    return np.degrees(best), acceleration_of(*best)


def way(a, t):
    """With gravity that grows linearly in RAMP."""
    after = np.maximum(t - RAMP, 0.)
    return a * (np.minimum(t, RAMP)**3 / (6. * RAMP) + after * RAMP / 2. + after**2 / 2.)


def main():
    print(f"critical friction {CRITICAL:.5f}; a = {acceleration(0.15):.4f} m/s^2 for 0.15, "
          f"theta = phi; 0.99 of the critical one: {acceleration(0.99 * CRITICAL):.4f}")
    for friction in (0.15, 0.99 * CRITICAL):
        angles, a = planes(friction)
        print(f"friction {friction:.4f}, planes at {angles.round(2)} degrees: a = {a:.4f} m/s^2, "
              f"{1e3 * way(a, 1.):.2f} mm after 1 s")
    runs = [geocone.read(folder) for folder in sys.argv[1:]]
    if not runs:
        return
    figure = Figure(figsize=(10.4, 6.), layout="constrained")
    axes = figure.subplots(2, 2)
    times = runs[0].times("points")
    for ax, t in zip(axes.flat, (times[0], times[len(times) * 4 // 7], times[-1])):
        field = runs[0].fields("points", time=t)
        x, u = field.points, field.point_data["displacement"][:, :2]
        start = x[:, :2] - u
        is_wall = field.point_data["material"].ravel() == 1
        layer = np.floor((start[:, 1] - 0.1) / 0.2).astype(int) % 2
        for part, color in ((~is_wall & (layer == 0), "#c9a35b"), (~is_wall & (layer == 1), "#8a6426"),
                            (is_wall, "0.25")):
            ax.scatter(x[part, 0], x[part, 1], c=color, s=2.2, linewidths=0.)
        ax.plot([-1.3, 0.648, 0.648, 2.], [0., 0., 0.1, 0.1], "k", linewidth=1.)
        ax.set(aspect="equal", xlim=(-1.3, 2.), ylim=(-0.05, 1.25), xlabel="x (m)", ylabel="y (m)",
               title=f"t = {t:.3g} s")
    ax = axes[1, 1]
    for run, color in zip(runs, style.COLORS):
        friction = float(run.parameters["Obstacles/base/Friction coefficient"])
        theta = float(run.parameters["Materials/sand/Dilatancy angle"])
        method = run.parameters["Discretisation/Method"]
        table = run.statistics
        t, x = table["time (s)"], -table["displacement of point 1 x (m)"]
        a = acceleration(friction, np.radians(theta))
        ax.plot(t, x, "-", color=color,
                label=f"{method}, $\\mu_b$ = {friction:g}, $\\theta$ = {theta:g}")
        ax.plot(t, way(a, t), "--", color=color)
        at = np.argmin(np.abs(t - 1.))
        print(f"{run.folder}: a of the blocks {a:.4f} m/s^2; after {t[at]:.2f} s the wall has gone "
              f"{1e3 * x[at]:.2f} mm, blocks {1e3 * way(a, t[at]):.2f} mm")
    ax.plot([], [], "k--", label="rigid blocks")
    ax.set(xlabel="t (s)", ylabel="way of the wall (m)", ylim=(0., None))
    ax.legend()
    figure.savefig(ROOT / "doc" / "cookbook" / "contact_wall_fails.png", dpi=95)


if __name__ == "__main__":
    main()
