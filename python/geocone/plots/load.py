# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""load_displacement.png and .svg: curves, their plateaus and references."""

import contextlib
from collections import namedtuple

import numpy as np
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from geocone.plots.answer import heading
from geocone.reader import Missing
from geocone.style import BESIDE, COLORS, GREY, ORANGE, Skipped, plain, save, subplots, unit_for

DASHES = ["-", (0, (4, 1.5)), (0, (1.5, 1))]  # of curves that share a colour

# mm, N/m or N, of the summary, s, of a limit analysis
Curve = namedtuple("Curve", "displacement load limit time marks", defaults=((),))


def marks_of(run):
    """Bounds of the load that a limit analysis of the scene proves, and its estimates: name,
    and one load or two between which it is."""
    if run.value("bounds/unit") != run.per_metre("N"):
        return []
    upper, lower = run.value("bounds/upper"), run.value("bounds/lower")
    davis = run.value("non_associated/davis_lower"), run.value("non_associated/davis_upper")
    associated = "non_associated" not in run.summary
    return [mark for mark in (
        ("certified bounds", (lower, upper)) if associated else
        ("certified upper bound", (upper,)),
        ("Davis's estimate", davis)) if None not in mark[1]]


def curve_of(run):
    """The load-displacement curve of a run."""
    if "limit_load" not in run.summary:
        raise Skipped(f"no load is observed in '{run.folder}'")
    time = np.insert(run.statistics["time (s)"], 0, 0.)
    displacement = np.insert(1e3 * run.statistics["displacement (m)"], 0, 0.)
    load = np.insert(run.statistics[f"load ({run.per_metre('N')})"], 0, 0.)
    # From rest, before the first step or where displacements are counted anew.
    first = np.flatnonzero(time <= reset_of(run) * (1. + 1e-9))[-1]
    displacement[first] = 0.
    return Curve(displacement[first:], load[first:], run.summary["limit_load"], time[first:],
                 marks_of(run))


def reset_of(run):
    """Beginning (s) of the last stage that sets displacements to zero, or 0."""
    begin = reset = 0.
    with contextlib.suppress(Missing, ValueError):
        for stage in run.parameters.get("Loading/Stages", "").split(","):
            section = f"Loading/{stage.strip()}/"
            if run.parameters.get(section + "Reset displacement") == "true":
                reset = begin
            begin += float(run.parameters.get(section + "Duration", 1.))
    return reset


def is_at_rest(curve):
    """Whether the loaded part does not move: its load is drawn against time."""
    return not curve.displacement.any()


def number(value, unit):
    """A load in a unit, which does not follow it."""
    return f"{value / unit[1]:.{0 if abs(value / unit[1]) >= 999.5 else 2}f}"


def load_text(name, value, unit, error=None):
    """A load, and its error, as the legend gives them."""
    if value is None:
        return f"{name}: not reached"
    return (f"{name}: {number(value, unit)} {unit[0].removesuffix('-')}".rstrip() +
            ("" if error is None else f" ({100. * error:+.2f} %)"))


def level_text(name, limit, unit, is_single):
    """The plateau of a curve as the legend gives it, or the peak where the load falls."""
    peak, last = limit.get("peak"), limit.get("last")
    if limit["value"] is None and peak and last is not None and abs(peak) > 1.02 * abs(last):
        return load_text("peak" if is_single else f"{name}, peak", peak, unit)
    return load_text("plateau" if is_single else name, limit["value"], unit,
                     limit["relative_error"])


def draw_lines(axes, names, curves, unit):
    """Draws curves, plateaus and references; a single plateau has its own name."""
    single = len(curves) == 1
    for i, (name, (displacement, load, limit, _, _)) in enumerate(zip(names, curves)):
        color, text = COLORS[i % len(COLORS)], level_text(name, limit, unit, single)
        # Many steps are often noisy: a thin line behind all others.
        style = ({"linewidth": 1., "zorder": 1.2} if len(load) > 61 else
                 {"marker": "o", "markersize": 3.5})
        axes.plot(displacement, load / unit[1], color=color,
                  linestyle=DASHES[i // len(COLORS) % len(DASHES)],
                  label=name if single else text, **style)
        last = displacement[np.argmax(np.abs(displacement))]
        level = {"color": ORANGE if single else color, "linewidth": 5., "alpha": 0.7,
                 "zorder": 1.5, "label": text if single else None}
        if limit["value"] is None:
            axes.plot([], [], **{**level, "alpha": 0.})
            continue
        ends = np.copysign(1e3 * limit["plateau_begins_at"], last), last
        axes.fill_between(ends, limit["band_low"] / unit[1], limit["band_high"] / unit[1],
                          color=level["color"], alpha=0.35, linewidth=0.)
        axes.plot(ends, 2 * [limit["value"] / unit[1]], solid_capstyle="butt", **level)
    references = {load_text(plain(limit["reference_name"]), limit["reference"], unit):
                  limit["reference"] for _, _, limit, _, _ in curves
                  if limit["reference"] is not None}
    for text, value in references.items():
        axes.axhline(value / unit[1], color="black", linewidth=1.2, zorder=1.8,
                     linestyle=(0, (6, 3)), label=text)


def draw_marks(axes, marks, unit):
    """Draws the results of a limit analysis: a line, or a band of two loads."""
    for (name, loads), color in zip(marks, ("#009E73", "#CC79A7")):
        if len(loads) == 1:
            axes.axhline(loads[0] / unit[1], color=color, linestyle="-.", zorder=1.7,
                         label=load_text(name, loads[0], unit))
            continue
        axes.axhspan(*(load / unit[1] for load in loads), color=color, alpha=0.45,
                     linewidth=0.8, zorder=1.1,
                     label=f"{name}: {number(loads[0], unit)} to "
                           f"{number(loads[1], unit)} {unit[0]}")


def draw_curves(names, curves, title, run, *paths):
    """Draws curves into a picture, of one run or None, and once more enlarged where
    they end close."""
    curves = list(curves)
    along = "displacement (mm)"
    if all(is_at_rest(curve) for curve in curves):
        along = "time (s)"
        curves = [curve._replace(displacement=curve.time) for curve in curves]
    single, ends = len(curves) == 1, [curve.limit[key] for curve in curves
                                      for key in ("band_low", "band_high", "reference")]
    loads = np.concatenate([*(curve.load for curve in curves), [e for e in ends if e]])
    size = np.max(np.abs(loads))
    unit = unit_for(size, {curve.limit.get("unit", "N/m") for curve in curves}.pop())
    figure, axes = subplots(figsize=(7. if single else 9.5, 4.6))
    draw_lines(axes, names, curves, unit)
    if all(curve.marks == curves[0].marks for curve in curves):
        draw_marks(axes, curves[0].marks, unit)
    origin, = axes.plot(0., 0., " ")  # the axes begin there
    origin.sticky_edges.x.append(0.)
    origin.sticky_edges.y.append(0.)
    axes.margins(x=0.03, y=0.07)
    axes.set(title=title, xlabel=along, ylabel=f"load{' factor' * (unit[0] == '-')} ({unit[0]})")
    place = "best"
    if None not in ends and 0. < np.ptp(ends) < 0.12 * size:
        place = "lower right" if loads.mean() > 0. else "upper right"
        zoom = axes.inset_axes([0.45, 0.36, 0.52, 0.38])
        draw_lines(zoom, names, curves, unit)
        margin = 0.25 * np.ptp(ends)
        zoom.set(xlim=axes.get_xlim(), ylim=((min(ends) - margin) / unit[1],
                                             (max(ends) + margin) / unit[1]))
        zoom.tick_params(labelsize=9)
        zoom.yaxis.set_major_locator(MaxNLocator(4))
    handles = axes.get_legend_handles_labels()[0]
    if any(curve.limit["value"] is not None for curve in curves):
        handles.append(Patch(color=ORANGE if single else GREY, alpha=0.35, linewidth=0.,
                             label="least to greatest load of the plateau"))
    axes.legend(handles=handles, **({"loc": place} if single else
                                    {**BESIDE, "title": "limit load"}))
    save(figure, run, *paths)


def draw_run(run, path):
    """Draws the curve of a run, a .png also as .svg."""
    paths = [path, path.with_suffix(".svg")] if path.suffix == ".png" else [path]
    size = run.summary["size"]
    draw_curves([plain(f"load, {size['cells']} {size['element']} cells")],
                [curve_of(run)], heading(run), run, *paths)
