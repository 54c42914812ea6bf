#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Computes the reference values of studies/validation.toml that are no closed form
in geocone itself, and prints them; some ten seconds.

N_gamma. Behind the edge of a footing on soil without cohesion stress is self-similar:
the mean pressure is gamma r s(theta), and the larger principal stress is inclined to
the radius by psi(theta); theta goes from the free surface (0) to the footing (pi).
Equilibrium gives two equations for s and psi. They are singular where the radius is
a slip line, psi = -mu, mu = pi/4 - phi/2. Beside the footing, to theta = mu, is
Rankine's passive zone, psi = -theta. The solution starts at the footing (smooth:
psi = -pi/2; rough: psi = -mu, so that the footing is a slip line) with the s that
lets it end at the border of that zone. Under a rough footing the slip line through
the point of the axis where the principal stress is upright bounds a rigid wedge,
whose vertical equilibrium gives the load.

Slopes. A rigid body slides on a log spiral through the toe: the least gamma H/c is
an upper bound.

Thick cylinder. Lame and the yield condition; integration of equilibrium in the
plastic ring."""

import math
from math import cos, exp, pi, sin, sqrt, tan


def rates(state, sin_phi, mu):
    """Derivatives of theta, s, psi and of ln r on a slip line by a parameter that
    does not stop at the singularity."""
    theta, s, psi, _ = state
    c, t = cos(2. * psi), sin(2. * psi)
    radial = sin(theta) - s * (1. + sin_phi * c) - 2. * sin_phi * s * c
    hoop = cos(theta) - 3. * sin_phi * s * t
    return (-2. * sin_phi * s * (sin_phi - c),
            -2. * sin_phi * s * (radial * t - hoop * c),
            -(sin_phi * t * hoop - (1. - sin_phi * c) * radial),
            -4. * sin_phi * s * sin(psi - mu) * cos(psi + mu))


def field(s, psi, phi, step):
    """The solution from the footing on (Runge-Kutta), to where it ends."""
    sin_phi, mu = sin(phi), pi / 4. - phi / 2.
    state, path = (pi, s, psi, 0.), []
    while len(path) < 200000:
        path.append(state)
        k1 = rates(state, sin_phi, mu)
        if len(path) > 100 and max(map(abs, k1[:3])) < 1e-8:
            break
        k2 = rates([a + step / 2. * b for a, b in zip(state, k1)], sin_phi, mu)
        k3 = rates([a + step / 2. * b for a, b in zip(state, k2)], sin_phi, mu)
        k4 = rates([a + step * b for a, b in zip(state, k3)], sin_phi, mu)
        state = tuple(a + step / 6. * (b + 2. * c + 2. * d + e)
                      for a, b, c, d, e in zip(state, k1, k2, k3, k4))
        if state[1] <= 0. or state[0] < 0.:
            break
    return path


def n_gamma(phi_degrees, rough):
    """Mean pressure over gamma B/2."""
    phi = math.radians(phi_degrees)
    sin_phi, mu = sin(phi), pi / 4. - phi / 2.
    psi = -mu if rough else -pi / 2.
    low, high = 0.5, 80.
    for _ in range(36):
        s = sqrt(low * high)
        end = field(s, psi, phi, 0.002)[-1]
        if abs(end[2] + mu) < 1e-3 and end[0] > mu:
            low = s
        else:
            high = s
    if not rough:
        return s * (1. + sin_phi) / 2.
    load, last = 0., None
    for theta, p, psi, log_r in field(s, psi, phi, 0.0004):
        x, y, p = exp(log_r) * cos(theta), exp(log_r) * sin(theta), exp(log_r) * p
        angle = theta + psi
        syy, sxy = p * (1. - sin_phi * cos(2. * angle)), p * sin_phi * sin(2. * angle)
        if last is None:
            load = syy / 2.  # of the part of the footing that is a slip line
        else:
            load += (-(syy + last[2]) / 2. * (x - last[0]) +
                     (sxy + last[3]) / 2. * (y - last[1]) +
                     (y + last[1]) / 2. * (x - last[0]))  # the weight of the wedge
            if angle < pi / 2.:
                break
        last = (x, y, syy, sxy)
    return load / x**2


def spiral(theta0, theta1, beta, phi):
    """gamma H/c of a spiral from the angle theta0 (crest) to theta1 (toe)."""
    t = tan(phi)
    e = exp((theta1 - theta0) * t)
    height = sin(theta1) * e - sin(theta0)
    top = cos(theta0) - cos(theta1) * e - height * cos(beta) / sin(beta)
    work = (((3. * t * cos(theta1) + sin(theta1)) * e**3 -
             (3. * t * cos(theta0) + sin(theta0))) / (3. * (1. + 9. * t * t)) -
            top * (2. * cos(theta0) - top) * sin(theta0) / 6. -
            e / 6. * (sin(theta1 - theta0) - top * sin(theta1)) *
            (cos(theta0) - top + cos(theta1) * e))
    if height <= 0. or top <= 0. or work <= 0.:
        return math.inf
    return height * (e * e - 1.) / (2. * t * work)


def critical_height(beta_degrees, phi_degrees):
    """The least of all spirals, by a search on grids that shrink."""
    beta, phi = math.radians(beta_degrees), math.radians(phi_degrees)
    best, width = (math.inf, pi / 4., 1.7), 1.
    for _ in range(14):
        _, a, b = best
        best = min([best] + [
            (spiral(a + width * i / 20., b + width * j / 20., beta, phi),
             a + width * i / 20., b + width * j / 20.)
            for i in range(-20, 21) for j in range(-20, 21)
            if 0. < a + width * i / 20. < b + width * j / 20. < pi])
        width *= 0.4
    return best[0]


def cylinder(phi_degrees, ratio):
    """Pressure over cohesion at first yield and at collapse, b/a = ratio."""
    phi = math.radians(phi_degrees)
    n = (1. + sin(phi)) / (1. - sin(phi))
    y = 2. * cos(phi) / (1. - sin(phi))
    first = y / (1. + n * (ratio**2 + 1.) / (ratio**2 - 1.))
    if phi == 0.:
        return first, 2. * math.log(ratio)
    return first, y / (n - 1.) * (ratio**((n - 1.) / n) - 1.)


if __name__ == "__main__":
    for angle in (20, 25, 30):
        print(f"N_gamma, phi = {angle}: smooth {n_gamma(angle, False):.5f}, "
              f"rough {n_gamma(angle, True):.4f}", flush=True)
    for angle in (45, 60, 90):
        print(f"gamma H/c, beta = {angle}, phi = 25: at most "
              f"{critical_height(angle, 25):.4f}")
    for angle in (0, 10, 20, 30):
        print("p/c of the cylinder b/a = 2, phi = {}: first yield {:.6f}, collapse {:.6f}"
              .format(angle, *cylinder(angle, 2.)))
