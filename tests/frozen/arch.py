#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes arch_30.dat, and with h5py arch_30.hdf5, beside itself:

    python3 tests/frozen/arch.py

A semicircular arch of 30 rigid blocks, 0.2 m thick, 1 m mean radius, 1 m deep, mu = 0.8,
under its weight: contact with friction alone, at the inner and outer end of each of the
31 joints. A step of 1 ms from rest: u = W r + q with W = H M^-1 H', q = h H g, components
along the normal of a joint and along it. It stands (its thickness is more than 0.107 of
the radius, Milankovitch 1907): the solution is u = 0, the forces are not unique. Both
files hold the same problem, in the formats of Siconos and of FCLib (global: M, H, f, w).
"""
import os

import numpy as np

N, R, THICK, RHO, MU, STEP, G = 30, 1., 0.2, 2400., 0.8, 1e-3, 9.81


def problem():
    angle = np.pi / N
    area = ((R + THICK / 2)**2 - (R - THICK / 2)**2) / 2 * angle
    mass = RHO * area
    # As of a bar across and along: the inertia only weighs rotations.
    inertia = mass * (THICK**2 + (R * angle)**2) / 12
    centre = [R * np.array([np.cos((k + 0.5) * angle), np.sin((k + 0.5) * angle)])
              for k in range(N)]
    M = np.tile([mass, mass, inertia], N)
    H = np.zeros((3 * N, 4 * (N + 1)))
    for joint in range(N + 1):
        phi = joint * angle
        n = np.array([-np.sin(phi), np.cos(phi)])  # to the next block
        t = np.array([-n[1], n[0]])
        for side, radius in enumerate((R - THICK / 2, R + THICK / 2)):
            x = radius * np.array([np.cos(phi), np.sin(phi)])
            for c, axis in enumerate((n, t)):
                column = 4 * joint + 2 * side + c
                for block, sign in ((joint, 1.), (joint - 1, -1.)):
                    if 0 <= block < N:
                        arm = x - centre[block]
                        H[3 * block:3 * block + 3, column] = sign * np.array(
                            [axis[0], axis[1], arm[0] * axis[1] - arm[1] * axis[0]])
    f = STEP * M * np.tile([0., -G, 0.], N)
    return M, H, f


def write_siconos(path, M, H, f):
    W = H.T @ (H / M[:, None])
    q = H.T @ (f / M)
    n = len(q)
    entries = [(i, j, W[i, j]) for i in range(n) for j in range(n)
               if abs(W[i, j]) > 1e-14 * W.max()]
    with open(path, 'w', encoding='ascii') as out:
        out.write(f'2\n{n // 2}\n2\n{n}\n{n}\n1\nCSparse 4, by arch.py\ntriplet: {n}-by-{n}, '
                  f'nzmax: {len(entries)} nnz: {len(entries)}\n')
        for i, j, w in entries:
            out.write(f'    {i} {j} : {w:.16e}\n')
        out.write(' '.join(f'{x:.16e}' for x in q) + '\n')
        out.write(' '.join([f'{MU:.16e}'] * (n // 2)) + '\n1\n')


def write_fclib(path, M, H, f):
    import h5py
    with h5py.File(path, 'w') as out:
        group = out.create_group('fclib_global')
        group['spacedim'] = np.array([2], dtype='i4')
        for name, matrix in (('M', np.diag(M)), ('H', H)):
            i, p = np.nonzero(matrix)
            for key, value in (('m', [matrix.shape[0]]), ('n', [matrix.shape[1]]),
                               ('nz', [len(i)]), ('nzmax', [len(i)]), ('i', i), ('p', p)):
                group[f'{name}/{key}'] = np.array(value, dtype='i4')
            group[f'{name}/x'] = matrix[i, p]
        group['vectors/mu'] = np.full(H.shape[1] // 2, MU)
        group['vectors/f'] = f
        group['vectors/w'] = np.zeros(H.shape[1])


if __name__ == '__main__':
    HERE = os.path.dirname(os.path.abspath(__file__))
    write_siconos(os.path.join(HERE, 'arch_30.dat'), *problem())
    write_fclib(os.path.join(HERE, 'arch_30.hdf5'), *problem())
