# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""reliability.png: the fraction of samples, by weight, that fail, between certified limits, against the
number of samples; sample.png: the strength of a sample that fails, and its mechanism."""

import numpy as np

from geocone.plots import overlay
from geocone.plots.answer import heading
from geocone.plots.seepage import Mesh
from geocone.style import BLUE, Skipped, add_bar, panels, save, subplots

FACTORS = {"cohesion_factor": "cohesion over its mean (-)",
           "tan_phi_factor": "tan(phi) over its mean (-)",
           "unit_weight_factor": "unit weight over its mean (-)"}


def draw_fraction(run, path):
    """Draws the weighted fraction of samples that fail: at least those that are certified to,
    at most those and the undecided ones; and the limits of the probability at the end."""
    table = run.table("samples")
    verdict = table["verdict (-)"]
    if not len(verdict):
        raise Skipped("there is no sample")
    n = np.arange(1, len(verdict) + 1)
    weight = table["weight (-)"]
    least, most = (np.cumsum(np.where(counted, weight, 0.)) / n
                   for counted in (verdict < 0, verdict <= 0))
    found = run.summary["reliability"]
    figure, axes = subplots(figsize=(7., 4.6))
    axes.axhspan(found["limit_lower"], found["limit_upper"], color="black", alpha=0.12,
                 linewidth=0., label=f"{found['limit_lower']:.3g} <= P <= "
                 f"{found['limit_upper']:.3g}, confidence {found['confidence']:g}")
    axes.fill_between(n, least, most, step="mid", color=BLUE, alpha=0.35, linewidth=0.)
    for values, style, words in ((least, "-", "fail"), (most, "--", "fail or are undecided")):
        axes.plot(n, values, style, color=BLUE, linewidth=1.3, label=words)
    axes.set(title=f"{heading(run)}: {found['failed']} of {found['samples']} samples fail, "
             f"{found['undecided']} are undecided", xlabel="number of samples (-)",
             ylabel="weighted fraction of samples (-)" if np.any(weight != 1.) else
             "fraction of samples (-)", xlim=(1, max(n[-1], 2)))
    axes.set_ylim(bottom=0.)
    axes.legend()
    save(figure, run, path)


def draw_sample(run, path):
    """Draws the random factors of a sample that fails, with its velocities."""
    field, = run.states("sample")
    names = [name for name in FACTORS if name in field.data]
    if not names:
        raise Skipped("nothing is random in the sample")
    mesh = Mesh(field)
    velocity = np.stack([mesh.at_nodes(values)
                         for values in field.data["velocity"][:, :2].T], axis=1)
    most = np.linalg.norm(velocity, axis=1).max()
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    figure, all_axes = panels(len(names), (low, high))
    for axes, name in zip(all_axes, names):
        values = field.data[name][field.cells[:, 0], 0]
        drawn = axes.tripcolor(mesh.triangles(), facecolors=values, cmap="YlGnBu")
        add_bar(axes, drawn, FACTORS[name])
        overlay.draw_scene(axes, run, field)
        overlay.draw_arrows(axes, mesh.points, velocity, most)
        axes.set_title(f"{heading(run)}\nsample {field.time:g}: mechanism of its upper bound")
    save(figure, run, path, cropped=True)


def pictures(_run):
    """Drawing functions of the pictures of a reliability analysis, by name."""
    return {"reliability.png": draw_fraction, "sample.png": draw_sample}
