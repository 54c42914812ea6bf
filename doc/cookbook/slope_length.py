#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strict upper bounds of gamma H/c at which a slope of clay (Tresca, weight alone) of the
length L = 10 H to H fails between rough ends, on a rigid base at the level of its toe:

    slope_length.py [ANGLE]      # of the face, degrees; 60 if not given

A rigid body turns about an axis along the slope, above it. It slides on a surface of
revolution: in a section at z it is what a circle of the radius R(z) about the axis cuts off,
which goes through the toe or leaves through the face. With the angle t(R) of the arc in the
soil, the moment m(R) of the weight for gamma = 1, and e(R) = int r dA over the section, the
rates of dissipation over that of the weight are
    gamma H/c <= (2 int_0^(L/2) R^2 t sqrt(1 + R'^2) dz + 2 e(R(L/2))) / (2 int m dz).
R = const. is a cylinder with flat ends (Gens, Hutchinson and Cavounidis 1988); otherwise R at
nine places is what makes the bound least, as in Baligh and Azzouz (1975)."""

import sys

import numpy as np
from scipy.optimize import minimize

ANGLE = np.radians(float(sys.argv[1]) if len(sys.argv) > 1 else 60.)
COT = 1. / np.tan(ANGLE)


class Sections:
    """R^2 t, m and e of circles about (x, y), from one that touches the soil to that through
    the toe, which is at (0, 0); the soil is where x > 0, the crest at (COT, 1)."""

    def __init__(self, x, y, number=60):
        along = x * np.cos(ANGLE) + y * np.sin(ANGLE)
        least = y * np.cos(ANGLE) - x * np.sin(ANGLE) if along * np.sin(ANGLE) <= 1. \
            else np.hypot(x - COT, y - 1.)
        self.radii = np.linspace(least, np.hypot(x, y), number)
        self.slip, self.moment, self.end = np.zeros((3, number))
        angles = -np.pi * (np.arange(20000) + 0.5) / 20000
        parts = (np.arange(40) + 0.5) / 40
        for i, radius in enumerate(self.radii[1:], 1):
            at = x + radius * np.cos(angles), y + radius * np.sin(angles)
            inside = (at[0] > 0.) & (at[1] < np.minimum(at[0] / COT, 1.))
            self.slip[i] = radius ** 2 * np.pi * np.mean(inside)
            left = max(0., x - radius)
            width = (x + radius - left) / 500
            places = left + width * (np.arange(500) + 0.5)
            low = y - np.sqrt(np.maximum(radius ** 2 - (places - x) ** 2, 0.))
            height = np.maximum(np.minimum(places / COT, 1.) - low, 0.)
            self.moment[i] = np.sum(height * (places - x)) * width
            points = np.hypot((places - x)[:, None], low[:, None] + height[:, None] * parts - y)
            self.end[i] = np.sum(points * height[:, None]) / len(parts) * width

    def bound(self, profile, length):
        """gamma H/c for radii at equal distances from the middle to the end."""
        step = 0.5 * length / (len(profile) - 1)
        middle = 0.5 * (profile[1:] + profile[:-1])
        rise = np.diff(profile)
        slip = moment = 0.
        for place, weight in ((-0.7745966692414834, 5. / 18.), (0., 8. / 18.),
                              (0.7745966692414834, 5. / 18.)):
            radii = middle + 0.5 * place * rise
            slip += weight * step * np.sum(np.interp(radii, self.radii, self.slip)
                                           * np.sqrt(1. + (rise / step) ** 2))
            moment += weight * step * np.sum(np.interp(radii, self.radii, self.moment))
        slip += np.interp(profile[-1], self.radii, self.end)
        return slip / moment if moment > 1e-9 else 1e3


def main():
    centres = [Sections(x, y) for x in (-0.2, -0.1, -0.05, 0.)
               for y in np.arange(1.15, 1.65, 0.05)]
    print("L/H  cylinder with flat ends  body of revolution")
    for length in (1e9, 10., 6., 4., 3., 2., 1.5, 1.):
        flat = min(s.bound(np.full(9, s.radii[-1]), length) for s in centres)
        turned = flat
        for s in centres if length < 1e8 else ():
            start = s.radii[-1] - 0.5 * (s.radii[-1] - s.radii[0]) * np.linspace(0, 1, 9) ** 3
            turned = min(turned, minimize(
                lambda p: s.bound(p, length), start, method="L-BFGS-B",
                bounds=[(s.radii[0] + 1e-3, s.radii[-1])] * 9).fun)
        print(f"{length:g}  {flat:.3f}  {turned:.3f}")


if __name__ == "__main__":
    main()
