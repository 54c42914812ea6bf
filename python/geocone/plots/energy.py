# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""energy.png: where the energy goes, and what the time steps take."""

import numpy as np

from geocone.style import (BESIDE, BLUE, COLORS, ORANGE, Skipped, plain, save, subplots,
                           unit_for)

# Columns of statistics.csv, and how they are drawn.
IMPLICIT = {
    "kinetic energy": {"color": BLUE}, "elastic energy": {"color": "#009E73"},
    "potential energy": {"color": "#CC79A7",
                         "label": "potential energy\n(above its least)"},
    "plastic dissipation": {"color": "#D55E00"},
    "external work": {"color": ORANGE},
    "removed energy": {"color": "#505050"},
    "total energy": {"color": "black", "linestyle": (0, (6, 3))}}
EXPLICIT = {
    "kinetic energy": {"color": BLUE},
    "gravity work": {"color": "#CC79A7",
                     "label": "released potential\nenergy (gravity work)"},
    "stress work": {"color": "#D55E00"},
    "damping work": {"color": "#009E73", "label": "damping"},
    "seepage work": {"color": "#009E73", "linestyle": ":", "label": "flow of pore water"},
    "support work": {"color": ORANGE, "label": "work of the supports"},
    "stopped energy": {"color": "#56B4E9", "label": "stopped kinetic energy"},
    "removed kinetic energy": {"color": "#505050"}}


def energies_of(run, looks):
    """The energies of a run that are not zero throughout, by name (J/m, or J)."""
    table, unit = run.statistics, run.per_metre("J")
    found = {name: table[f"{name} ({unit})"] for name in looks
             if np.any(table.get(f"{name} ({unit})", 0.))}
    if not found:
        raise Skipped("all energies are zero")
    return found


def draw_energies(run, time, energies, looks):
    """The figure with the upper panel; the lower one is returned too."""
    figure, (axes, below) = subplots(2, 1, figsize=(9., 6.2), sharex=True,
                                     gridspec_kw={"height_ratios": [3., 2.]})
    unit = unit_for(np.max(np.abs([*energies.values()])), run.per_metre("J"))
    for name, values in energies.items():
        axes.plot(time, values / unit[1], **{"label": name, **looks[name]})
    axes.set(title=f"{plain(run.name)}: energies", ylabel=f"energy ({unit[0]})")
    axes.legend(**BESIDE)
    return figure, below


def draw_rest(axes, run, time, values, name, whole, of_what):
    """The lower panel: what is left, and what part of the whole that is."""
    unit = unit_for(np.max(np.abs(values)), run.per_metre("J"))
    axes.plot(time, values / unit[1], color=COLORS[-1])
    axes.set(xlabel="time (s)", ylabel=f"{name} ({unit[0]})")
    if whole > 0.:
        percent = 100. * unit[1] / whole
        axes.secondary_yaxis("right", functions=(lambda y: y * percent,
                                                 lambda y: y / percent)
                             ).set_ylabel(f"% of the {of_what}")


def draw_implicit(run, path):
    """Draws the energies of an implicit run, and its numerical loss."""
    table, unit = run.statistics, run.per_metre("J")
    if f"numerical loss ({unit})" not in table:
        raise Skipped("statistics.csv has no energies")
    time, loss = table["time (s)"], table[f"numerical loss ({unit})"]
    energies = energies_of(run, IMPLICIT)
    # The zero of a height is arbitrary: the least potential energy is taken.
    potential = energies.get("potential energy", np.zeros_like(time))
    for name in {"potential energy", "total energy"} & energies.keys():
        energies[name] = energies[name] - potential.min()
    energy = run.summary.get("energy", {})
    initial = energy.get(f"initial_{unit.replace('/', '_per_')}", 0.) - potential[0]
    whole, name = max((potential[0] - potential.min(), "released\npotential energy"),
                      (np.abs(table[f"external work ({unit})"]).max(), "\nexternal work"),
                      (initial, "\ninitial energy"))
    figure, below = draw_energies(run, time, energies, IMPLICIT)
    draw_rest(below, run, [0., *time], np.array([0., *loss]), "loss", whole, name)
    below.set_title("numerical loss")
    save(figure, run, path)


def draw_explicit(run, path):
    """Draws the energies of an explicit run, and its numerical loss."""
    time, energies = run.statistics["time (s)"], energies_of(run, EXPLICIT)
    loss = run.statistics.get(f"numerical loss ({run.per_metre('J')})",
                              np.zeros_like(time))
    largest = max(np.max(np.abs(values)) for values in energies.values())
    energies = {name: values for name, values in energies.items()
                if np.max(np.abs(values)) > 1e-4 * largest}
    figure, below = draw_energies(run, time, energies, EXPLICIT)
    draw_rest(below, run, time, loss, "loss", largest, "largest\nenergy above")
    below.axhline(0., color="black", linewidth=0.8)
    below.set_title("numerical loss (taken by time steps and transfer)")
    save(figure, run, path)
