#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/consolidation.png of runs of terzaghi, mandel, strip and cryer of
prm/consolidation, in this order, with the exact solutions, and prints the errors:

    consolidation.py TERZAGHI MANDEL STRIP CRYER

Exact are the series of Terzaghi, of Cheng and Detournay (Mandel's problem) and of Cryer, all
with compressible water. Under the strip each term of a Fourier series in x is an ordinary
differential equation in y of the Laplace transform in time; Talbot's rule inverts it. The
pressure of a run is that of the integration point next to the observed one, which matters
under the strip, where the exact one is taken there, too."""

import pathlib
import sys

import numpy as np
from scipy.optimize import brentq

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

Q = 1e4  # the load of all (Pa)


class Clay:
    """Constants of the material: K, G, M = K + 4 G/3, storage S = n/K_w and c_v."""

    def __init__(self, parameters):
        E, nu, fluid, permeability = (
            float(parameters["Materials/clay/" + name]) for name in (
                "Young modulus", "Poisson ratio", "Pore fluid bulk modulus", "Permeability"))
        self.K, self.G, self.S = E / (3. - 6. * nu), E / (2. + 2. * nu), 1. / fluid
        self.M = self.K + 4. / 3. * self.G
        weight = float(parameters["Water/Unit weight"])
        self.c = permeability / weight / (1. / self.M + self.S)


def terzaghi(clay, t, y=0., H=1., load=Q):
    """Pressure at the height y, settlement."""
    a = (2. * np.arange(2000) + 1.) * np.pi / 2.
    decay = np.exp(-a**2 * clay.c * t / H**2)
    p = load / (1. + clay.M * clay.S)
    mean = p * np.sum(2. / a**2 * decay)
    return p * np.sum(2. / a * np.sin(a * (1. - y / H)) * decay), (load - mean) / clay.M * H


def mandel(clay, t, a=1., n=200):
    """Pressure in the middle between the plates."""
    undrained = clay.K + 1. / clay.S
    nu, nu_u = ((3. * K - 2. * clay.G) / (6. * K + 2. * clay.G) for K in (clay.K, undrained))
    r = (1. - nu) / (nu_u - nu)
    x = np.array([brentq(lambda x: np.sin(x) - r * x * np.cos(x),
                         max(i * np.pi, 1e-6), (i + 0.5) * np.pi) for i in range(n)])
    terms = np.sin(x) * (1. - np.cos(x)) / (x - np.sin(x) * np.cos(x))
    skempton = 1. / (1. + clay.K * clay.S)
    return (2. / 3. * Q * skempton * (1. + nu_u)
            * np.sum(terms * np.exp(-x**2 * clay.c * t / a**2)))


def cryer(clay, t, a=1., n=200):
    """Pressure in the middle of the sphere."""
    eta = clay.M / (2. * clay.G) * (1. + clay.K * clay.S)
    x = np.array([brentq(lambda x: (1. - eta * x**2 / 2.) * np.sin(x) - x * np.cos(x),
                         max((i - 0.5) * np.pi, 2.), (i + 0.5) * np.pi) for i in range(1, n)])
    terms = eta * (np.sin(x) - x) / ((eta - 1.) * np.sin(x) + eta * x * np.cos(x) / 2.)
    return Q / (1. + clay.K * clay.S) * np.sum(terms * np.exp(-x**2 * clay.c * t / a**2))


def strip_transform(clay, s, x, y, a, W, H, n=400):
    """Laplace transforms of pressure and u_y of the cosines of a strip |x| < a."""
    G, M, S, diffusivity = clay.G, clay.M, clay.S, clay.c

    # Of each cosine three solutions are even in y: p diffuses; p is harmonic and the
    # volumetric strain -S p; p = 0 and the displacement is the gradient of a harmonic.
    k = np.arange(1, n + 1) * np.pi / W
    load = 2. * Q / (k * W) * np.sin(k * a) / s
    m, b = np.sqrt(k**2 + s / diffusivity), (1. + (M - G) * S) / (2. * G)

    def solutions(y):
        """Factors at the height y: of p, u_y, the shear strain, the total stress yy."""
        C, D = (np.exp(m * (y - H)) + sign * np.exp(-m * (y + H)) for sign in (1., -1.))
        c, d = (np.exp(k * (y - H)) + sign * np.exp(-k * (y + H)) for sign in (1., -1.))
        f = diffusivity / (s * M)
        lame = M - 2. * G
        return np.array([
            (C, f * m * D, -2. * k * f * m * D, 2. * G * f * m**2 * C + lame * C / M - C),
            (c, b * y * c, -(S + 2. * b) * d - 2. * b * k * y * c,
             2. * G * b * (c + y * k * d) - lame * S * c - c),
            (0. * c, k * d, -2. * k**2 * d, 2. * G * k**2 * c)])

    top = solutions(H)
    matrix = top[:, [0, 2, 3]].transpose(2, 1, 0)
    scale = np.abs(matrix).max(axis=1, keepdims=True)
    right = np.stack([0. * load, 0. * load, -load], axis=1)[:, :, None]
    parts = (np.linalg.solve(matrix / scale, right)[:, :, 0] / scale[:, 0]).T
    return np.sum(parts[:, None] * solutions(y)[:, :2] * np.cos(k * x), axis=(0, 2))


def strip(clay, t, x=0., y=3., a=1., W=8., H=4., nodes=24):
    """Pressure at x, y, settlement of the middle."""
    angle = np.arange(1, nodes) * np.pi / nodes
    r = 0.4 * nodes / t
    cot = 1. / np.tan(angle)
    s = np.append(r + 0.j, r * angle * (cot + 1.j))
    weight = np.append(0.5, 1. + 1.j * (angle + (angle * cot - 1.) * cot))
    weight = r / nodes * weight * np.exp(s * t)
    p, u_y = (sum(w * strip_transform(clay, z, *place, a, W, H)[i]
                  for z, w in zip(s, weight)).real
              for i, place in enumerate(((x, y), (0., H))))
    mean = terzaghi(clay, t, y, H, Q * a / W)
    return p + mean[0], mean[1] - u_y


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    figure = Figure(figsize=(10.4, 7.2), layout="constrained")
    for axes, exact, title, folder in zip(
            figure.subplots(2, 2).flat, (terzaghi, mandel, strip, cryer),
            ("Terzaghi: the base of a layer", "Mandel: the middle between plates",
             "strip load: 1 m below it", "Cryer: the middle of a sphere"),
            sys.argv[1:]):
        run = geocone.read(folder)
        clay, table = Clay(run.parameters), run.statistics
        t, p = table["time (s)"], table["excess pore pressure of point 1 (Pa)"]
        place = ()
        if exact is strip:
            points = run.fields("points").points[:, :2]
            place = points[np.argmin(np.hypot(points[:, 0], points[:, 1] - 3.))]
        fine = np.geomspace(t[0], t[-1], 120)
        curve = [np.atleast_1d(exact(clay, time, *place))[0] for time in fine]
        axes.semilogx(fine, np.array(curve) / 1e3, "k--", label="exact")
        shown = np.unique(np.searchsorted(t, np.geomspace(t[0], t[-1], 40)))
        axes.plot(t[shown], p[shown] / 1e3, "o", color=style.BLUE, markersize=4,
                  label="computed")
        axes.set(title=title, xlabel="t (s)", ylabel="excess pore pressure (kPa)",
                 ylim=(0., None))
        axes.legend()
        at_end = np.atleast_1d(exact(clay, t[-1], *place))
        print(f"{exact.__name__}: greatest pressure {max(p):.1f} Pa, exact {max(curve):.1f} Pa, "
              f"after {t[-1]:.1f} s {p[-1]:.1f} Pa, exact {at_end[0]:.1f} Pa")
        if len(at_end) > 1:
            print(f"  settlement {-1e3 * table['displacement of point 2 y (m)'][-1]:.4f} mm, "
                  f"exact {1e3 * at_end[1]:.4f} mm")
    figure.savefig(ROOT / "doc" / "cookbook" / "consolidation.png", dpi=95)


if __name__ == "__main__":
    main()
