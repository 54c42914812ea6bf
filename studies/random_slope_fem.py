#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Limit load factor of the weight of a slope with the strengths of a sample, by finite elements that
share nothing with geocone (numpy and scipy): for doc/cookbook/reliability.md.
    studies/random_slope_fem.py DIVISIONS RUN_FOLDER ...
Takes the mesh and the strengths from the field file of a reliability analysis of
prm/reliability/slope.prm. Six-node triangles with three Gauss points, each triangle of the mesh divided
into four DIVISIONS times; elastic and perfectly plastic in plane strain, |s_t| <= c; Newton's method with
the consistent tangent; the weight is raised until equilibrium is no longer found."""
import base64
import re
import struct
import sys
import zlib
from pathlib import Path

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

WEIGHT, COHESION, YOUNG, POISSON = 20000., 50000., 1e8, 0.3
TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}


def array(text, place):
    """An array of a VTU file, compressed by blocks. @param place what precedes its data"""
    kind, raw = re.search(place + r'[^>]*>\s*([^<\s]*)', text).groups()
    n = struct.unpack("<I", base64.b64decode(raw[:8])[:4])[0]
    head = 4 * ((4 * (3 + n) + 2) // 3)
    sizes = struct.unpack(f"<{3 + n}I", base64.b64decode(raw[:head])[:4 * (3 + n)])[3:]
    data, out = base64.b64decode(raw[head:]), b""
    for size in sizes:
        out += zlib.decompress(data[:size])
        data = data[size:]
    return np.frombuffer(out, TYPES[kind])


def mesh_of(folder):
    """Vertices, triangles and factors of their cohesion."""
    text = sorted(Path(folder).glob("sample-0000*.vtu"))[0].read_text()
    points = array(text, r'<Points>\s*<DataArray type="(\w+)"').reshape(-1, 3)[:, :2]
    triangles = array(text, r'<DataArray type="(\w+)" Name="connectivity"').reshape(-1, 3)
    factor = array(text, r'<DataArray type="(\w+)" Name="cohesion_factor"').astype(float)
    X, number = np.unique(np.round(points.astype(float), 4), axis=0, return_inverse=True)
    return X, number.ravel()[triangles], factor[triangles[:, 0]] if len(factor) != len(
        triangles) else factor


def divided(X, T):
    """Vertices with the edges' midpoints, four triangles for each, and its midpoints."""
    edges = np.sort(T[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2), axis=1)
    keys, number = np.unique(edges, axis=0, return_inverse=True)
    M = len(X) + number.reshape(-1, 3)
    (a, b, c), (p, q, r) = T.T, M.T
    return np.concatenate([X, X[keys].mean(1)]), np.concatenate(
        [np.stack(one, 1) for one in ((a, r, q), (r, b, p), (q, p, c), (p, q, r))]), M


class Slope:
    """Finite elements of a slope, held at its bottom and along x at its sides."""

    def __init__(self, folder, divisions):
        X, T, factor = mesh_of(folder)
        for _ in range(divisions):
            X, T, _ = divided(X, T)
            factor = np.tile(factor, 4)
        side = X[T[:, [2, 0, 1]]] - X[T[:, [1, 2, 0]]]
        area = (side[:, 0, 0] * side[:, 1, 1] - side[:, 0, 1] * side[:, 1, 0]) / 2.
        T[area < 0.] = T[area < 0.][:, [0, 2, 1]]
        side, area = X[T[:, [2, 0, 1]]] - X[T[:, [1, 2, 0]]], np.abs(area)
        g = np.stack([-side[..., 1], side[..., 0]], -1) / (2. * area[:, None, None])
        self.X, _, M = divided(X, T)
        nodes = np.concatenate([T, M], 1)
        self.c = COHESION * factor[:, None]
        self.B, shapes = np.zeros((len(T), 3, 3, 12)), np.zeros((3, 6))
        for k, l in enumerate(np.full((3, 3), 1. / 6.) + np.eye(3) / 2.):
            of = np.zeros((len(T), 6, 2))
            for i in range(3):
                a, b = (i + 1) % 3, (i + 2) % 3
                of[:, i] = (4. * l[i] - 1.) * g[:, i]
                of[:, 3 + i] = 4. * (l[a] * g[:, b] + l[b] * g[:, a])
                shapes[k, i], shapes[k, 3 + i] = l[i] * (2. * l[i] - 1.), 4. * l[a] * l[b]
            self.B[:, k, 0, ::2] = self.B[:, k, 2, 1::2] = of[..., 0]
            self.B[:, k, 1, 1::2] = self.B[:, k, 2, ::2] = of[..., 1]
        self.w = np.repeat(area[:, None] / 3., 3, 1)
        self.dofs = np.stack([2 * nodes, 2 * nodes + 1], -1).reshape(len(T), 12)
        self.n = 2 * len(self.X)
        self.F = np.zeros(self.n)
        np.add.at(self.F, 2 * nodes + 1, -WEIGHT * self.w @ shapes)
        held, (x, y) = np.zeros((len(self.X), 2), bool), self.X.T
        held[y < 1e-3] = True
        held[(x < 1e-3) | (x > x.max() - 1e-3), 0] = True
        self.free = np.flatnonzero(~held.ravel())
        self.G = YOUNG / (2. * (1. + POISSON))
        self.K = self.G / (1. - 2. * POISSON)  # of (e_xx + e_yy), plane strain
        self.rows, self.columns = np.repeat(self.dofs, 12, 1).ravel(), np.tile(
            self.dofs, (1, 12)).ravel()

    def stress(self, du, s):
        """Stresses after displacements du from the stresses s, and the tangent."""
        e = np.einsum("tqai,ti->tqa", self.B, du[self.dofs])
        p = (s[..., 0] + s[..., 1]) / 2. + self.K * (e[..., 0] + e[..., 1])
        d = (s[..., 0] - s[..., 1]) / 2. + self.G * (e[..., 0] - e[..., 1])
        t = s[..., 2] + self.G * e[..., 2]
        R = np.maximum(np.hypot(d, t), 1e-300)
        flows, k = R > self.c, np.minimum(self.c / R, 1.)
        a, d_1, t_1 = self.G * k, d / R, t / R
        dd, dt, tt = a * (1. - flows * d_1**2), -a * flows * d_1 * t_1, a * (1. - flows * t_1**2)
        D = np.stack([np.stack([self.K + dd, self.K - dd, dt], -1),
                      np.stack([self.K - dd, self.K + dd, -dt], -1),
                      np.stack([dt, -dt, tt], -1)], -2)
        return np.stack([p + k * d, p - k * d, k * t], -1), D

    def residual(self, s, factor):
        r = -factor * self.F
        np.add.at(r, self.dofs, np.einsum("tq,tqai,tqa->ti", self.w, self.B, s))
        return r[self.free]

    def direction(self, D, r):
        D = D + 1e-9 * self.G * np.diag([2., 2., 1.])
        k = np.einsum("tq,tqai,tqab,tqbj->tij", self.w, self.B, D, self.B, optimize=True)
        m = sp.csc_matrix((k.ravel(), (self.rows, self.columns)), shape=(self.n, self.n))
        du = np.zeros(self.n)
        du[self.free] = splu(m[self.free][:, self.free].tocsc(), permc_spec="MMD_AT_PLUS_A",
                             options={"SymmetricMode": True}).solve(-r)
        return du

    def equilibrium(self, s_0, factor):
        """Stresses in equilibrium with the weight times a factor, or None."""
        du = np.zeros(self.n)
        s, D = self.stress(du, s_0)
        r = self.residual(s, factor)
        for _ in range(40):
            if np.linalg.norm(r) < 1e-6 * np.linalg.norm(self.F):
                return s
            step, length = self.direction(D, r), 1.
            while True:  # line search
                s, D = self.stress(du + length * step, s_0)
                new = self.residual(s, factor)
                if np.linalg.norm(new) < (1. - 0.1 * length) * np.linalg.norm(r):
                    break
                length /= 2.
                if length < 1e-3:
                    return None
            du, r = du + length * step, new
        return None

    def limit(self):
        """A factor that is carried, and one that is not."""
        s, carried, step = np.zeros(self.w.shape + (3,)), 0., 0.4
        while step > 0.002 * max(carried, 0.1):
            found = self.equilibrium(s, carried + step)
            if found is not None:
                s, carried = found, carried + step
            if found is None or step >= 0.05:
                step /= 2.
        return carried, carried + step


if __name__ == "__main__":
    for run in sys.argv[2:]:
        slope = Slope(run, int(sys.argv[1]))
        print("%s: %d nodes, carried %.4f, not %.4f" % (run, len(slope.X), *slope.limit()), flush=True)
