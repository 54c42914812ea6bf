# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""plates.png: moments, forces and displacements of plates at the ends of stages."""

import numpy as np

from geocone.plots.model import STRUCTURE, Model
from geocone.plots.overlay import BODY, outline_of
from geocone.style import COLORS, Skipped, plain, save, subplots, unit_for
from matplotlib.collections import LineCollection
from matplotlib.patches import PathPatch, Polygon

MOMENT, SHEAR, AXIAL = "bending moment", "shear force", "axial force"


def plates_of(model):
    """The plates of a scene, in the order of their numbers in the table."""
    return [structure for structure in model.data.get("structures", [])
            if structure["type"] == "plate"]


def ends_of_stages(model):
    """Names of the stages and the times at which they end (s)."""
    times = np.cumsum([stage["duration_s"] for stage in model.data["stages"]])
    return [(stage["name"], time) for stage, time in zip(model.data["stages"], times)]


def states_of(table, number, model, stages):
    """Lines of the table of a plate at the ends of the stages in which it exists, the last
    ones before a failure: name of the stage, and columns."""
    chosen, begin = [], 0.
    of_plate = table["plate"] == number
    for name, end in ends_of_stages(model):
        times = table["time (s)"][of_plate]
        inside = times[(times > begin * (1. + 1e-9)) & (times <= end * (1. + 1e-9))]
        begin = end
        if len(inside) and (not stages or name in stages):
            lines = of_plate & (table["time (s)"] == inside.max())
            chosen.append((name, {column: values[lines] for column, values in table.items()}))
    return chosen


def column_of(state, name):
    """The column of a name, and its unit."""
    for column, values in state.items():
        words, _, unit = column.rpartition(" (")
        if words == name:
            return values, unit[:-1]
    raise Skipped(f"there is no column '{name}'")


def normals_of(x, y):
    """Unit vectors to the left of each segment, at both of its ends (n, 2)."""
    along = np.repeat(np.stack([x[1::2] - x[::2], y[1::2] - y[::2]], axis=1), 2, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    return np.stack([-along[:, 1], along[:, 0]], axis=1)


def draw_moments(axes, model, states):
    """Moment diagrams at the end in the body, on the sides in tension."""
    sizes = [np.abs(column_of(state, MOMENT)[0]).max() for state in states]
    scale = 0.12 * model.size / max(*sizes, 1e-300)
    for state in states:
        x, y = state["x (m)"], state["y (m)"]
        moment = column_of(state, MOMENT)[0]
        line = np.stack([x, y], axis=1)
        tips = line - scale * moment[:, None] * normals_of(x, y)
        for i in range(0, len(line), 2):
            axes.add_patch(Polygon([line[i], line[i + 1], tips[i + 1], tips[i]],
                                   facecolor=COLORS[0], alpha=0.35, linewidth=0., zorder=5))
        pairs = np.stack([tips[::2], tips[1::2]], axis=1)
        axes.add_collection(LineCollection(pairs, colors=COLORS[0], linewidths=1., zorder=6))
        axes.plot(x, y, color=STRUCTURE, linewidth=2., zorder=7)
        most = np.argmax(np.abs(moment))
        _, unit = column_of(state, MOMENT)
        name, size = unit_for(abs(moment[most]), unit)
        axes.annotate(f"{abs(moment[most]) / size:.4g} {name}", tips[most], fontsize=8,
                      xytext=(4., 4.), textcoords="offset points", zorder=8)


def draw_run(run, path):
    """Draws the moments in the body at the end, and for each plate profiles of the moment, the
    shear force, the axial force and the displacement."""
    model = Model(run.folder)
    plates = plates_of(model)
    if not plates:
        raise Skipped("there are no plates")
    table = run.table("plates")
    of_plates = [states_of(table, i + 1, model, plate["stages"]) for i, plate in enumerate(plates)]
    if not all(of_plates):
        raise Skipped("a plate is not there at the end of any stage")
    figure, axes_of = subplots(len(plates), 5, squeeze=False,
                               figsize=(13., 3.9 * len(plates)),
                               gridspec_kw={"width_ratios": [1.7, 1., 1., 1., 1.]})
    for row, plate, states in zip(axes_of, plates, of_plates):
        draw_body(row[0], model)
        draw_moments(row[0], model, [states[-1][1]])
        last = states[-1][1]
        is_wall = np.ptp(last["y (m)"]) > 3. * np.ptp(last["x (m)"])
        place = "y (m)" if is_wall else "distance along it (m)"
        for axes, quantity in zip(row[1:], (MOMENT, SHEAR, AXIAL, "displacement")):
            draw_profiles(axes, states, quantity, place, is_wall)
        row[1].legend(fontsize=7)
        row[0].set_title(plain(plate["name"]) + ": moments at the end, on the side in tension",
                         fontsize=9)
    save(figure, run, path)


def draw_body(axes, model):
    """The outline of the body."""
    outline = outline_of(model)
    if outline is not None:
        axes.add_patch(PathPatch(outline, fill=False, **BODY))
    margin = 0.03 * model.size
    axes.set(xlim=(model.low[0] - margin, model.high[0] + margin), aspect="equal",
             ylim=(model.low[1] - margin, model.high[1] + margin), xlabel="x (m)", ylabel="y (m)")
    axes.grid(False)


def draw_profiles(axes, states, quantity, place, is_wall):
    """A quantity along a plate at the ends of stages: upwards for a wall."""
    if quantity == "displacement":
        values = [np.hypot(state["displacement x (m)"], state["displacement y (m)"])
                  for _, state in states]
        unit, size = "mm", 1e-3
    else:
        values = [column_of(state, quantity)[0] for _, state in states]
        unit, size = unit_for(max(np.abs(value).max() for value in values),
                              column_of(states[0][1], quantity)[1])
    for i, ((name, state), value) in enumerate(zip(states, values)):
        pair = (value / size, state[place])
        axes.plot(*(pair if is_wall else pair[::-1]), color=COLORS[i % len(COLORS)],
                  linewidth=1.3, label=plain(name))
    label = f"{quantity} ({unit})"
    axes.set(**({"xlabel": label, "ylabel": place} if is_wall else
                {"xlabel": place, "ylabel": label}))
