# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solves the bounds of a small body on tetrahedra by another solver (cvxopt), with problems
that are assembled here from the mesh alone.

usage: conic_bounds.py RUN-FOLDER FRICTION-ANGLE...  compares the loads of runs of
bounds_solver.prm whose names end in the angles (degrees)."""

import sys
from itertools import combinations

import numpy as np
from cvxopt import matrix, solvers

from geocone.reader import Run

COHESION = 1000.
WEIGHT = 1000.  # per volume, along -y
AGREEMENT = 1e-6
# Strain rates of upper bounds with friction keep a margin of 1e-7 of the flow rule, by which the
# bounds may be higher, but not lower.
MARGIN = 1e-5


class Mesh:
    """Tetrahedra with shared vertices, their faces, and what holds the faces: `fixed`, `plane`
    (a plane of symmetry), or nothing."""

    def __init__(self, field):
        points = np.asarray(field.points, float)
        self.vertices, number = np.unique(points, axis=0, return_inverse=True)
        self.cells = number.ravel()[field.cells]
        corners = self.vertices[self.cells]
        edges = corners[:, 1:] - corners[:, :1]
        self.volumes = np.abs(np.linalg.det(edges)) / 6.
        inverse = np.linalg.inv(edges).transpose(0, 2, 1)
        self.gradients = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)
        owners = {}
        for c, cell in enumerate(self.cells):
            for face in combinations(range(4), 3):
                owners.setdefault(tuple(sorted(cell[list(face)])), []).append(c)
        self.faces = [self.face(key, of) for key, of in owners.items()]

    def face(self, key, cells):
        """Vertices, cells, area, axes (n, t1, t2; n outward of the first cell) and support."""
        a, b, c = self.vertices[list(key)]
        normal = np.cross(b - a, c - a)
        area = np.linalg.norm(normal) / 2.
        normal /= 2. * area
        if normal @ (a - self.vertices[self.cells[cells[0]]].mean(axis=0)) < 0.:
            normal = -normal
        along = (b - a) / np.linalg.norm(b - a)
        low, high = self.vertices.min(axis=0), self.vertices.max(axis=0)
        held = None
        if len(cells) == 1:
            axis = np.argmax(np.abs(normal))
            side = "low" if abs(a[axis] - low[axis]) < 1e-9 * np.ptp(high - low) + 1e-12 else "high"
            held = {(1, "low"): "fixed", (0, "high"): "fixed", (2, "high"): "fixed",
                    (2, "low"): "plane"}.get((axis, side))
        return key, cells, area, np.array([normal, along, np.cross(normal, along)]), held

    def corner(self, cell, vertex):
        """The local number of a vertex in a cell."""
        return int(np.flatnonzero(self.cells[cell] == vertex)[0])


PAIRS = [(i, j) for i in range(3) for j in range(i, 3)]  # components of symmetric tensors


def tensors(block):
    """The rows that map six components to the nine of a symmetric tensor."""
    rows = np.zeros((9, block.shape[1]))
    for k, (i, j) in enumerate(PAIRS):
        rows[3 * i + j] = rows[3 * j + i] = block[k]
    return rows


class Programme:
    """min c.x where A x = b, and h - G x is in second-order and semidefinite cones."""

    def __init__(self, size):
        self.size, self.cost = size, np.zeros(size)
        self.equations, self.right = [], []
        self.cones = {"l": [], "q": [], "s": []}

    def require(self, row, value=0.):
        """Adds an equation."""
        self.equations.append(row)
        self.right.append(value)

    def cone(self, kind, rows, offset=None):
        """Requires that rows x + offset is in a cone."""
        self.cones[kind].append((rows, np.zeros(len(rows)) if offset is None else offset))

    def solve(self):
        """@return the least cost; equations are eliminated by singular values"""
        A, b = np.array(self.equations), np.array(self.right)
        U, sizes, V = np.linalg.svd(A, full_matrices=True)
        rank = int(np.sum(sizes > 1e-10 * sizes[0]))
        x_0 = V[:rank].T @ ((U.T @ b)[:rank] / sizes[:rank])
        N = V[rank:].T
        blocks = self.cones["l"] + self.cones["q"] + self.cones["s"]
        G = np.concatenate([rows for rows, _ in blocks])
        h = np.concatenate([offset for _, offset in blocks]) + G @ x_0
        solvers.options.update(show_progress=False, abstol=1e-8, reltol=1e-8, feastol=1e-9)
        answer = solvers.conelp(
            matrix(N.T @ self.cost), matrix(-G @ N), matrix(h),
            {"l": sum(len(rows) for rows, _ in self.cones["l"]),
             "q": [len(rows) for rows, _ in self.cones["q"]],
             "s": [3 for _ in self.cones["s"]]})
        return answer["primal objective"] + self.cost @ x_0, answer["status"]


def lower_bound(mesh, sine, strength):
    """The greatest factor of the weight in equilibrium with linear stresses, each vertex with
    t: (k + t) I - (1 + S) s and (1 - S) s - t I semidefinite."""
    def stress(cell, i):
        block = np.zeros((6, size))
        block[:, 7 * (4 * cell + i):7 * (4 * cell + i) + 6] = np.eye(6)
        return tensors(block)

    n_cells = len(mesh.cells)
    size = 28 * n_cells + 1
    programme = Programme(size)
    programme.cost[-1] = -1.
    unit = np.eye(3).ravel()
    for c in range(n_cells):
        divergence = sum(stress(c, i).reshape(3, 3, -1).transpose(0, 2, 1) @ mesh.gradients[c, i]
                         for i in range(4))
        divergence[1, -1] -= WEIGHT
        for row in divergence:
            programme.require(row)
        for i in range(4):
            s = stress(c, i)
            t = np.zeros((9, size))
            t[:, 7 * (4 * c + i) + 6] = unit
            programme.cone("s", t - (1. + sine) * s, strength * unit)
            programme.cone("s", (1. - sine) * s - t)
    for key, cells, _, axes, held in mesh.faces:
        for vertex in key:
            traction = sum(sign * stress(c, mesh.corner(c, vertex)).reshape(3, 3, -1)
                           .transpose(0, 2, 1) @ axes[0] for c, sign in zip(cells, (1., -1.)))
            if held == "fixed":
                continue
            for row in (axes @ traction)[held == "plane":]:  # a plane carries normal traction
                programme.require(row)
    value, status = programme.solve()
    return -value, status


def upper_bound(mesh, sine, strength):
    """The least factor of the weight by linear velocities that jump at all faces: strain rates
    are (1 + S) Z1 - (1 - S) Z2 with tr Z1 = tr Z2, and dissipate k tr Z1."""
    n_cells = len(mesh.cells)
    inner = [face for face in mesh.faces if len(face[1]) == 2 or face[4]]
    first_z, first_w = 12 * n_cells, 18 * n_cells
    size = first_w + 3 * len(inner)
    programme = Programme(size)
    unit = np.eye(3).ravel()

    def velocity(cell, i):
        rows = np.zeros((3, size))
        rows[:, 12 * cell + 3 * i:12 * cell + 3 * i + 3] = np.eye(3)
        return rows

    work = np.zeros(size)
    for c in range(n_cells):
        gradient = sum(np.einsum("ik,j->ijk", velocity(c, i), mesh.gradients[c, i])
                       for i in range(4))
        rate = (gradient + gradient.transpose(1, 0, 2)).reshape(9, -1) / 2.
        block = np.zeros((6, size))
        block[:, first_z + 6 * c:first_z + 6 * c + 6] = np.eye(6)
        Z_1 = tensors(block)
        Z_2 = ((1. + sine) * Z_1 - rate) / (1. - sine)
        programme.cone("s", Z_1)
        programme.cone("s", Z_2)
        programme.require(unit @ (Z_1 - Z_2))
        programme.cost += mesh.volumes[c] * strength * (unit @ Z_1)
        work -= mesh.volumes[c] * WEIGHT / 4. * sum(velocity(c, i)[1] for i in range(4))
    programme.require(work, 1.)
    cosine = np.sqrt(1. - sine**2)
    cohesion, friction = strength / (2. * cosine), sine / cosine
    for f, (key, cells, area, axes, held) in enumerate(inner):
        for i, vertex in enumerate(key):
            jump = -axes @ velocity(cells[0], mesh.corner(cells[0], vertex))
            if len(cells) == 2:
                jump += axes @ velocity(cells[1], mesh.corner(cells[1], vertex))
            least = np.zeros(size)  # of the sliding
            least[first_w + 3 * f + i] = 1.
            if held == "plane":
                programme.cone("l", jump[:1])
                programme.require(least)
            else:
                programme.cone("q", np.concatenate([least[None], jump[1:]]))
            if sine > 0.:
                if held != "plane":
                    programme.require(jump[0] - friction * least)
                programme.cost += area / 3. * cohesion / friction * jump[0]
            else:
                programme.require(jump[0])
                programme.cost += area / 3. * cohesion * least
    return programme.solve()


def main(folder, angles):
    """Compares the bounds of all runs; returns the exit code."""
    worst = 0.
    for angle in angles:
        run = Run(f"{folder}/{angle}")
        field, = run.states("bounds")
        mesh = Mesh(field)
        sine = np.sin(np.radians(float(angle)))
        strength = 2. * COHESION * np.sqrt(1. - sine**2)
        for side, bound in ("lower", lower_bound), ("upper", upper_bound):
            value, status = bound(mesh, sine, strength)
            own = run.value(f"bounds/{side}")
            margin = MARGIN if side == "upper" and sine > 0. and own > value else 0.
            worst = max(worst, abs(own / value - 1.) - margin)
            print(f"phi = {angle}, {len(mesh.cells)} tetrahedra, {side} bound: {own:.9g}, by "
                  f"cvxopt {value:.9g} ({status}), difference {own / value - 1.:.1e}",
                  file=sys.stderr)
    print(f"the other solver agrees to {AGREEMENT:g}: {'yes' if worst < AGREEMENT else 'no'}")
    return 0 if worst < AGREEMENT else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
