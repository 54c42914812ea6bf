# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of explicit runs:
  energy.png      statistics.csv: where the energy goes, and what the integration takes
  points.png      points-*.vtu at up to six times: plastic strain, or shear stress
  structure.png   the same: the ratio Rb of the structure, of soils that have one
  loading.png     the same: the ratio R of the subloading surface
  runout.png      statistics.csv: how far and how high the body reaches
"""

import functools

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from geocone.plots.energy import draw_explicit
from geocone.plots.points import (SHEAR, STRAIN, draw_panels, shear_stress, states_at,
                                  values_of, view_of)
from geocone.reader import ReadError
from geocone.style import BESIDE, COLORS, RATIOS, Skipped, plain, save, subplots

OUTLINE = (  # columns of statistics.csv, in words, their colours and lines
    ("x of 99 % of the mass (m)", "x of 99 % of the mass", 0, "-"),
    ("x largest (m)", "x of the farthest point", 0, ":"),
    ("x of 1 % of the mass (m)", "x of 1 % of the mass", 2, "-"),
    ("y largest (m)", "y of the highest point", 1, "-"))
# Names of fields, the first that is there; in words; the least value.
SOILS = {"structure.png": (("structure_ratio", "Rb"), "structure ratio Rb (-)", 1.),
         "loading.png": (("subloading_ratio", "R"), "subloading ratio R (-)", 0.)}


def draw_runout(run, path):
    """Draws how far and how high the body reaches in time."""
    table = run.statistics
    lines = [(table[key], label, COLORS[color], style)
             for key, label, color, style in OUTLINE
             if key in table and np.ptp(table[key]) > 0.]
    size = max((np.max(np.abs(values)) for values, *_ in lines), default=0.)
    lines = [line for line in lines if np.ptp(line[0]) > 0.01 * size]
    if not lines:
        raise Skipped("the outline of the body does not move")
    figure, axes = subplots(figsize=(8., 4.6))
    for values, label, color, style in lines:
        axes.plot(table["time (s)"], values, color=color, linestyle=style, label=label)
    axes.set(title=f"{plain(run.name)}: reach of the body", xlabel="time (s)",
             ylabel="coordinate (m)")
    axes.legend(**BESIDE)
    save(figure, run, path)


def snapshots_of(run, times):
    """The fields at the wanted times or at up to six, and the box of their points."""
    series = run.times("points")
    if not len(series):
        raise Skipped("there are no points")
    fields = states_at(run, times or np.linspace(series[0], series[-1], 6))
    return fields, view_of(fields, lambda size: 0.1 * np.max(size))


def draw_points(run, path, times=None):
    """Draws plastic strain or, of an elastic body, shear stress."""
    fields, view = snapshots_of(run, times)
    values = values_of(fields, STRAIN)
    if values is not None and np.any(np.concatenate(values) > 0.):
        everything = np.concatenate(values)
        most = np.quantile(everything[everything > 0.], 0.99)
        draw_panels(run, path, fields, view, values, LogNorm(1e-3 * most, most),
                    "cumulative plastic strain (-)", extend="both")
        return
    values = shear_stress(fields)
    most = np.quantile(np.concatenate(values), 0.995)
    draw_panels(run, path, fields, view, values,
                Normalize(0., max(most, np.finfo(float).tiny)), SHEAR, extend="max")


def draw_ratio(run, path, names, label, least, times=None):
    """Draws a ratio, between a least value and one or more, that some soils show."""
    fields, view = snapshots_of(run, times)
    values = values_of(fields, *names)
    if values is None or not np.any(np.isfinite(np.concatenate(values))):
        raise Skipped(f"its points have no {names[0]}")
    most = np.nanquantile(np.concatenate(values), 0.995)
    draw_panels(run, path, fields, view, values,
                Normalize(least, max(1., most) if most > least + 1e-3 else least + 1.),
                label, RATIOS, extend="max" if most > 1. else "neither")


def pictures(run, times=None):
    """What draws each picture of an explicit run, by its name."""
    found = {"energy.png": draw_explicit, "runout.png": draw_runout,
             "points.png": functools.partial(draw_points, times=times)}
    try:
        known = set(snapshots_of(run, times)[0][0].data)
    except (ReadError, Skipped):  # told where points.png is drawn
        known = set()
    for name, (names, label, least) in SOILS.items():
        if known & set(names):
            found[name] = functools.partial(draw_ratio, names=names, label=label,
                                            least=least, times=times)
    return found
