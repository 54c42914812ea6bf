#!/usr/bin/env python3
"""ring.py FILE N [ANGLE]: writes a .msh file (format 2.2) of N x N quadrilaterals.

Without ANGLE: a quarter of a ring, radii 1 and 2, with sides bore, outside, plane_x
(on x = 0) and plane_y (on y = 0); all nodes lie on the arcs.
With ANGLE: a rectangle 2 x 1, turned by so many degrees about the origin, with sides
bottom, right, top, left; its cells are not rectangles.
"""
import math
import sys

name, n = sys.argv[1], int(sys.argv[2])
angle = math.radians(float(sys.argv[3])) if len(sys.argv) > 3 else None
nodes, cells, lines = [], [], []
for j in range(n + 1):
    for i in range(n + 1):
        s, t = i / n, j / n
        if angle is None:
            r, phi = 1 + s, t * math.pi / 2
            x, y = r * math.cos(phi), r * math.sin(phi)
            if j == n:
                x = 0.
        else:
            # A bump that leaves the sides as they are.
            bump = 0.1 * math.sin(math.pi * s) * math.sin(math.pi * t)
            u, v = 2 * s + bump, t - 0.7 * bump
            x = math.cos(angle) * u - math.sin(angle) * v
            y = math.sin(angle) * u + math.cos(angle) * v
        nodes.append((x, y))
number = lambda i, j: j * (n + 1) + i + 1
for k in range(n):
    lines += [(1, number(k, 0), number(k + 1, 0)), (2, number(n, k), number(n, k + 1)),
              (3, number(k + 1, n), number(k, n)), (4, number(0, k + 1), number(0, k))]
    for i in range(n):
        cells.append((number(i, k), number(i + 1, k), number(i + 1, k + 1),
                      number(i, k + 1)))
names = (["plane_y", "outside", "plane_x", "bore"] if angle is None else
         ["bottom", "right", "top", "left"])
with open(name, "w") as out:
    out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n")
    for i, side in enumerate(names):
        out.write(f'1 {i + 1} "{side}"\n')
    out.write('2 5 "soil"\n$EndPhysicalNames\n$Nodes\n%d\n' % len(nodes))
    for i, (x, y) in enumerate(nodes):
        out.write(f"{i + 1} {x!r} {y!r} 0\n")
    out.write("$EndNodes\n$Elements\n%d\n" % (len(lines) + len(cells)))
    for i, (side, a, b) in enumerate(lines):
        out.write(f"{i + 1} 1 2 {side} {side} {a} {b}\n")
    for i, cell in enumerate(cells):
        out.write(f"{len(lines) + i + 1} 3 2 5 5 %d %d %d %d\n" % cell)
    out.write("$EndElements\n")
