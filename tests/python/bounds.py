"""Both bounds of the load of a rough footing on weightless soil as second-order cone
programmes, written down anew from the mesh of a run and solved by cvxopt."""

import json
import sys

import cvxopt
import numpy as np

import geocone

C, PHI, HALF_WIDTH = 2000., np.radians(25.), 0.1
SIN, COS = np.sin(PHI), np.cos(PHI)
cvxopt.solvers.options.update(show_progress=False, abstol=1e-9, reltol=1e-9, feastol=1e-9)


def mesh_of(run):
    """Vertices and triangles, counterclockwise."""
    field = run.fields("bounds")
    corners = field.points[field.cells[0].data]
    # Files hold single precision.
    _, first, place = np.unique(np.round(corners.reshape(-1, 2), 6), axis=0,
                                return_index=True, return_inverse=True)
    points, cells = corners.reshape(-1, 2)[first], place.reshape(-1, 3)
    a, b = (points[cells[:, i]] - points[cells[:, 0]] for i in (1, 2))
    turned = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] < 0.
    cells[turned] = cells[turned][:, ::-1]
    return points, cells


def edges_of(cells):
    """Edges as sorted pairs of vertices, with the cells that have them."""
    edges = {}
    for c, cell in enumerate(cells):
        for i in range(3):
            edges.setdefault(tuple(sorted((cell[i], cell[(i + 1) % 3]))), []).append(c)
    return edges


def gradients(x):
    """Area of a triangle, and the gradients of its barycentric coordinates."""
    area = 0.5 * np.linalg.det(np.column_stack([x[1] - x[0], x[2] - x[0]]))
    side = x[[2, 0, 1]] - x[[1, 2, 0]]
    return area, np.column_stack([-side[:, 1], side[:, 0]]) / (2. * area)


def solve(cost, cones, equations):
    """min cost.x: F x + g in the cone t >= |(u, v)| for (F, g) of cones, A x = b. The
    equations, which may depend on each other, are eliminated."""
    A, b = equations
    U, s, Vt = np.linalg.svd(A)
    rank = np.sum(s > 1e-10 * s[0])
    start = Vt[:rank].T @ ((U[:, :rank].T @ b) / s[:rank])
    assert np.abs(A @ start - b).max() < 1e-9 * max(1., np.abs(b).max())
    free = Vt[rank:].T
    G = np.vstack([-F @ free for F, _ in cones])
    h = np.concatenate([g + F @ start for F, g in cones])
    found = cvxopt.solvers.conelp(
        cvxopt.matrix(free.T @ cost), cvxopt.matrix(G), cvxopt.matrix(h),
        {"l": 0, "q": [3] * len(cones), "s": []})
    assert found["status"] == "optimal", found["status"]
    return cost @ (start + free @ np.array(found["x"]).ravel())


def upper_bound(points, cells):
    """Quadratic velocities; strains are linear, and admissible at the vertices."""
    edges = edges_of(cells)
    number = {edge: len(points) + i for i, edge in enumerate(edges)}
    n = 2 * (len(points) + len(edges))
    places = np.vstack([points, [points[list(edge)].mean(axis=0) for edge in edges]])
    cost, cones = np.zeros(n), []
    for cell in cells:
        area, g = gradients(points[cell])
        nodes = [*cell, *(number[tuple(sorted((cell[(i + 1) % 3], cell[(i + 2) % 3])))]
                          for i in range(3))]
        for i in range(3):  # at vertex i: N_j = L_j (2 L_j - 1), N_3+j = 4 L_k L_l
            L = np.eye(3)[i]
            slopes = [(4. * L[j] - 1.) * g[j] for j in range(3)] + [
                4. * (L[(j + 1) % 3] * g[(j + 2) % 3] + L[(j + 2) % 3] * g[(j + 1) % 3])
                for j in range(3)]
            F = np.zeros((3, n))
            for node, slope in zip(nodes, slopes):
                F[:, 2 * node] += slope[0] / SIN, slope[0], slope[1]
                F[:, 2 * node + 1] += slope[1] / SIN, -slope[1], slope[0]
            cones.append((F, np.zeros(3)))
            # c cot(phi) (e_xx + e_yy)
            cost += area / 3. * C * COS * F[0]
    held, value = [], []
    low, high = points.min(axis=0), points.max(axis=0)
    used = set(cells.ravel()) | set(number.values())
    for node, (x, y) in enumerate(places):
        footing = abs(y - high[1]) < 1e-9 and x < HALF_WIDTH + 1e-6
        bottom, side = abs(y - low[1]) < 1e-9, min(x - low[0], high[0] - x) < 1e-9
        if bottom or side or footing or node not in used:
            held.append(2 * node)
            value.append(0.)
        if bottom or footing or node not in used:
            held.append(2 * node + 1)
            value.append(-1. if footing else 0.)
    return 2. * solve(cost, cones, (np.eye(n)[held], np.array(value)))


def lower_bound(points, cells):
    """Stresses that are linear in each cell; tractions pass over all edges."""
    n = 9 * len(cells)
    rows, high, low = [], points.max(axis=0), points.min(axis=0)
    cost, cones = np.zeros(n), []

    def traction(cell, vertex, normal):
        """Rows of the traction at a vertex of a cell."""
        i = 9 * cell + 3 * list(cells[cell]).index(vertex)
        t = np.zeros((2, n))
        t[0, [i, i + 2]] = normal
        t[1, [i + 2, i + 1]] = normal
        return t

    for c, cell in enumerate(cells):
        _, g = gradients(points[cell])
        divergence = sum(traction(c, vertex, slope) for vertex, slope in zip(cell, g))
        rows += list(divergence)
        for i in range(3):
            F = np.zeros((3, n))
            at = 9 * c + 3 * i
            F[0, [at, at + 1]] = -SIN
            F[1, [at, at + 1]] = 1., -1.
            F[2, at + 2] = 2.
            cones.append((F, np.array([2. * C * COS, 0., 0.])))
    for edge, owners in edges_of(cells).items():
        a, b = points[list(edge)]
        along = (b - a) / np.linalg.norm(b - a)
        normal = np.array([along[1], -along[0]])
        middle = (a + b) / 2.
        for vertex in edge:
            t = traction(owners[0], vertex, normal)
            if len(owners) == 2:
                rows += list(t - traction(owners[1], vertex, normal))
            elif abs(middle[1] - high[1]) < 1e-9:
                if middle[0] > HALF_WIDTH:
                    rows += list(t)
                else:  # the footing: what presses on it
                    i = 9 * owners[0] + 3 * list(cells[owners[0]]).index(vertex)
                    cost[i + 1] += np.linalg.norm(b - a) / 2.
            elif abs(middle[1] - low[1]) > 1e-9:  # a smooth side
                rows.append(along @ t)
    A = np.array(rows)
    A /= np.linalg.norm(A, axis=1)[:, None]
    # In units of the cohesion.
    return -2. * C * solve(cost, [(F, g / C) for F, g in cones], (A, np.zeros(len(A))))


run = geocone.read(sys.argv[1])
points, cells = mesh_of(run)
summary = json.load(open(f"{sys.argv[1]}/summary.json"))["bounds"]
for name, bound in ("lower", lower_bound), ("upper", upper_bound):
    own, other = summary[name], bound(points, cells)
    print(f"{name}: {own:.4f} {other:.4f} {own / other - 1.:+.1e}")
    assert abs(own / other - 1.) < 1e-5, name
