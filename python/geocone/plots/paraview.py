# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""paraview_state.py: a script that opens the fields of a run in ParaView and shows what
the pictures show. Files, arrays and ranges of colours are found here, of the last
state; ParaView needs nothing of this package."""

import os
import pprint
from pathlib import Path

import numpy as np

from geocone.files import write_listed
from geocone.plots.point_values import STRAIN, level_of
from geocone.reader import Missing
from geocone.style import SHOWN, Skipped

NAME = "paraview_state.py"
TEMPLATE = Path(__file__).with_name(NAME)
PLACE = "RUN = None  # replaced by scripts/plot\n"
WARPED = 0.05  # of the body's size is the largest displacement shown, or more if it is

# Arrays by which a series is coloured, and down to which part of the largest value, by
# the logarithm; of those of a view the first that is not zero.
RATE = ("plastic_strain_rate", "plastic strain rate (1/s)", SHOWN)
STRAINS = (STRAIN, "plastic strain (-)", 1e-3)
STRESS = ("stress_yy", "stress yy (Pa)", None)
VELOCITY = ("velocity", "velocity (m/s)", None)
VIEWS = {
    "points": [[STRAINS, STRESS], [RATE, VELOCITY]],
    "cells": [[RATE, STRAINS, STRESS], [("displacement", "displacement (m)", None),
                                        VELOCITY]],
    "seepage": [[("pore_pressure", "pore pressure (Pa)", None)],
                [("seepage_velocity", "Darcy velocity (m/s)", None)]],
    "bounds": [[("part_of_gap", "part of the gap, over the mean (-)", 1e-2)],
               [("velocity", "velocity, upper bound (-)", None)]]}


def series_of(run):
    """The main series of a run: points only if they move.
    @throw Missing if there are no fields"""
    for series in ("bounds", "seepage", "points", "cells"):
        try:
            field, = run.states(series)
        except Missing:
            continue
        if series != "points" or "displacement" in field.data:
            return series, field
    raise Missing("there are no fields")


def magnitude(values):
    """Of vectors the magnitude, of numbers themselves."""
    return np.linalg.norm(values, axis=1) if values.shape[1] > 1 else values[:, 0]


def range_of(field, values, part, vector):
    """The range of the colours: of vectors from zero, and a few values, as of points that
    fly or of sand at an edge, are beyond."""
    if part is not None:
        most = float(level_of([field], [values]))
        return [part * most, most]
    low, high = map(float, np.quantile(values, [0.005, 0.995]))
    if vector:
        low = 0.
    margin = 0. if high > low else 0.5 * float(np.abs(values).max())
    return [low - margin * (not vector), high + margin]


def view_of(series, field, choices):
    """Description of the view of a series; None if all of it is zero or not there."""
    for array, title, part in choices:
        if array not in field.data or not np.any(field.data[array]):
            continue
        values, dim = magnitude(field.data[array]), field.points.shape[1]
        view = {"series": series, "array": array, "title": title,
                "range": range_of(field, values, part, field.data[array].shape[1] > 1),
                "log": part is not None, "rates": part in (SHOWN, 1e-2),
                "edges": array == "part_of_gap",
                "warp": None, "factor": 1., "radius": None}
        if series == "points":
            volume = field.data.get("area", field.data["volume"])[:, 0]
            view["radius"] = 0.6 * float(np.median(volume))**(1. / dim)
        elif series == "cells" and np.any(field.data.get("displacement", 0.)):
            most = magnitude(field.data["displacement"]).max()
            size = np.ptp(field.points, axis=0).max()
            view["warp"] = "displacement"
            view["factor"] = float(max(WARPED * size / most, 1.))
        return view
    return None


def eye_of(series, field):
    """From where a body in three dimensions is looked at; nothing in the plane."""
    if field.points.shape[1] == 2:
        return []
    from geocone.plots import solid
    if series == "points":
        look = solid.SolidLook([field], [np.zeros(len(field.points))], lambda size: size)
        return look.view.towards.tolist()
    rate = field.data["dissipation" if series == "bounds" else "plastic_strain_rate"][:, 0]
    return solid.chosen_view(field.points, field.cells, rate)[0].towards.tolist()


def write_state(run, folder):
    """Writes paraview_state.py into a folder, that of the run or another one.

    @return the path
    @throw Missing if the run has no fields, Skipped if they are all zero"""
    series, field = series_of(run)
    views = [view for choices in VIEWS[series]
             if (view := view_of(series, field, choices))]
    if not views:
        raise Skipped("all fields are zero")
    where = run.folder.resolve()
    size = np.ptp(field.points, axis=0)
    shown = {"name": run.name, "from": os.path.relpath(where, folder.resolve()),
             "folder": str(where), "towards": eye_of(series, field),
             "wide": len(size) == 2 and bool(size[0] > 1.2 * size[1]), "views": views}
    text = TEMPLATE.read_text()
    if text.count(PLACE) != 1:
        raise RuntimeError(f"'{TEMPLATE}' has no place for what is shown")
    path = folder / NAME
    words = pprint.pformat(shown, width=88, sort_dicts=False)
    words = words.replace("(Pa)", f"({run.unit('Pa')})")
    write_listed(path, text.replace(PLACE, f"RUN = {words}\n"))
    return path
