#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""N_c = load/(c pi R^2) of a circular footing on weightless soil, by the method of
characteristics: the reference of prm/axisymmetric/circular_footing*.prm.

    python3 doc/cookbook/circular_footing_exact.py 0 20 30
    python3 doc/cookbook/circular_footing_exact.py 0 20 --rough
    python3 doc/cookbook/circular_footing_exact.py 0 --rough --growth 1

Growth is K in the cohesion c (1 + K z/R) at the depth z. Compression is positive; s is
(s_1 + s_3)/2, psi the angle of s_1 from the axis, s_theta = s_3 (Haar and von Karman),
T = c (1 + K z) cos(phi) + s sin(phi) the radius of Mohr's circle; R and c are 1. With
mu = pi/4 - phi/2, equilibrium reads (Cox, Eason and Hopkins 1961)

    cos(phi) ds +- 2 T dpsi = -2 T sin(mu) sin(psi)/r dl -+ K cos(phi) dr
    along dr = sin(psi +- mu) dl, dz = cos(psi +- mu) dl.

Lines of the upper sign start at the free surface and cross the fan at the edge of the
footing. Below a smooth footing they end where psi = 0. Under a rough one a rigid cone
moves with it (Eason and Shield 1960): they end on a line of the lower sign, from the edge
to the axis, and the opening of the fan is such that psi = 0 where it meets the axis. No
fan opens by more than what makes the base a characteristic; if that is not enough, the
outer lines end on the base, where the shear has reached the strength, and the cone begins
further in. With twice the lines the error falls to about a quarter."""

import argparse
from math import ceil, cos, exp, pi, sin, tan


class Soil:
    """The equations; a point is [r, z, s, psi]."""

    def __init__(self, phi, growth):
        self.phi, self.growth = phi, growth
        self.mu = pi / 4. - phi / 2.
        self.full = pi / 4. + phi / 2.  # -psi at a base with all of its shear
        self.passive = cos(phi) / (1. - sin(phi))

    def radius(self, point):
        return (1. + self.growth * point[1]) * cos(self.phi) + point[2] * sin(self.phi)

    def along(self, sign, a, b):
        """dr/dl, dz/dl, and k and f of ds + k dpsi = f dl, halfway from a to b."""
        r, _, _, psi = point = middle(a, b)
        turn, radius = sin(psi + sign * self.mu), self.radius(point) / cos(self.phi)
        force = -2. * radius * sin(self.mu) * sin(psi) / r - sign * self.growth * turn
        return turn, cos(psi + sign * self.mu), sign * 2. * radius, force

    def meet(self, a, b):
        """Where the upper line from a meets the lower one from b."""
        point = middle(a, b)
        for _ in range(50):
            a_r, a_z, a_k, a_f = self.along(1., a, point)
            b_r, b_z, b_k, b_f = self.along(-1., b, point)
            r, z, det = b[0] - a[0], b[1] - a[1], a_z * b_r - a_r * b_z
            of_a, of_b = (z * b_r - r * b_z) / det, (z * a_r - r * a_z) / det
            known = a[2] + a_k * a[3] + a_f * of_a
            psi = (known - b[2] - b_k * b[3] - b_f * of_b) / (a_k - b_k)
            new = [a[0] + of_a * a_r, a[1] + of_a * a_z, known - a_k * psi, psi]
            if max(abs(x - y) for x, y in zip(new, point)) < 1e-13:
                break
            point = new
        return new

    def at_base(self, a, psi):
        """Where the upper line from a meets the base, at this psi."""
        point = [a[0] - a[1] / 2., 0., a[2], psi]
        for _ in range(50):
            a_r, a_z, k, f = self.along(1., a, point)
            length = -a[1] / a_z
            new = [a[0] + length * a_r, 0., a[2] + k * (a[3] - psi) + f * length, psi]
            if max(abs(x - y) for x, y in zip(new, point)) < 1e-13:
                break
            point = new
        return new

    def fan(self, opening, lines):
        """The states at the edge, over an opening of psi."""
        points = []
        for i in range(lines + 1):
            turn = opening * i / lines
            s = (self.passive + 2. * turn if self.phi == 0. else
                 (self.passive + 1. / tan(self.phi)) * exp(2. * tan(self.phi) * turn)
                 - 1. / tan(self.phi))
            points.append([1., 0., s, pi / 2. - turn])
        return points

    def line(self, start, before):
        """The upper line from the surface at this radius, beside the one before it."""
        points = [[start, 0., self.passive, pi / 2.]]
        for other in before:
            points.append(self.meet(points[-1], other))
        return points

    def load(self, points):
        """Over pi, of the soil on a surface of revolution from the edge inwards."""
        def part(point, r, z):
            radius = self.radius(point)
            return point[0] * ((point[2] + radius * cos(2. * point[3])) * r
                               - radius * sin(2. * point[3]) * z)

        total = 0.
        for a, b in zip(points, points[1:]):
            r, z = a[0] - b[0], a[1] - b[1]
            total += (part(a, r, z) + 4. * part(middle(a, b), r, z) + part(b, r, z)) / 3.
        return total


def middle(a, b):
    return [(x + y) / 2. for x, y in zip(a, b)]


def smooth(soil, lines):
    before = soil.fan(pi / 2., lines)
    start, base = 1., [before[-1]]
    while True:
        start += 0.6 * exp(2. * soil.phi) / lines
        before = soil.line(start, before)
        end = soil.at_base(before[-1], 0.)
        if not 0. < end[0] < base[-1][0]:
            break
        before.append(end)
        base.append(end)
    a, b = base[-2:]
    part = b[0] / (b[0] - a[0])
    return soil.load(base + [[0., 0., b[2] + part * (a[2] - b[2]), 0.]])


class Rough:
    """So many lines across the fan, of which some end on the base and others on the cone.

    'angle' is that of the fan beyond psi = 0; what is more than 'full' is the distance,
    on the surface, of the last line that ends on the base."""

    def __init__(self, soil, lines):
        self.soil, self.lines = soil, lines
        self.step = 0.6 * exp(2. * soil.phi) / lines
        self.bracket()

    def ends(self, angle, step, on_base, on_cone):
        """The ends of the lines, one by one."""
        soil = self.soil
        before = soil.fan(pi / 2. + min(angle, soil.full), self.lines)
        yield before[-1]
        start = 1.
        for i in range(on_base + on_cone):
            start += step if i >= on_base else (angle - soil.full) / on_base
            before = soil.line(start, before)
            if i < on_base:
                before.append(soil.at_base(before[-1], -soil.full))
            yield before[-1]

    def bracket(self):
        """By bisection: psi reaches 0 before the axis if the fan opens by too little; if it
        opens by too much the lines come to the axis, or back to the base, before."""
        low, high = 0., 4.
        for _ in range(14):
            angle = (low + high) / 2.
            on_base = ceil(max(angle - self.soil.full, 0.) / self.step)
            ends, too_much = [], True
            for end in self.ends(angle, self.step, on_base, 20 * self.lines):
                if ends and (not 0. < end[0] < ends[-1][0] or end[3] < ends[-1][3]):
                    break
                if end[3] > 0.:
                    too_much = False
                    break
                ends.append(end)
            low, high = (low, angle) if too_much else (angle, high)
        self.angle, self.on_base = angle, on_base
        self.on_cone = max(len(ends) - 1 - on_base, 1)
        if self.on_base + self.on_cone < 5:
            raise ArithmeticError('too few lines')

    def refine(self):
        self.lines, self.step = 2 * self.lines, self.step / 2.
        self.on_base, self.on_cone = 2 * self.on_base, 2 * self.on_cone
        for _ in range(100):  # not beyond the axis
            r, psi = self.last(self.angle, self.step)
            if r > 0. and -self.soil.full < psi < 0.:
                break
            self.step *= 0.98

    def last(self, angle, step):
        *_, end = self.ends(angle, step, self.on_base, self.on_cone)
        return end[0], end[3]

    def solve(self):
        """Newton's method for the angle and the step: r = psi = 0 at the end of the last
        line. It returns the load."""
        small = 1e-7
        for _ in range(30):
            r, psi = self.last(self.angle, self.step)
            error = max(abs(r), abs(psi))
            if error < 1e-7:
                break
            r_a, psi_a = self.last(self.angle + small, self.step)
            r_s, psi_s = self.last(self.angle, self.step * (1. + small))
            det = (r_a - r) * (psi_s - psi) - (r_s - r) * (psi_a - psi)
            angle = (psi * (r_s - r) - r * (psi_s - psi)) / det * small
            step = (r * (psi_a - psi) - psi * (r_a - r)) / det * small * self.step
            part = 1.
            while part > 1e-3 and not max(
                    map(abs, self.last(self.angle + part * angle,
                                       self.step + part * step))) < error:
                part /= 2.
            self.angle, self.step = self.angle + part * angle, self.step + part * step
        else:
            raise ArithmeticError('the cone does not close on the axis')
        return self.soil.load(list(self.ends(self.angle, self.step, self.on_base,
                                             self.on_cone)))


def rough(soil):
    """With some 16 lines, and twice as many: one of these numbers succeeds."""
    for lines in 8, 10, 12, 9, 11:
        try:
            scene, loads = Rough(soil, lines), []
            for refinements in range(3):
                if refinements > 0:
                    scene.refine()
                loads.append(scene.solve())
            return loads[1:]
        except ArithmeticError:
            pass
    raise SystemExit('no cone is found: try a little more or less growth')


def main():
    parser = argparse.ArgumentParser(description='N_c of a circular footing')
    parser.add_argument('degrees', type=float, nargs='+', help='angles of friction')
    parser.add_argument('--rough', action='store_true')
    parser.add_argument('--growth', type=float, default=0., help='of the cohesion: K')
    given = parser.parse_args()
    for degrees in given.degrees:
        soil = Soil(degrees * pi / 180., given.growth)
        if given.rough:
            coarse, fine = rough(soil)
        else:
            coarse, fine = smooth(soil, 15), smooth(soil, 30)
        print(f'phi = {degrees:g}: N_c = {fine:.3f}, '
              f'extrapolated {fine + (fine - coarse) / 3.:.3f}', flush=True)


if __name__ == '__main__':
    main()
