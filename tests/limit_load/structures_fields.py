"""Integrates the tractions of the soil along the structures of a lower bound, which geocone's own
rows of equilibrium have no part in, and compares axial forces, shear forces and moments:
structures_fields.py ROOT RUN."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(sys.argv[1]) / "python"))
from geocone.plots.bars import bars_of
from geocone.reader import Run

NEAR = 1e-9  # of coordinates, written in full
ROUNDING = 2e-6  # fields are single or rounded numbers; of the largest force


def tractions_of(field):
    """Tractions of each triangle on its edges: by the places of both ends, the tractions there,
    in the order of the places."""
    found = {}
    stress = np.concatenate([field.data[f"stress_{name}"][:, :1] for name in ("xx", "yy", "xy")],
                            axis=1)
    for cell in field.cells:
        x = field.points[cell][:, :2]
        for i in range(3):
            ends = [(i + 1) % 3, (i + 2) % 3]
            a, b = x[ends]
            t = (b - a) / np.linalg.norm(b - a)
            n = np.array([t[1], -t[0]])
            if n @ (x[i] - a) > 0.:
                n = -n  # outwards
            pulls = []
            for end in ends:
                xx, yy, xy = stress[cell[end]]
                pulls.append([xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]])
            pairs = sorted(zip([tuple(np.round(p, 4)) for p in (a, b)], pulls))
            found.setdefault((pairs[0][0], pairs[1][0]), []).append(
                (np.array([pair[1] for pair in pairs]), n))
    return found


def check(of, found, wanted, scale):
    """Fails unless two numbers are equal to rounding of the fields."""
    assert abs(found - wanted) <= ROUNDING * scale, (of, found, wanted, scale)


def check_vertices(bar, bars):
    """Checks the equilibrium of a straight bar with its anchors at all vertices, and its ends."""
    N, V, M = bar["axial force"], bar["shear force"], bar["bending moment"]
    t = (bar.x[-1] - bar.x[0]) / np.linalg.norm(bar.x[-1] - bar.x[0])
    n, scale = np.array([-t[1], t[0]]), np.abs(N).max() + np.abs(V).max()
    n_anchors = 0
    for first in range(0, len(N) + 1, 3):
        rest = np.zeros(2)
        if first > 0:
            rest += N[first - 1] * t - V[first - 1] * n
        if first < len(N):
            rest += V[first] * n - N[first] * t
        x = bar.x[min(first, len(N) - 1)]
        for tie in bars:
            if tie.kind in ("anchor", "strut"):
                for end in range(2):
                    away = tie.x[1 - end] - tie.x[end]
                    if np.linalg.norm(tie.x[end] - x) < 1e-6:
                        rest -= tie["axial force"][0] * away / np.linalg.norm(away)
                        n_anchors += 1
        check("vertex", np.abs(rest).max(), 0., scale)
    check("moment", np.abs(np.diff(M)[2::3]).max(), 0., 1. + np.abs(M).max())
    check("ends", abs(M[0]) + abs(M[-1]), 0., 1. + np.abs(M).max())
    assert n_anchors == 1, n_anchors


def main():
    """Checks all plates and geogrids of a run."""
    run = Run(Path(sys.argv[2]))
    field, = run.states("bounds")
    tractions, n_edges = tractions_of(field), 0
    largest = max(np.abs(pull).max() for sides in tractions.values() for pull, _ in sides)
    soil = "Materials/" + run.parameters["Materials/Names"]
    strength = float(run.parameters[soil + "/Cohesion"])
    tan_phi = np.tan(np.radians(float(run.parameters[soil + "/Friction angle"])))
    bars = bars_of(run)[0]
    for bar in bars:
        if bar.kind not in ("plate", "geogrid"):
            continue
        r = float(run.parameters[f"Structures/{bar.name}/Interface strength"])
        N, V, M = bar["axial force"], bar["shear force"], bar["bending moment"]
        for first in range(0, len(N), 3):
            a, middle, b = bar.x[first:first + 3]
            L = np.linalg.norm(b - a)
            t = (b - a) / L
            n = np.array([-t[1], t[0]])
            key = [tuple(np.round(p, 4)) for p in (a, b)]
            sides = tractions[tuple(sorted(key))]
            if len(sides) == 1 and bar.name == "raft":
                continue  # loaded from outside
            total = sum(pull for pull, _ in sides)
            p = -(total if key[0] < key[1] else total[::-1])
            scale = largest * L + np.abs(N).max() + np.abs(V).max()
            along, across = p @ t, p @ n
            check("N", N[first + 2] - N[first], -L / 2. * along.sum(), scale)
            check("N", N[first + 1] - N[first], -L * (3. * along[0] + along[1]) / 8., scale)
            check("V", V[first + 2] - V[first], L / 2. * across.sum(), scale)
            scale *= L
            check("M", M[first + 2] - M[first],
                  L * V[first] + L**2 * (2. * across[0] + across[1]) / 6., scale + np.abs(M).max())
            check("M", M[first + 1] - M[first],
                  L / 2. * V[first] + L**2 * (5. * across[0] + across[1]) / 48.,
                  scale + np.abs(M).max())
            for pull, normal in sides:
                for traction in pull:
                    r_N = -traction @ normal
                    r_T = abs(traction[0] * normal[1] - traction[1] * normal[0])
                    assert r_T <= r * (strength + tan_phi * r_N) + ROUNDING * largest
            n_edges += 1
        for name, limit in (("axial force", bar.tensile), ("bending moment", bar.moment)):
            assert limit is None or bar[name].max() <= limit * (1. + 1e-6), (bar.name, name)
        assert bar.compressive is None or bar["axial force"].min() >= -bar.compressive - 1e-6
        check_vertices(bar, bars)
    assert n_edges > 10
    print(f"{n_edges} edges")


main()
