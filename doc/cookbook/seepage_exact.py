#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact free surface and exit point of prm/seepage/rectangular_dam.prm (Polubarinova-Kochina, 1962) and exact
infiltration of prm/seepage/philip.prm (Philip, 1969), with the results of both runs:

    python3 doc/cookbook/seepage_exact.py results/rectangular_dam results/philip

It prints both errors and draws seepage_profiles.png. Without folders it prints the exact values."""
import json
import math
import sys
from pathlib import Path

import numpy as np

PARAMETER, WEIGHT = np.polynomial.legendre.leggauss(600)


def complete(m1):
    """Complete elliptic integral K of the parameter 1 - m1."""
    a, b = np.ones_like(m1), np.sqrt(m1)
    for _ in range(60):
        a, b = (a + b) / 2., np.sqrt(a * b)
    return np.pi / (2. * a)


def angles(end=np.pi / 2.):
    """Sines and cosines of angles from 0 to an end, dense at 0 and pi/2, and their weights."""
    t = (PARAMETER + 1.) / 2.
    def part(s):
        return s**4 * (35. - 84. * s + 70. * s**2 - 20. * s**3)
    weight = WEIGHT / 2. * 140. * t**3 * (1. - t)**3 * end
    cosine = np.sin(part(1. - t) * end) if end == np.pi / 2. else np.cos(part(t) * end)
    return np.sin(part(t) * end), cosine, weight


def dam(length, upper, lower):
    """Parameters alpha and beta, the factor C and the height of the exit point of a rectangular dam."""
    s, c, w = angles()

    def lengths(alpha, beta):
        r = 1. - alpha - (beta - alpha) * s**2
        face = np.sum(w * complete(s**2) * s * c
                      / np.sqrt((1. - (1. - alpha) * s**2) * (1. - (1. - beta) * s**2)))
        below = math.sqrt(alpha) * np.sum(w * complete(1. - alpha * s**2) * s
                                          / np.sqrt((1. - alpha * s**2) * (beta - alpha * s**2)))
        surface = np.sum(w * complete(s**2) * s / np.sqrt((1. - alpha * s**2) * (1. - beta * s**2)))
        return np.sum(w * complete(r) / np.sqrt(r)), below, face, surface

    def residual(x):
        beta = 1. / (1. + math.exp(-x[1]))
        alpha = beta / (1. + math.exp(-x[0]))
        base, below, face, surface = lengths(alpha, beta)
        return (np.log([(below + face + surface) / base * length / upper, below / base * length / lower]),
                (alpha, beta, length / base, lower + face * length / base))

    x = np.zeros(2)
    for _ in range(200):
        value, result = residual(x)
        if np.abs(value).max() < 1e-13:
            break
        step = 1e-6 * np.eye(2)
        slope = np.array([(residual(x + e)[0] - residual(x - e)[0]) / 2e-6 for e in step]).T
        change = np.linalg.solve(slope, -value)
        x = x + change * min(1., 0.5 / np.abs(change).max())
    return result


def free_surface(length, upper, lower):
    """Points of the free surface, from the exit point on."""
    alpha, beta, factor, exit_height = dam(length, upper, lower)
    points = []
    for end in np.linspace(0., np.pi / 2., 60):
        s, c, w = angles(end)
        common = w * s / np.sqrt((1. - alpha * s**2) * (1. - beta * s**2))
        points.append((length - factor * np.sum(common * complete(c**2)),
                       exit_height + factor * np.sum(common * complete(s**2))))
    return np.array(points)


# Data of philip.prm.
K, ALPHA, CONTENT, RESIDUAL, START, HEIGHT, WIDTH, TIME = 2.778e-6, 5., 0.34, 0.06, 0.1, 2., 0.05, 10800.
DIFFUSIVITY, SPEED = K / (ALPHA * CONTENT), K / CONTENT


def saturation(depth):
    """Effective saturation at a depth of philip.prm at the end: the steady one of the rain, and the change."""
    root = 2. * math.sqrt(DIFFUSIVITY * TIME)
    change = (math.erfc((depth - SPEED * TIME) / root)
              + math.exp(SPEED * depth / DIFFUSIVITY) * math.erfc((depth + SPEED * TIME) / root)) / 2.
    return START + (1. - START) * (change + math.exp(-ALPHA * (HEIGHT - depth)))


def philip():
    """Inflow (m^3/s per m) and water in the column (m^3 per m)."""
    root = 2. * math.sqrt(DIFFUSIVITY * TIME)
    slope = (-math.exp(-(SPEED * TIME / root)**2) / math.sqrt(math.pi * DIFFUSIVITY * TIME)
             + SPEED / (2. * DIFFUSIVITY) * math.erfc(SPEED * TIME / root))
    depth = np.linspace(0., HEIGHT, 20001)
    content = RESIDUAL + CONTENT * np.array([saturation(z) for z in depth])
    return (WIDTH * (K - DIFFUSIVITY * CONTENT * (1. - START) * slope),
            WIDTH * np.sum((content[1:] + content[:-1]) / 2. * np.diff(depth)))


def draw(dam_run, philip_run):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
    from geocone.reader import Run

    model = json.loads((Path(dam_run) / "model.json").read_text())
    segments = np.array(model["free_surfaces"][-1]["segments"])
    found = segments.reshape(-1, 2)
    found = found[found[:, 0] > 16. - 1e-6, 1].max()
    exact = dam(16., 24., 4.)[3]
    print(f"exit point {found:.3f} m, exact {exact:.3f} m, {100. * (found / exact - 1.):+.2f} %")
    summary = json.loads((Path(philip_run) / "summary.json").read_text())["seepage"]
    for name, value, of_series in zip(("inflow", "stored"), (summary["inflows"]["ground"], summary["stored"]), philip()):
        print(f"{name} {value:.5g}, exact {of_series:.5g}, {100. * (value / of_series - 1.):+.2f} %")

    figure, (left, right) = plt.subplots(1, 2, figsize=(7.5, 3.8), constrained_layout=True)
    for n, line in enumerate(segments[~np.all(segments[:, :, 0] > 16. - 1e-6, axis=1)]):
        left.plot(*line.T, color="C0", lw=3, label="computed" if n == 0 else None)
    left.plot(*free_surface(16., 24., 4.).T, "k--", lw=1, label="exact (Polubarinova-Kochina)")
    left.plot(16., exact, "ko", ms=4, label=f"exit point, {exact:.3f} m")
    left.set(xlabel="x (m)", ylabel="y (m)", xlim=(0., 16.5), ylim=(0., 25.), title="Free surface of the dam")
    left.legend(frameon=False, loc="lower left")
    field = Run(philip_run).states("seepage")[-1]
    order = np.argsort(field.points[:, 1])
    theta = np.ravel(field.data["relative_permeability"])
    right.plot(theta[order], HEIGHT - field.points[order, 1], ".", color="C0", ms=3, label="computed")
    depth = np.linspace(0., HEIGHT, 200)
    right.plot([saturation(z) for z in depth], depth, "k--", lw=1, label="exact (Philip)")
    right.set(xlabel="effective saturation (-)", ylabel="depth (m)", ylim=(HEIGHT, 0.), title="Infiltration after three hours")
    right.legend(frameon=False)
    figure.savefig(Path(__file__).with_name("seepage_profiles.png"), dpi=130)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        draw(*sys.argv[1:])
    else:
        print(f"exit point of the dam: {dam(16., 24., 4.)[3]:.6f} m")
        print("philip: inflow {:.6g} m^3/s per m, stored {:.6g} m^3 per m".format(*philip()))
