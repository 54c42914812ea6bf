#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the meshes of two bodies, in the plane and in space, whose cells do not fit
where they touch, beside itself:

    python3 meshes/two_bodies.py
"""
import itertools
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
# Numbers of the physical curves and surfaces by their names.
PLANE_SIDES = {'ground': 11, 'left': 12, 'top': 13, 'right': 14}
SOLID_SIDES = {'ground': 11, 'left': 12, 'back': 13, 'top': 14}
BODIES = {'lower': 1, 'upper': 2}
# Curves on the sides of the grids of both bodies.
LOWER_SIDES = {'bottom': 11, 'left': 12, 'right': 14}
UPPER_SIDES = {'top': 13, 'left': 12, 'right': 14}


def write_msh(name, groups, nodes, elements):
    """Writes physical groups (dimension, number, name), places, and elements (type and
    number of the group, nodes from 1) in gmsh's format 2.2."""
    with open(os.path.join(HERE, name), 'w', encoding='ascii') as out:
        out.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n'
                  f'{len(groups)}\n')
        for dimension, number, group in groups:
            out.write(f'{dimension} {number} "{group}"\n')
        out.write(f'$EndPhysicalNames\n$Nodes\n{len(nodes)}\n')
        for i, x in enumerate(nodes):
            out.write(f'{i + 1} {" ".join(f"{c:.10g}" for c in x)}\n')
        out.write(f'$EndNodes\n$Elements\n{len(elements)}\n')
        for i, (kind, group, of_element) in enumerate(elements):
            out.write(f'{i + 1} {kind} 2 {group} {group} '
                      f'{" ".join(map(str, of_element))}\n')
        out.write('$EndElements\n')


def groups_of(dimension, sides, bodies):
    """Physical groups of sides and of bodies of a dimension."""
    return ([(dimension - 1, number, name) for name, number in sides.items()] +
            [(dimension, number, name) for name, number in bodies.items()])


class PlaneMesh:
    """Grids of quadrilaterals, each with nodes of its own."""

    def __init__(self):
        self.nodes, self.elements = [], []

    def add(self, xs, ys, place, surface, sides):
        """Adds a grid. place(x, y): where a node is; sides: physical curve by side."""
        first, nx, ny = len(self.nodes) + 1, len(xs) - 1, len(ys) - 1
        self.nodes += [place(x, y) for y in ys for x in xs]

        def n(i, j):
            return first + i + (nx + 1) * j

        for j in range(ny):
            for i in range(nx):
                self.elements.append((3, surface, [n(i, j), n(i + 1, j),
                                                   n(i + 1, j + 1), n(i, j + 1)]))
        edges = {'bottom': [(n(i, 0), n(i + 1, 0)) for i in range(nx)],
                 'top': [(n(i + 1, ny), n(i, ny)) for i in range(nx)],
                 'left': [(n(0, j + 1), n(0, j)) for j in range(ny)],
                 'right': [(n(nx, j), n(nx, j + 1)) for j in range(ny)]}
        for side, curve in sides.items():
            self.elements += [(1, curve, list(edge)) for edge in edges[side]]

    def merge(self):
        """Makes nodes at one place one."""
        number, kept = {}, []
        for x, y in self.nodes:
            key = (round(x, 9), round(y, 9))
            if key not in number:
                number[key] = len(kept) + 1
                kept.append((x, y))
        new = [number[(round(x, 9), round(y, 9))] for x, y in self.nodes]
        self.elements = [(kind, group, [new[v - 1] for v in nodes])
                         for kind, group, nodes in self.elements]
        self.nodes = kept

    def write(self, name, groups):
        write_msh(name, groups, [(x, y, 0.) for x, y in self.nodes], self.elements)


class SolidMesh:
    """Grids of hexahedra, each with nodes of its own, or of these cut into six
    tetrahedra."""

    def __init__(self, tetrahedra):
        self.tetrahedra, self.nodes, self.elements = tetrahedra, [], []

    def add(self, lines, skew, volume, sides):
        """Adds a grid of these lines along x, y and z. skew: part of a cell by which
        inner nodes are moved; sides: physical surface by side, as (axis, at the end)."""
        first = len(self.nodes) + 1
        counts = [len(of_axis) for of_axis in lines]

        def number(i, j, k):
            return first + i + counts[0] * (j + counts[1] * k)

        for k, j, i in itertools.product(*(range(n) for n in reversed(counts))):
            x = [lines[axis][at] for axis, at in enumerate((i, j, k))]
            height = (x[1] - lines[1][0]) / (lines[1][-1] - lines[1][0]) - 0.5
            for axis, at in ((0, i), (2, k)):
                if 0 < at < counts[axis] - 1:
                    x[axis] += skew * height * (lines[axis][1] - lines[axis][0])
            self.nodes.append(x)
        for k, j, i in itertools.product(*(range(n - 1) for n in reversed(counts))):
            def corner(a, b, c, i=i, j=j, k=k):
                return number(i + a, j + b, k + c)

            if not self.tetrahedra:
                self.elements.append((5, volume, [
                    corner(*at) for at in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                                           (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))]))
                continue
            # Along the six ways from corner to corner.
            for order in itertools.permutations(range(3)):
                at, way = [0, 0, 0], [corner(0, 0, 0)]
                for axis in order:
                    at[axis] = 1
                    way.append(corner(*at))
                if order not in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
                    way[1], way[2] = way[2], way[1]
                self.elements.append((4, volume, way))
        for (axis, at_end), surface in sides.items():
            a, b = (axis + 1) % 3, (axis + 2) % 3
            for p, q in itertools.product(range(counts[a] - 1), range(counts[b] - 1)):
                def on_side(u, v, p=p, q=q, axis=axis, a=a, b=b, at_end=at_end):
                    place = [0, 0, 0]
                    place[axis] = counts[axis] - 1 if at_end else 0
                    place[a], place[b] = p + u, q + v
                    return number(*place)

                around = [on_side(*at) for at in ((0, 0), (1, 0), (1, 1), (0, 1))]
                if self.tetrahedra:
                    self.elements += [(2, surface, [around[0], around[1], around[2]]),
                                      (2, surface, [around[0], around[2], around[3]])]
                else:
                    self.elements.append((3, surface, around))

    def write(self, name):
        write_msh(name, groups_of(3, SOLID_SIDES, BODIES), self.nodes, self.elements)


def even(a, b, n):
    return [a + (b - a) * i / n for i in range(n + 1)]


def growing(first, end, factor):
    """Lines from 0 to end, as many steps by a factor as there is room for."""
    steps = [first]
    while sum(steps) < end:
        steps.append(factor * steps[-1])
    scale = end / sum(steps)
    lines = [0.]
    for step in steps:
        lines.append(lines[-1] + scale * step)
    return lines


def two_blocks():
    """Three cells on five, none of them a rectangle."""
    mesh = PlaneMesh()

    def skew(width, amount, low):
        def place(x, y):
            inside = 0. < x < 1.
            return x + (amount * width * 4. * (y - low - 0.25) if inside else 0.), y
        return place

    mesh.add(even(0., 1., 3), even(0., 0.5, 2), skew(1 / 3, 0.2, 0.), 1,
             LOWER_SIDES)
    mesh.add(even(0., 1., 5), even(0.5, 1., 2), skew(1 / 5, -0.15, 0.5), 2,
             UPPER_SIDES)
    mesh.write('two_blocks.msh', groups_of(2, PLANE_SIDES, BODIES))


def hertz_bodies():
    """Half of a flat body and of one whose lower side is a circle of 10 m."""
    radius, size = 10., 16.
    mesh = PlaneMesh()
    fine = even(0., 0.15, 15)
    lower = fine + [0.15 + x for x in growing(0.012, size - 0.15, 1.5)[1:]]
    mesh.add(lower, [-y for y in reversed(growing(0.01, size, 1.4))],
             lambda x, y: (x, y), 1, LOWER_SIDES)
    fine = even(0., 0.155, 17)
    upper = fine + [0.155 + x for x in growing(0.011, size - 0.155, 1.5)[1:]]

    def above_circle(x, y):
        # Beyond 4 m the tangent goes on.
        arc = min(x, 4.)
        height = radius - (radius**2 - arc**2)**0.5
        height += (x - arc) * arc / (radius**2 - arc**2)**0.5
        return x, y + height * (1. - y / size)

    mesh.add(upper, growing(0.01, size, 1.4), above_circle, 2,
             UPPER_SIDES)
    mesh.write('hertz_bodies.msh', groups_of(2, PLANE_SIDES, BODIES))


def discs():
    """Two discs of 0.1 m, 2 mm apart: a square of cells in a ring, one of them turned
    and with other cells."""
    mesh = PlaneMesh()
    for surface, (x0, n, turn) in enumerate(((-0.101, 10, 0.), (0.101, 8, 0.3)), 1):
        inner, outer = 0.05, 0.1

        def placed(x, y, x0=x0, turn=turn):
            return (x0 + x * math.cos(turn) - y * math.sin(turn),
                    x * math.sin(turn) + y * math.cos(turn))

        def in_square(u, v):
            # Its sides are bent outwards.
            bend = 0.15 * inner
            return (inner * u + bend * u * (1. - v * v),
                    inner * v + bend * v * (1. - u * u))

        mesh.add(even(-1., 1., n), even(-1., 1., n),
                 lambda u, v: placed(*in_square(u, v)), surface, {})
        for quarter in range(4):
            side = quarter * math.pi / 2.

            def in_ring(s, u, side=side):
                angle = side + math.pi / 4. * u
                a = in_square(1., u)
                a = (a[0] * math.cos(side) - a[1] * math.sin(side),
                     a[0] * math.sin(side) + a[1] * math.cos(side))
                b = (outer * math.cos(angle), outer * math.sin(angle))
                return placed(*((1. - s) * p + s * q for p, q in zip(a, b)))

            mesh.add(even(0., 1., n // 2), even(-1., 1., n), in_ring, surface, {})
    mesh.merge()
    mesh.write('discs.msh', groups_of(2, {}, {'left': 1, 'right': 2}))


def two_cuboids(tetrahedra):
    """A cube of 1 m in two halves, 2 x 2 cells on 3 x 3 where they touch."""
    mesh = SolidMesh(tetrahedra)
    mesh.add([even(0., 1., 2), even(0., 0.5, 1), even(0., 1., 2)], 0.2, 1,
             {(1, False): SOLID_SIDES['ground'], (0, False): SOLID_SIDES['left'],
              (2, False): SOLID_SIDES['back']})
    mesh.add([even(0., 1., 3), even(0.5, 1., 1), even(0., 1., 3)], -0.2, 2,
             {(1, True): SOLID_SIDES['top'], (0, False): SOLID_SIDES['left'],
              (2, False): SOLID_SIDES['back']})
    mesh.write('two_cuboids_tetrahedra.msh' if tetrahedra else 'two_cuboids.msh')


if __name__ == '__main__':
    two_blocks()
    hertz_bodies()
    discs()
    two_cuboids(False)
    two_cuboids(True)
