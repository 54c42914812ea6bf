#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/images/paper_cone.png: figures 1 and 2 of Guillet et al. (2025), the yield
cone with its plastic flow, and the change of variable with the dual cone.

No formula of the law stands here: stresses and plastic strain increments are those of
return_map(), borders of sets are where yield_function() and dual_violation() change
sign, and the change of variable is psi(), all of cone/second_order_cone.h, which a
small program includes; CXX compiles it (default: c++), EIGEN is the folder of Eigen."""

import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from geocone import style  # noqa: E402

PHI, COHESION, NU = 30., 10., 0.3  # degrees, kPa
G = 40.  # kPa: strains of the order of one, to be seen beside stresses
K = 2. * G / (1. - 2. * NU)  # 2 (lambda + G)

# Reads vectors (x_n, x_t) in cone axes. Prints of each the yield function; the stress s
# to which it returns as a trial stress; z, from s = t + D z; y = Psi(z); the natural
# map of s and y; and how far x and Psi(x) are outside of the dual cone.
PROGRAM = r"""
#include <geocone/cone/second_order_cone.h>
#include <cstdio>
#include <cstdlib>

using namespace geocone;

int
main(int, char **argv)
{
  const double   K = std::atof(argv[4]), two_G = std::atof(argv[5]);
  const FlowCone cone{std::atof(argv[1]), std::atof(argv[2]), std::atof(argv[3])};
  for (Mandel x = Mandel::Zero(), s; std::scanf("%lf %lf", &x[0], &x[1]) == 2;)
    {
      return_map<Mandel, MandelMatrix>(cone, K, two_G, x, s, nullptr);
      Mandel z = s - x;
      z[0] /= K;
      z[1] /= two_G;
      const Mandel y = cone.psi(z);
      std::printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n",
                  cone.yield_function(x), s[0], s[1], z[0], z[1], y[0], y[1],
                  natural_map(cone, s, y, two_G).norm(), cone.dual_violation(x),
                  cone.dual_violation(cone.psi(x)));
    }
}
"""


class Law:
    """The law of the code for a dilatancy angle, at points of the plane (x_n, x_t)."""

    def __init__(self, program, theta):
        # Apertures and radius are those of doc/theory/cone.md.
        a, b = np.sin(np.radians([PHI, theta]))
        self.call = [program, *map(repr, map(float, (
            a, b, np.sqrt(2.) * COHESION * np.cos(np.radians(PHI)), K, 2. * G)))]

    def at(self, x):
        """{name: array} at points, an array whose last axis has two entries."""
        x = np.asarray(x, dtype=float)
        text = "\n".join(f"{n!r} {t!r}" for n, t in x.reshape(-1, 2).tolist())
        output = subprocess.run(self.call, input=text, text=True, check=True,
                                stdout=subprocess.PIPE).stdout
        v = np.array([line.split() for line in output.splitlines()], dtype=float)
        shape = x.shape[:-1]
        result = {name: v[:, i:i + 2].reshape(*shape, 2)
                  for name, i in (("s", 1), ("z", 3), ("y", 5))}
        for name, i in (("yield", 0), ("natural map", 7), ("dual", 8), ("flow", 9)):
            result[name] = v[:, i].reshape(shape)
        return result


def compiled(folder):
    """The program."""
    source, program = folder / "cone.cc", folder / "cone"
    source.write_text(PROGRAM)
    subprocess.run([os.environ.get("CXX", "c++"), "-std=c++17", "-O1",
                    "-I", ROOT / "include",
                    "-I", os.environ.get("EIGEN", "/usr/include/eigen3"),
                    source, "-o", program], check=True)
    return str(program)


def grid(low, high, n=161):
    """Places, and the same as points for Law.at()."""
    n_axis, t_axis = (np.linspace(low[i], high[i], n) for i in range(2))
    return n_axis, t_axis, np.stack(np.meshgrid(n_axis, t_axis), axis=-1)


def border(axes, low, high, value, color, name, fill=True):
    """Draws the set where a function of points is not positive, and its border."""
    n_axis, t_axis, points = grid(low, high)
    values = value(points)
    if fill:
        axes.contourf(n_axis, t_axis, values, levels=[-1e9, 0.], colors=[color],
                      alpha=0.16)
    axes.contour(n_axis, t_axis, values, levels=[0.], colors=[color], linewidths=1.8)
    axes.plot([], [], color=color, label=name)


def arrow(axes, start, step, color, width=2.):
    axes.annotate("", xy=np.add(start, step), xytext=start, zorder=4,
                  arrowprops={"arrowstyle": "-|>", "color": color, "lw": width,
                              "shrinkA": 0., "shrinkB": 0.})


def trials(places):
    """Trial stresses at places above the axis, and as far below it."""
    return np.array([(n, sign * t) for n, t in places for sign in (1., -1.)])


def stresses(axes, law, associated, title):
    """The cone C, trial stresses, and the plastic strain where they return."""
    low, high = (-40., -40.), (50., 40.)
    border(axes, low, high, lambda x: law.at(x)["yield"], style.BLUE,
           "C, admissible stress")
    # K is C with its tip, where the hydrostatic tension returns, at the origin.
    tip = law.at([[-1e3, 0.]])["s"][0]
    border(axes, low, high, lambda x: law.at(x + tip)["yield"], style.ORANGE,
           "K = C + (k/a) n", fill=False)
    t = trials([(-3., 24.), (17., 30.), (-33., 3.)])
    of = law.at(t)
    assert of["natural map"].max() < 1e-12, of["natural map"]
    scale = 15. / np.linalg.norm(of["z"], axis=1).max()
    for place, stress, z, y in zip(t, of["s"], of["z"], of["y"]):
        axes.plot(*zip(place, stress), ":", color="#505050", linewidth=1.2)
        axes.plot(*place, "o", color="#505050", markersize=4)
        arrow(axes, stress, -scale * z, style.COLORS[2])
        if not associated:
            arrow(axes, stress, -scale * y, style.COLORS[1])
        axes.plot(*stress, "o", color="black", markersize=4, zorder=5)
    axes.plot([], [], "o:", color="#505050", markersize=4,
              label="trial stress t, returns to s")
    axes.plot([], [], color=style.COLORS[2],
              label="plastic strain, −z" + (", normal to C" if associated else ""))
    if not associated:
        axes.plot([], [], color=style.COLORS[1], label="−y = −Ψ(z), normal to C")
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal",
             title=title, xlabel="$s_n$ (kPa), compression →", ylabel="$s_t$ (kPa)")


def strains(axes, law, title):
    """The cones of z and of y = Psi(z), and what the change of variable does."""
    low, high = (-0.14, -0.34), (0.625, 0.34)
    # The violation is zero in all of the set: its border is where, seen from a step
    # further along -n, it is that step.
    step = 0.02
    for name, color, label in (("dual", style.ORANGE, "K*, dual cone: all y"),
                               ("flow", style.COLORS[2], "all z: Ψ(z) in K*")):
        border(axes, low, high,
               lambda x, name=name: law.at(x - np.array([step, 0.]))[name] - step,
               color, label, fill=name == "dual")
    # Stresses that return to the smooth cone, and, beyond the tip, to the tip.
    t = trials([(-5., 26.), (10., 40.), (-70., 6.), (-55., 13.), (-34., 18.)])
    of = law.at(t)
    for z, y in zip(of["z"], of["y"]):
        arrow(axes, z, y - z, "#505050", 1.4)
        axes.plot(*z, "o", color=style.COLORS[2], markersize=5, zorder=5)
        axes.plot(*y, "o", color=style.COLORS[1], markersize=5, zorder=5)
    axes.plot([], [], "o", color=style.COLORS[2], label="z of return maps")
    axes.plot([], [], "o", color=style.COLORS[1], label="y = Ψ(z): moved along n")
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal",
             title=title, xlabel="$z_n$, $y_n$ (volume grows →)", ylabel="$z_t$, $y_t$")
    print(f"y outside of K* by {law.at(of['y'])['dual'].max():.1e} at most; "
          f"natural map {of['natural map'].max():.1e} kPa at most")


def main():
    theta = 10.
    figure, axes = style.subplots(1, 3, figsize=(15.5, 6.))
    with tempfile.TemporaryDirectory() as folder:
        program = compiled(pathlib.Path(folder))
        stresses(axes[0], Law(program, PHI), True,
                 f"Figure 1: the law, associated, φ = θ = {PHI:g}°")
        stresses(axes[1], Law(program, theta), False,
                 f"Figure 2: not associated, θ = {theta:g}°")
        strains(axes[2], Law(program, theta), "Figure 2: change of variable, dual cone")
    for one in axes:
        one.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=1)
    figure.savefig(pathlib.Path(__file__).with_suffix(".png"), dpi=110)


if __name__ == "__main__":
    main()
