#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""N_c of a smooth circular footing on weightless soil by the method of characteristics:
the reference of prm/axisymmetric/circular_footing_friction.prm.

    python3 doc/cookbook/circular_footing_exact.py 0 20 30

Compression is positive; s = (s_1 + s_3)/2, R = c cos(phi) + s sin(phi), psi the angle of
s_1 from the axis, s_theta = s_3 (Haar and von Karman), R and c are 1. Equilibrium has the
characteristics dr/dz = tan(psi -+ eps), eps = pi/4 - phi/2 (Cox, Eason and Hopkins 1961).
Lines of the second family start at the free surface, cross the fan at the edge of the
footing and end below it, the last one on the axis. With twice the lines the error
falls to a quarter."""

import sys
from math import cos, exp, hypot, pi, sin, tan

import numpy as np


def relation(point, sign, phi):
    """The direction of a characteristic, and k and f of k . d(s, psi) = f dl along it."""
    r, _, s, psi = point
    sine, radius = sin(phi), cos(phi) + s * sin(phi)
    c, q = cos(2. * psi), sin(2. * psi)
    by_r = np.array([[1. - sine * c, 2. * radius * q], [sine * q, 2. * radius * c]])
    by_z = np.array([[sine * q, 2. * radius * c], [1. + sine * c, -2. * radius * q]])
    force = np.array([-radius * (1. - c) / r, -radius * q / r]) if r > 1e-9 else np.zeros(2)
    angle = psi + sign * (pi / 4. - phi / 2.)
    rows = (by_r * cos(angle) - by_z * sin(angle)).T
    row = rows[np.argmax(np.abs(rows).sum(axis=1))]
    left = np.array([row[1], -row[0]])
    return angle, left @ by_r * sin(angle) + left @ by_z * cos(angle), left @ force


def next_point(a, b, phi):
    """Where the second family's line from a meets the first one's from b; without b, the
    smooth base, z = psi = 0."""
    point = np.array(a if b is None else (np.array(a) + np.array(b)) / 2.)
    for _ in range(30):
        angle, k, f = relation((np.array(a) + point) / 2., 1., phi)
        if b is None:
            r = a[0] - a[1] * tan(angle)
            length = hypot(r - a[0], a[1])
            if sin(angle) * (r - a[0]) - cos(angle) * a[1] < 0.:
                length = -length
            new = np.array([r, 0., a[2] + (f * length + k[1] * a[3]) / k[0], 0.])
        else:
            other, k_b, f_b = relation((np.array(b) + point) / 2., -1., phi)
            lengths = np.linalg.solve([[sin(angle), -sin(other)], [cos(angle), -cos(other)]],
                                      [b[0] - a[0], b[1] - a[1]])
            state = np.linalg.solve([k, k_b], [f * lengths[0] + k @ a[2:],
                                               f_b * lengths[1] + k_b @ b[2:]])
            new = np.array([a[0] + lengths[0] * sin(angle),
                            a[1] + lengths[0] * cos(angle), *state])
        if np.abs(new - point).max() < 1e-13:
            break
        point = new
    return new


def bearing_capacity(phi, lines):
    """N_c by a fan of so many lines."""
    sine = sin(phi)
    passive = cos(phi) / (1. - sine)
    turns = np.linspace(0., pi / 2., lines + 1)
    means = (passive + 2. * turns if phi == 0. else
             (passive + 1. / tan(phi)) * np.exp(2. * tan(phi) * turns) - 1. / tan(phi))
    before = [np.array([1., 0., s, pi / 2. - turn]) for s, turn in zip(means, turns)]
    base = [(1., means[-1])]
    start, step = 1., 0.6 * exp(2. * phi) / lines
    while True:
        start += step
        line = [np.array([start, 0., passive, pi / 2.])]
        for other in before:
            line.append(next_point(line[-1], other, phi))
        end = next_point(line[-1], None, phi)
        if not 0. < end[0] < base[-1][0]:
            break
        line.append(end)
        base.append((end[0], end[2]))
        before = line
    r, s = np.array(base[::-1]).T
    pressure = s + cos(phi) + s * sine
    centre = pressure[0] - r[0] * (pressure[1] - pressure[0]) / (r[1] - r[0])
    r, pressure = np.insert(r, 0, 0.), np.insert(pressure, 0, centre)
    a, b, x, y = r[:-1], r[1:], pressure[:-1], pressure[1:]
    return np.sum((b - a) * (2. * (a * x + b * y) + a * y + b * x) / 3.)


for degrees in map(float, sys.argv[1:]):
    coarse, fine = (bearing_capacity(degrees * pi / 180., n) for n in (15, 30))
    print(f"phi = {degrees:g}: N_c = {fine:.3f}, extrapolated {fine + (fine - coarse) / 3.:.3f}")
