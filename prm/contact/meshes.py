#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the meshes of two bodies whose cells do not fit where they touch:

    python3 prm/contact/meshes.py    # two_blocks.msh, hertz_bodies.msh, discs.msh
"""
import math
import os


def write_msh(path, groups, nodes, elements):
    """Physical groups (dimension, number, name), places, and elements (gmsh's type, number
    of the group, nodes from 1)."""
    with open(path, 'w', encoding='ascii') as out:
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


class Mesh:
    """Grids of quadrilaterals, each with nodes of its own, in gmsh's format 2.2."""

    def __init__(self):
        self.nodes, self.elements = [], []

    def add(self, xs, ys, place, surface, sides):
        """A grid. place(x, y): where a node is; sides: physical curve by side."""
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
        """Nodes at one place become one."""
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
        here = os.path.dirname(os.path.abspath(__file__))
        write_msh(os.path.join(here, name), groups,
                  [(x, y, 0.) for x, y in self.nodes], self.elements)


GROUPS = [(1, 11, 'ground'), (1, 12, 'left'), (1, 13, 'top'), (1, 14, 'right'),
          (2, 1, 'lower'), (2, 2, 'upper')]


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
    mesh = Mesh()

    def skew(width, amount, low):
        def place(x, y):
            inside = 0. < x < 1.
            return x + (amount * width * 4. * (y - low - 0.25) if inside else 0.), y
        return place

    mesh.add(even(0., 1., 3), even(0., 0.5, 2), skew(1 / 3, 0.2, 0.), 1,
             {'bottom': 11, 'left': 12, 'right': 14})
    mesh.add(even(0., 1., 5), even(0.5, 1., 2), skew(1 / 5, -0.15, 0.5), 2,
             {'top': 13, 'left': 12, 'right': 14})
    mesh.write('two_blocks.msh', GROUPS)


def hertz_bodies():
    """Half of a flat body and of one whose lower side is a circle of 10 m."""
    radius, size = 10., 16.
    mesh = Mesh()
    fine = even(0., 0.15, 15)
    lower = fine + [0.15 + x for x in growing(0.012, size - 0.15, 1.5)[1:]]
    mesh.add(lower, [-y for y in reversed(growing(0.01, size, 1.4))],
             lambda x, y: (x, y), 1, {'bottom': 11, 'left': 12, 'right': 14})
    fine = even(0., 0.155, 17)
    upper = fine + [0.155 + x for x in growing(0.011, size - 0.155, 1.5)[1:]]

    def above_circle(x, y):
        # Beyond 4 m the tangent goes on.
        arc = min(x, 4.)
        height = radius - (radius**2 - arc**2)**0.5
        height += (x - arc) * arc / (radius**2 - arc**2)**0.5
        return x, y + height * (1. - y / size)

    mesh.add(upper, growing(0.01, size, 1.4), above_circle, 2,
             {'top': 13, 'left': 12, 'right': 14})
    mesh.write('hertz_bodies.msh', GROUPS)


def discs():
    """Two discs of 0.1 m, 2 mm apart: a square of cells in a ring, one of them turned and
    with other cells."""
    mesh = Mesh()
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
    mesh.write('discs.msh', [(2, 1, 'left'), (2, 2, 'right')])


if __name__ == '__main__':
    two_blocks()
    hertz_bodies()
    discs()
