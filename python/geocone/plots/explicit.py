# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of explicit runs:
  energy.png      statistics.csv: where the energy goes, and what the integration takes
  points.png      points-*.vtu at up to six times: plastic strain, or shear stress
  structure.png   the same: the ratio Rb of the structure, of soils that have one
  loading.png     the same: the ratio R of the subloading surface
  excess_pore_pressure.png  the same: of soil whose pore water flows
  runout.png      statistics.csv: how far and how high the body reaches
  slide.png       points-*.vtu: what has moved, of a body whose outline stays
"""

import functools

import numpy as np
from matplotlib.colors import Normalize

from geocone.plots.energy import draw_explicit
from geocone.plots.point_values import level_of, states_at, strain_or_shear, values_of
from geocone.plots.points import draw_panels, look_at
from geocone.plots.pressures import NAME as PRESSURE
from geocone.reader import Missing, ReadError
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


def draw_slide(run, path):
    """Draws in time how far the points have moved that moved most, and from where to
    where those are that have moved by more than 5 % of the body's height."""
    series = run.times("points")
    fields = run.states("points", tuple(range(len(series))))
    if not fields or any("displacement" not in field.data for field in fields):
        raise Skipped("its points have no displacements")
    moved = [np.linalg.norm(field.data["displacement"], axis=1) for field in fields]
    farthest = np.array([np.max(distance) for distance in moved])
    # Displacements may be counted from the start of a stage: from the last one on.
    first = max(np.flatnonzero(np.diff(farthest) < 0.) + 1, default=0)
    height = np.ptp(fields[first].points[:, 1])
    reach = [(np.min(x), np.max(x)) if len(x) else (np.nan, np.nan)
             for x in (field.points[distance > 0.05 * height, 0]
                       for field, distance in zip(fields, moved))]
    if len(series) - first < 2 or not np.any(np.isfinite(reach[first:])):
        raise Skipped("nothing slides")
    edge, front = np.array(reach[first:]).T
    figure, (above, below) = subplots(2, 1, figsize=(8., 6.), sharex=True)
    above.plot(series[first:], farthest[first:], color=COLORS[0])
    above.set(title=f"{plain(run.name)}: slide", ylabel="largest displacement (m)")
    below.plot(series[first:], front, color=COLORS[0], label="front")
    below.plot(series[first:], edge, color=COLORS[1], label="edge")
    below.set(xlabel="time (s)", ylabel="x of what has moved (m)")
    below.legend(**BESIDE)
    save(figure, run, path)


def taken_away_at(run):
    """When the first points were taken away (s), or None, also where it is not known."""
    try:
        table = run.statistics
    except Missing:
        return None
    removed = table.get(f"removed mass ({run.per_metre('kg')})", np.zeros(1))
    return table["time (s)"][np.argmax(removed > 0.)] if np.any(removed > 0.) else None


def snapshots_of(run, times):
    """The fields at the wanted times or at up to six. Of a body of which a part is taken
    away one is before that, and the others follow."""
    series = run.times("points")
    if not len(series):
        raise Skipped("there are no points")
    if not times:
        cut = taken_away_at(run)
        before = series[series < cut][-1:] if cut is not None else []
        after = series[series >= cut] if cut is not None else series
        times = [*before, *np.linspace(*after[[0, -1]], 6 - len(before))] \
            if len(after) else series
    return states_at(run, times)


def look_of(fields, values):
    """The look of the points of a body that moves."""
    return look_at(fields, values, lambda size: 0.1 * np.max(size))


def draw_points(run, path, times=None):
    """Draws plastic strain or, of an elastic body, shear stress."""
    fields = snapshots_of(run, times)
    values, label, norm, extend = strain_or_shear(run, fields)
    draw_panels(run, path, fields, look_of(fields, values), values, norm, label,
                extend=extend)


def draw_ratio(run, path, names, label, least, times=None):
    """Draws a ratio, between a least value and one or more, that some soils show."""
    fields = snapshots_of(run, times)
    values = values_of(fields, *names)
    if values is None or not np.any(np.isfinite(np.concatenate(values))):
        raise Skipped(f"its points have no {names[0]}")
    most = level_of(fields, values)
    draw_panels(run, path, fields, look_of(fields, values), values,
                Normalize(least, max(1., most) if most > least + 1e-3 else least + 1.),
                label, RATIOS, extend="max" if most > 1. else "neither")


def draw_pressure(run, path, times=None):
    """Draws the excess pore pressure."""
    fields = snapshots_of(run, times)
    values = [field.data[PRESSURE][:, 0] * run.mass_unit / 1e3 for field in fields]
    most = level_of(fields, [np.abs(pressure) for pressure in values])
    if most == 0.:
        raise Skipped("there is no excess pore pressure")
    draw_panels(run, path, fields, look_of(fields, values), values, Normalize(-most, most),
                "excess pore pressure (kPa)", "RdBu_r", extend="both")


def pictures(run, times=None):
    """Drawing functions of the pictures of an explicit run, by name."""
    found = {"energy.png": draw_explicit, "runout.png": draw_runout,
             "points.png": functools.partial(draw_points, times=times)}
    try:
        if taken_away_at(run) is not None:
            found["slide.png"] = draw_slide
        known = set(snapshots_of(run, times)[0].data)
    except (ReadError, Skipped):  # reported where points.png is drawn
        known = set()
    if PRESSURE in known:
        found["excess_pore_pressure.png"] = functools.partial(draw_pressure, times=times)
    for name, (names, label, least) in SOILS.items():
        if known & set(names):
            found[name] = functools.partial(draw_ratio, names=names, label=label,
                                            least=least, times=times)
    return found
