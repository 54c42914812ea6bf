#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the meshes of two bodies in space whose cells do not fit where they touch:

    python3 prm/three/meshes.py    # two_cuboids.msh, two_cuboids_tetrahedra.msh
"""
import importlib.util
import itertools
import os

HERE = os.path.dirname(os.path.abspath(__file__))
spec = importlib.util.spec_from_file_location(
    'plane', os.path.join(HERE, '..', 'contact', 'meshes.py'))
plane = importlib.util.module_from_spec(spec)
spec.loader.exec_module(plane)

SIDES = {'ground': 11, 'left': 12, 'back': 13, 'top': 14}


class Mesh:
    """Grids of hexahedra, each with nodes of its own, or of these cut into six
    tetrahedra, in gmsh's format 2.2."""

    def __init__(self, tetrahedra):
        self.tetrahedra, self.nodes, self.elements = tetrahedra, [], []

    def add(self, lines, skew, volume, sides):
        """A grid of these lines along x, y and z. skew: part of a cell by which inner
        nodes are moved; sides: physical surface by side, as (axis, at the end)."""
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
        groups = [(2, number, side) for side, number in SIDES.items()]
        groups += [(3, 1, 'lower'), (3, 2, 'upper')]
        plane.write_msh(os.path.join(HERE, name), groups, self.nodes, self.elements)


def two_cuboids(tetrahedra):
    """A cube of 1 m in two halves, 2 x 2 cells on 3 x 3 where they touch."""
    mesh = Mesh(tetrahedra)
    mesh.add([plane.even(0., 1., 2), plane.even(0., 0.5, 1), plane.even(0., 1., 2)], 0.2, 1,
             {(1, False): SIDES['ground'], (0, False): SIDES['left'],
              (2, False): SIDES['back']})
    mesh.add([plane.even(0., 1., 3), plane.even(0.5, 1., 1), plane.even(0., 1., 3)], -0.2, 2,
             {(1, True): SIDES['top'], (0, False): SIDES['left'],
              (2, False): SIDES['back']})
    mesh.write('two_cuboids_tetrahedra.msh' if tetrahedra else 'two_cuboids.msh')


if __name__ == '__main__':
    two_cuboids(False)
    two_cuboids(True)
