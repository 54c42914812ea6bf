#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/images/acoustic_tensor.png: det A(m) of a step of Mohr-Coulomb soil on the
cone by the direction of the normal m, with and without memory of friction, from the
tangent of the return map (doc/theory/laws.md and friction_memory.md). All directions are
scanned, nothing is taken from the formulas there."""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

PHI, NU = 25., 0.3
G = 1.
K = 2. * G / (1. - 2. * NU)  # 2 (lambda + G)


def determinants(theta, part, angles):
    """det A(m)/(K G) for part = lambda = tau/(h + tau); angles of m from the largest
    compression, in radians. Before much plastic flow: |s_t|/T = 1."""
    a, b = np.sin(np.radians([PHI, theta]))
    aperture = a - part * (a - b)
    two_g, h = 2. * G, 2. * G + aperture * b * K
    # In axes (n, t1, t2), t1 along the deviator: s_1 (compression) - s_2.
    tangent = np.array([[K - aperture * b * K**2 / h, -two_g * b * K / h, 0.],
                        [-two_g * aperture * K / h, two_g - two_g**2 / h, 0.],
                        [0., 0., two_g]])
    # Mandel components xx, yy, xy sqrt2 from n = -(1, 1, 0)/sqrt2, t1 = (1, -1, 0)/sqrt2;
    # x is the axis of the largest compression, where s_t1 < 0.
    turn = np.array([[-1., 1., 0.], [-1., -1., 0.], [0., 0., np.sqrt(2.)]]) / np.sqrt(2.)
    stiffness = turn @ tangent @ turn.T
    result = []
    for angle in angles:
        m = np.cos(angle), np.sin(angle)
        strain = np.array([[m[0], 0.], [0., m[1]], [m[1] / np.sqrt(2.), m[0] / np.sqrt(2.)]])
        result.append(np.linalg.det(strain.T @ stiffness @ strain) / (K * G))
    return np.array(result)


def main():
    angles = np.radians(np.linspace(40., 70., 601))
    figure = Figure(figsize=(7., 4.2))
    axes = figure.subplots()
    for color, theta in zip(style.COLORS, (PHI, PHI / 2., 0.)):
        for part, line in ((0., "-"), (2. / 3., "--"), (0.9, ":")):
            values = determinants(theta, part, angles)
            name = {0.: "exact", 2. / 3.: "h = τ/2", 0.9: "h = τ/9"}[part]
            if theta == PHI and part > 0.:
                continue  # nothing to remember
            axes.plot(np.degrees(angles), values, line, color=color,
                      label=f"θ = {theta:g}°, {name}")
            least = values.argmin()
            mu = np.sin(np.radians(PHI)) - np.sin(np.radians(theta))
            print(f"theta = {theta:g}, lambda = {part:.3f}: least det/(KG) = "
                  f"{values[least]:.5f} at {np.degrees(angles[least]):.1f} degrees; "
                  f"-((1 - lambda) mu)^2/8 = {-((1 - part) * mu)**2 / 8:.5f}")
    axes.axhline(0., color="black", linewidth=0.8)
    axes.set(xlabel="angle of m to the largest compression (degrees)",
             ylabel="det A(m) / (K G)", ylim=(-0.03, 0.03), xlim=(40., 70.),
             title=f"Loss of ellipticity where p < 0; φ = {PHI:g}°, ν = {NU:g}".replace(
                 "p < 0", "det A < 0"))
    axes.legend(**style.BESIDE)
    figure.savefig(pathlib.Path(__file__).with_suffix(".png"))


if __name__ == "__main__":
    main()
