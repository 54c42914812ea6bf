#!/usr/bin/env python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/cookbook/contact_cases.png of runs of prm/contact/incline.prm, hertz.prm, cattaneo.prm
and trapdoor.prm, in this order, with the exact solutions documented in these files, and
prints the errors of the computed values:

    contact_cases.py INCLINE HERTZ CATTANEO TRAPDOOR

Tractions are stresses of the integration points next to the surface."""

import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import geocone  # noqa: E402
from geocone import style  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

A, P0 = 0.1, 6.366198  # half-width (m) and greatest pressure (MPa) of Hertz
C = A * np.sqrt(0.5)  # half-width of the part that sticks, of Cattaneo (m)


def ellipse(x, a):
    """sqrt(1 - x^2/a^2), 0 outside."""
    return np.sqrt(np.maximum(1. - (x / a)**2, 0.))


def surface(run, name):
    """x (m) and a stress (MPa) of the points next to the surface y = 0."""
    field = run.fields("points")
    x, y = field.points[:, 0], field.points[:, 1]
    cell = float(run.parameters["Mesh/Smallest size"])
    near = (y > -0.2 * cell) & (np.abs(x) < 1.6 * A)
    order = np.argsort(x[near])
    return x[near][order], field.point_data[name][near][order] / 1e6


def draw_incline(axes, run):
    t = run.statistics["time (s)"]
    v = np.sqrt(2. * run.statistics["kinetic energy (J/m)"] / 40.)
    axes.plot(t, 2.356287 * t, "k--", label="exact: 2.3563 m/s$^2$ t")
    axes.plot(t[::5], v[::5], "o", color=style.BLUE, markersize=4, label="computed")
    axes.set(title="incline", xlabel="t (s)", ylabel="velocity of the block (m/s)",
             xlim=(0., None), ylim=(0., None))
    axes.legend()
    print(f"incline: acceleration {v[-1] / t[-1] / 2.356287 - 1.:+.1e}")


def draw_pressure(axes, run):
    x, p = surface(run, "stress_yy")
    fine = np.linspace(0., 1.6 * A, 400)
    axes.plot(1e3 * fine, P0 * ellipse(fine, A), "k--", label="exact (Hertz)")
    axes.plot(1e3 * x, -p, "o", color=style.BLUE, markersize=3, label="computed")
    axes.set(title="hertz", xlabel="x (mm)", ylabel="pressure (MPa)", xlim=(0., 160.),
             ylim=(0., None))
    axes.legend()
    inside = x < 0.9 * A
    error = -p[inside] - P0 * ellipse(x[inside], A)
    slope, square = np.polyfit(x[inside]**2, p[inside]**2, 1)
    print(f"hertz: half-width of the ellipse that fits the pressure within 0.9 a: "
          f"{1e3 * np.sqrt(-square / slope):.2f} mm")
    print(f"hertz: pressure within 0.9 a: root mean square error "
          f"{100. * np.sqrt(np.mean(error**2)) / P0:.2f} % of the greatest; "
          f"half-width {run.value('contact/width_m')} m")


def draw_shear(axes, run):
    x, q = surface(run, "stress_xy")
    q = q * np.sign(q[np.argmax(np.abs(q))])
    fine = np.linspace(-1.6 * A, 1.6 * A, 800)
    axes.axvspan(-1e3 * C, 1e3 * C, color="#e8f1f8", label="sticks (exact)")
    axes.plot(1e3 * fine, P0 * (ellipse(fine, A) - C / A * ellipse(fine, C)), "k--",
              label="exact (Cattaneo, Mindlin)")
    axes.plot(1e3 * x, q, "o", color=style.BLUE, markersize=3, label="computed")
    axes.set(title="cattaneo", xlabel="x (mm)", ylabel="shear traction (MPa)",
             xlim=(-160., 160.), ylim=(0., 7.6))
    axes.legend(ncols=1, loc="upper center")
    exact = P0 * (ellipse(x, A) - C / A * ellipse(x, C))
    inside = np.abs(x) < 0.9 * A
    print(f"cattaneo: shear within 0.9 a: root mean square error "
          f"{100. * np.sqrt(np.mean((q - exact)[inside]**2)) / 4.501582:.2f} % of the greatest; "
          f"half-widths {run.value('contact/width_m') / 2.} and "
          f"{run.value('contact/stick_width_m') / 2.} m")


def draw_trapdoor(axes, run):
    u, load = (np.insert(np.abs(run.statistics[name]), 0, start) for name, start in
               (("displacement (m)", 0.), ("load (N/m)", np.nan)))
    axes.axhline(31.547, color="k", linestyle="--", label="31.547 kN/m (Murray, Geddes)")
    axes.plot(1e3 * u, load / 1e3, "o-", color=style.BLUE, markersize=4, label="computed")
    axes.set(title="trapdoor, lifted", xlabel="displacement of the door (mm)",
             ylabel="load on the door (kN/m)", xlim=(0., None), ylim=(0., 36.))
    axes.legend(loc="lower right")
    print(f"trapdoor: {load[-1] / 31547. - 1.:+.2%}")


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    figure = Figure(figsize=(10.4, 7.2), layout="constrained")
    for axes, draw, folder in zip(figure.subplots(2, 2).flat,
                                  (draw_incline, draw_pressure, draw_shear, draw_trapdoor),
                                  sys.argv[1:]):
        draw(axes, geocone.read(folder))
    figure.savefig(ROOT / "doc" / "cookbook" / "contact_cases.png", dpi=95)


if __name__ == "__main__":
    main()
