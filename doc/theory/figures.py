#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the sketches of the theory, doc/theory/*.svg. Returns, flow and the change of
variable are computed by the formulas of cone.md and laws.md; doc/images/paper_cone.py
draws them from the code."""

import pathlib
import sys

import matplotlib
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from geocone import style  # noqa: E402

BLUE, RED, GREEN = style.COLORS[:3]
DARK, PALE = "#303030", "#f4ead6"  # lines and text; soil


def arrow(axes, start, end, color=DARK, width=1.8, head="-|>", bend=0.):
    axes.annotate("", xy=end, xytext=start, zorder=5,
                  arrowprops={"arrowstyle": head, "color": color, "lw": width,
                              "connectionstyle": f"arc3,rad={bend}",
                              "shrinkA": 0., "shrinkB": 0.})


def note(axes, place, text, color=DARK, **options):
    axes.text(*place, text, color=color, zorder=6,
              **{"ha": "center", "va": "center", **options})


def dots(axes, points, color=DARK, marker="o", size=6, **options):
    axes.plot(*np.transpose(points), marker, color=color, markersize=size, zorder=4, **options)


def polygon(axes, corners, face="none", edge=DARK, width=1.2, **options):
    axes.fill(*np.transpose(corners), facecolor=face, edgecolor=edge, linewidth=width, **options)


def lattice(axes, n, m=None, color="#b0b0b0"):
    """The lines of n x m cells of the size 1."""
    m = m or n
    for i in range(n + 1):
        axes.plot([i, i], [0, m], color=color, linewidth=1.)
    for j in range(m + 1):
        axes.plot([0, n], [j, j], color=color, linewidth=1.)


def sketch(axes, low, high, title):
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", title=title)
    axes.axis("off")


class Cone:
    """The law in the plane (s_n, s_t), by formulas."""

    def __init__(self, phi, theta, k=1., two_g=1., nu=0.3):
        self.a, self.b = np.sin(np.radians([phi, theta]))
        self.k, self.two_g, self.bulk = k, two_g, two_g / (1. - 2. * nu)
        self.apex = -k / self.a

    def flow(self, trial):
        """Stress s and z = -(plastic strain increment) of a trial stress that yields."""
        n, t = trial
        g = (abs(t) - self.a * n - self.k) / (self.two_g + self.a * self.b * self.bulk)
        assert g > 0.
        if abs(t) >= self.two_g * g:
            z = g * np.array([self.b, -np.sign(t)])
            return np.array([n + self.bulk * z[0], t + self.two_g * z[1]]), z
        return (np.array([self.apex, 0.]),
                np.array([(self.apex - n) / self.bulk, -t / self.two_g]))

    def psi(self, z):
        return z + (self.a - self.b) * abs(z[1]) * np.array([1., 0.])

    def draw(self, axes, end, sides=(1., -1.)):
        top = self.a * end + self.k
        for side in sides:
            polygon(axes, [(self.apex, 0.), (end, side * top), (end, 0.)], style.BLUE, "none",
                    alpha=0.13)
            axes.plot([end, self.apex], [side * top, 0.], color=style.BLUE, linewidth=2.)


def cross(axes, low, high, n, t):
    """Axes of a plane, without numbers."""
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.axis("off")
    arrow(axes, (low[0], 0.), (high[0], 0.), "#808080", 1.)
    arrow(axes, (0., low[1]), (0., high[1]), "#808080", 1.)
    note(axes, (high[0], -0.28), n, ha="right")
    note(axes, (0.12, high[1] - 0.1), t, ha="left")


def draw_cone(figure_axes):
    stress, strain = figure_axes
    law = Cone(30., 8.)
    cross(stress, (-3.1, -2.8), (4., 2.8), "$s_n$ (compression)", "$s_t$")
    law.draw(stress, 3.4)
    note(stress, (2.6, 0.75), "$C$", style.BLUE, fontsize=14)
    for trial in ((1.5, 2.), (0.2, -1.7), (-2.9, 0.25)):
        s, z = law.flow(np.array(trial))
        length = 1.05 / np.linalg.norm(law.psi(z))
        arrow(stress, s, s - length * z, GREEN)
        if abs(z[0] - law.b * abs(z[1])) < 1e-9:
            arrow(stress, s, s - length * law.psi(z), RED)
            side = np.sign(s[1])
            note(stress, s - length * z + (0.25, side * 0.15), "$-z$", GREEN)
            note(stress, s - length * law.psi(z) + (-0.3, side * 0.1), "$-y$", RED)
        dots(stress, [s])
    note(stress, (law.apex, -0.5), "apex $-k/a$")
    stress.set_title("Stress: flow $-z$ is not normal,\n$-y = -\\Psi(z)$ is normal to $C$")

    cross(strain, (-1.2, -2.8), (4.2, 2.8), "$z_n,\\ y_n$ (dilation)", "$z_t,\\ y_t$")
    for slope, color in ((law.a, style.BLUE), (law.b, GREEN)):
        t = np.array([2.4, 0., -2.4])
        strain.plot(slope * abs(t), t, color=color, linewidth=2.)
        if color == style.BLUE:
            polygon(strain, [*zip(slope * abs(t), t), (3.8, -2.4), (3.8, 2.4)], style.BLUE,
                    "none", alpha=0.13)
    note(strain, (2.9, -1.8), "$K_a^\\ast$", style.BLUE, fontsize=14)
    note(strain, (1.25, 2.62), "$y_n = a|y_t|$", style.BLUE, ha="left")
    note(strain, (-0.1, -2.1), "$z_n = b|z_t|$", GREEN, ha="right")
    for z in ((law.b * 1.9, 1.9), (law.b * 1.1, 1.1), (0.9, 0.75), (law.b * 1.5, -1.5)):
        y = law.psi(np.array(z))
        arrow(strain, z, y, DARK, 1.5)
        dots(strain, [z], GREEN)
        dots(strain, [y], RED)
    note(strain, (1.75, 1.55), "$y = \\Psi(z) = z + \\mu |z_t| n$", ha="left")
    strain.set_title("Change of variable: $z$ is moved\nalong $n$ into the dual cone $K_a^\\ast$")


def draw_return_map(axes):
    law = Cone(30., 12., two_g=1.6)
    low, high = (-4.6, -0.5), (3.6, 3.6)
    law.draw(axes, 3.2, sides=(1.,))
    # Trial stresses that return to the apex: q = 0, T = 2G g.
    rate = law.two_g / (law.two_g + law.a * law.b * law.bulk)
    end = law.apex - 3.3 * (1. - rate) / (rate * law.a)
    axes.plot([law.apex, end], [0., 3.3], "--", color="#707070", linewidth=1.3)
    cross(axes, low, high, "$s_n$ (compression)", "$|s_t|$")
    for trial, name in (((0.7, 2.7), "cone"), ((-1.1, 2.2), "cone"), ((-4.3, 0.9), "apex"),
                        ((-3.9, 0.), "apex")):
        s, _ = law.flow(np.array(trial))
        arrow(axes, trial, s, RED if name == "apex" else GREEN)
        dots(axes, [trial], "white", markeredgecolor=DARK)
        dots(axes, [s])
    dots(axes, [(1.6, 0.6)], "white", markeredgecolor=DARK)
    note(axes, (1.75, 0.6), "$t = s$", ha="left")
    note(axes, (0.85, 2.75), "trial stress $t = s^n + D e$", ha="left")
    note(axes, (2.3, 1.4), "$s$ elastic", style.BLUE)
    note(axes, (1.8, 3.2), "cone:  $s = t + D z$,  $z_n = b\\,|z_t|$", GREEN)
    note(axes, (-4.5, 1.7), "apex:\n$z_n > b\\,|z_t|$", RED, ha="left")
    note(axes, (end + 0.15, 3.15), "$q = 0$", "#707070", ha="left")
    note(axes, (law.apex, -0.3), "$-k/a$")


def draw_incremental(figure_axes):
    left, middle, right = figure_axes
    points = [(i + x, j + y) for i in range(2) for j in range(2)
              for x in (0.25, 0.75) for y in (0.25, 0.75)]
    nodes = [(i, j) for i in range(3) for j in range(3)]
    for axes in left, right:
        polygon(axes, [(0, 0), (2, 0), (2, 2), (0, 2)], PALE, "none")
        lattice(axes, 2)
        dots(axes, points, RED, "x", 6, markeredgewidth=1.8)
        dots(axes, nodes)
        sketch(axes, (-0.55, -0.6), (2.6, 2.6), "")
    for x, y in nodes:
        arrow(left, (x, y), (x + 0.16 * y, y - 0.1 - 0.2 * y), style.BLUE)
    left.set_title("Nodes: unknown velocities $v$")
    note(left, (1., -0.45), "strain increment at each point $p$:  $e = h B_p v$")
    sketch(middle, (-0.1, -0.1), (3.1, 3.1), "Points: the law, one by one")
    for y, text in ((2.35, "trial stress\n$t = s^n + D e$"),
                    (1.4, "return map\n$s_p(v)$, mode, $C^{ep}$")):
        polygon(middle, [(0.45, y - 0.36), (2.55, y - 0.36), (2.55, y + 0.36), (0.45, y + 0.36)],
                PALE, DARK)
        note(middle, (1.5, y), text)
    arrow(middle, (1.5, 1.98), (1.5, 1.78))
    arrow(middle, (-0.1, 2.35), (0.4, 2.35), style.BLUE)
    arrow(middle, (2.6, 1.4), (3.05, 1.4), RED)
    note(middle, (1.5, 0.5), "state of $t^n$ is not changed\nuntil the step is accepted", "#606060",
         fontsize=10)
    for x, y in nodes:
        arrow(right, (x, y), (x + 0.22 * (1 - x), y + 0.3), RED)
    right.set_title("Nodes: balance of forces")
    note(right, (1., -0.45), "$R(v) = M (v - v^L)/h + \\sum_p V_p B_p^\\top s_p(v) - F = 0$")


def draw_elements(figure_axes):
    # Degrees 2 and 5 on a triangle.
    a, b = (6. - 15.**0.5) / 21., (6. + 15.**0.5) / 21.

    def permuted(s):
        return [(s, s), (1. - 2. * s, s), (s, 1. - 2. * s)]

    rules = {1: [(1. / 3., 1. / 3.)], 2: permuted(1. / 6.),
             3: [(1. / 3., 1. / 3.), *permuted(a), *permuted(b)]}
    lobatto = {1: [0., 1.], 2: [0., 0.5, 1.], 3: [0., 0.5 - 0.05**0.5, 0.5 + 0.05**0.5, 1.]}
    for degree, (triangle, square) in enumerate(zip(*figure_axes), 1):
        polygon(triangle, [(0, 0), (1, 0), (0, 1)], PALE)
        dots(triangle, [(i / degree, j / degree) for i in range(degree + 1)
                        for j in range(degree + 1 - i)])
        dots(triangle, rules[degree], RED, "x", 7, markeredgewidth=1.8)
        polygon(square, [(0, 0), (1, 0), (1, 1), (0, 1)], PALE)
        dots(square, [(x, y) for x in lobatto[degree] for y in lobatto[degree]])
        gauss = (np.polynomial.legendre.leggauss(degree + 1)[0] + 1.) / 2.
        dots(square, [(x, y) for x in gauss for y in gauss], RED, "x", 7, markeredgewidth=1.8)
        for axes, letter in (triangle, "P"), (square, "Q"):
            sketch(axes, (-0.12, -0.12), (1.12, 1.12), f"{letter}{degree}")


def draw_transfer(figure_axes):
    random = np.random.default_rng(3)
    cells = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1)]
    particles = np.array([(i + x, j + y) for i, j in cells for x in (0.28, 0.72)
                          for y in (0.28, 0.72)]) + random.uniform(-0.06, 0.06, (20, 2))
    nodes = np.array([(i, j) for i in range(4) for j in range(3)])

    def velocity(x):
        return np.stack([0.10 + 0.09 * x[:, 1], -0.03 - 0.05 * x[:, 0] * x[:, 1]], 1)

    active = np.array([np.min(np.max(abs(particles - node), axis=1)) < 1. for node in nodes])
    titles = ("1. Particles to nodes\n$m_i$, $v_i^L$", "2. Solve on the mesh\n$R(v) = 0$",
              "3. Nodes to particles\n$v_p$, $x_p$, $V_p$, $s_p$", "4. Reset the mesh,\nsort particles")
    for step, (axes, title) in enumerate(zip(figure_axes, titles)):
        sketch(axes, (-0.25, -0.35), (3.55, 2.35), title)
        moved = particles + 1.6 * velocity(particles)
        if step == 2:  # the mesh as if it moved along
            deformed = nodes + 1.6 * velocity(nodes)
            grid = deformed.reshape(4, 3, 2)
            for line in [*grid, *grid.transpose(1, 0, 2)]:
                axes.plot(*line.T, color="#b0b0b0", linewidth=1.)
            dots(axes, deformed[active], DARK, size=5)
        else:
            lattice(axes, 3, 2)
            dots(axes, nodes[active], DARK, size=5)
        dots(axes, moved if step >= 2 else particles, style.ORANGE, "s", 6)
        if step == 0:
            for particle in particles[[1, 9, 15]]:
                for corner in (0, 0), (1, 0), (0, 1), (1, 1):
                    way = np.floor(particle) + corner - particle
                    arrow(axes, particle, particle + 0.86 * way, "#707070", 0.8)
        if step == 1:
            for node, v in zip(nodes[active], velocity(nodes[active])):
                arrow(axes, node, node + 2.6 * v, style.BLUE, 1.6)
        if step == 2:
            for start, end in zip(particles, moved):
                arrow(axes, start, end, style.BLUE, 1.)


def draw_contact(figure_axes):
    place, normal, tangential, bodies = figure_axes
    sketch(place, (-0.2, -0.6), (3.4, 2.6), "Node and obstacle")
    polygon(place, [(-0.2, -0.6), (3.4, -0.6), (3.4, 0.5), (-0.2, 0.2)], "#d0d0d0", DARK)
    polygon(place, [(0.2, 1.5), (1.5, 1.05), (3., 1.6), (2.8, 2.6), (0.3, 2.6)], PALE, DARK)
    place.plot([0.2, 1.5, 3.], [1.5, 1.05, 1.6], color=DARK)
    dots(place, [(0.2, 1.5), (1.5, 1.05), (3., 1.6)])
    foot, up = np.array([1.56, 0.347]), np.array([-0.083, 0.9965])
    arrow(place, foot, foot + 0.70 * up, DARK, 1.3, "<|-|>")
    note(place, (1.72, 0.68), "$g$", ha="left")
    arrow(place, (2.4, 0.417), np.array([2.4, 0.417]) + 0.75 * up, style.BLUE)
    note(place, (2.5, 0.85), "$n$", style.BLUE, ha="left")
    arrow(place, (1.5, 1.05), (1.05, 1.75), RED)
    note(place, (0.98, 1.95), "$r$", RED)
    arrow(place, (1.5, 1.05), (2.15, 0.85), GREEN)
    note(place, (2.17, 0.64), "$u$", GREEN)
    note(place, (1.7, 2.2), "body")
    note(place, (1.7, -0.25), "obstacle")

    cross(normal, (-0.5, -0.6), (3.1, 2.6), "$u_N + g/h$", "$r_N$")
    normal.plot([0., 0., 2.7], [2.3, 0., 0.], color=RED, linewidth=2.8)
    note(normal, (0.2, 1.3), "closed:\n$u_N = -g/h$", ha="left")
    note(normal, (1.35, 0.28), "open: $r_N = 0$")
    normal.set_title("Signorini")
    cross(tangential, (-1.8, -1.6), (1.8, 1.6), "$u_T$", "$r_T$")
    tangential.plot([-1.5, 0., 0., 1.5], [0.9, 0.9, -0.9, -0.9], color=RED, linewidth=2.8)
    note(tangential, (-0.8, 1.15), "$\\mu r_N + c$")
    note(tangential, (0.75, -1.2), "slip: $r_T$ opposes $u_T$")
    note(tangential, (0.12, 0.45), "stick", ha="left")
    tangential.set_title("Coulomb")

    sketch(bodies, (-0.2, -0.6), (3.4, 2.6), "Two bodies")
    polygon(bodies, [(0.1, 1.15), (3.1, 1.15), (3.1, 2.5), (0.1, 2.5)], PALE, DARK)
    polygon(bodies, [(0.1, 0.85), (3.1, 0.85), (3.1, -0.5), (0.1, -0.5)], "#dbe7ee", DARK)
    dots(bodies, [(x, 1.15) for x in (0.1, 1.1, 2.1, 3.1)])
    dots(bodies, [(x, 0.85) for x in (0.1, 0.7, 1.6, 2.4, 3.1)], style.BLUE)
    bodies.plot([0.1, 1.1, 2.1], [1.15, 2., 1.15], color=RED, linewidth=1.6)
    arrow(bodies, (1.1, 1.15), (1.1, 1.75), RED)
    note(bodies, (1.25, 1.6), "$r_i$", RED, ha="left")
    for x, size in ((0.7, 0.32), (1.6, 0.42)):
        arrow(bodies, (x, 0.85), (x, 0.85 - size), RED)
    note(bodies, (1.75, 0.45), "$-P_{ij} r_i$", RED, ha="left")
    note(bodies, (2.3, 2.1), "Body, nodes $i$")
    note(bodies, (1.6, 0.05), "other body, nodes $j$")
    note(bodies, (1.6, -0.3), "$u = v_i - \\Sigma_j P_{ij} v_j$")


def draw_bounds(figure_axes):
    upper, lower, bracket = figure_axes
    corners = np.array([(0., 0.), (2.2, 0.2), (0.9, 1.9)])
    other = np.array([(2.2, 0.2), (3.1, 1.9), (0.9, 1.9)])
    sketch(upper, (-0.3, -0.7), (3.5, 2.3), "Upper: quadratic velocities")
    sketch(lower, (-0.3, -0.7), (3.5, 2.3), "Lower: linear stresses")
    for triangle, away in (corners, (0., 0.)), (other, (0.22, 0.08)):
        centre = triangle.mean(axis=0)
        polygon(upper, triangle, PALE, DARK)
        dots(upper, [*triangle, *(triangle + np.roll(triangle, -1, axis=0)) / 2.])
        dots(upper, triangle + 0.2 * (centre - triangle), RED, "x", 8, markeredgewidth=2.)
        apart = triangle + away
        polygon(lower, apart, PALE, DARK)
        dots(lower, apart + 0.2 * (centre - triangle), RED, "x", 8, markeredgewidth=2.)
        note(lower, centre + away, "$u_T$", style.BLUE)
    for place in (1.2, 1.65), (2.16, 0.52):
        arrow(lower, np.add(place, (-0.14, -0.09)), np.add(place, (0.2, 0.13)), style.BLUE, 1.6,
              "<|-|>")
    note(lower, (1.55, 1.32), "$w_{e,i}$", style.BLUE)
    note(upper, (1.6, -0.45), "strain admissible at the vertices (×),\nthus everywhere", fontsize=10)
    note(lower, (1.6, -0.45), "strength at the vertices (×), tractions\ncontinuous at the ends of edges",
         fontsize=10)
    n = np.linspace(1., 8., 100)
    bracket.fill_between(n, 1. - 0.35 / n, 1. + 0.3 / n, color=style.BLUE, alpha=0.13)
    bracket.plot(n, 1. + 0.3 / n, color=RED, linewidth=2.)
    bracket.plot(n, 1. - 0.35 / n, color=GREEN, linewidth=2.)
    bracket.axhline(1., color=DARK, linestyle="--", linewidth=1.2)
    note(bracket, (2.6, 1.17), "$\\lambda^+$, from a velocity", RED, ha="left")
    note(bracket, (2.6, 0.8), "$\\lambda^-$, from a stress", GREEN, ha="left")
    note(bracket, (1.35, 1.01), "$\\lambda_{lim}$", va="bottom")
    bracket.set(title="The limit load is between", xlabel="number of triangles →",
                ylabel="load factor", xticks=[], yticks=[], ylim=(0.6, 1.35))


# Name of the figure: what draws it, rows and columns of its axes, size (inches).
FIGURES = {"cone": (draw_cone, (1, 2), (9.6, 4.9)),
           "return_map": (draw_return_map, (1, 1), (7.6, 4.0)),
           "incremental_problem": (draw_incremental, (1, 3), (11., 3.9)),
           "elements": (draw_elements, (2, 3), (6.6, 4.9)),
           "transfer": (draw_transfer, (1, 4), (12.5, 3.2)),
           "contact": (draw_contact, (1, 4), (13., 3.8)),
           "bounds": (draw_bounds, (1, 3), (12., 3.9))}


def main():
    """Draws all figures, or those that are named."""
    # The same bytes in each run.
    matplotlib.rcParams.update({"svg.hashsalt": "geocone", "axes.grid": False})
    for name in sys.argv[1:] or FIGURES:
        draw, shape, size = FIGURES[name]
        figure, axes = style.subplots(*shape, figsize=size)
        draw(axes)
        figure.savefig(pathlib.Path(__file__).with_name(f"{name}.svg"),
                       metadata={"Date": None, "Creator": None})


if __name__ == "__main__":
    main()
