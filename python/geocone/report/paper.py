# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of Guillet et al. (2025), section 5, from runs of studies/paper.toml.

Each function takes the rows of runs and the table of the figure in the study file,
whose further keys are options:
  where   {axis = value or a list of them}: only runs that have it
  color, style   names of the axes that colours and line styles stand for
The others are described where they are used; tables have none. Runs that have failed are
left out, and the picture says so.
"""

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LogNorm, Normalize
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import MaxNLocator

from geocone.plots.newton import draw_attempts
from geocone.plots.point_values import values_of
from geocone.plots.rates import add_rates, cells_of
from geocone.reader import nearest, read_series, read_states, read_table
from geocone.report.schema import (LINE, NUMBER, POSITIVE, VALUE, VIEW, any_of, between, list_of,
                                   table_of, takes, words)
from geocone.style import (BESIDE, BLUE, COLORS, ORANGE, STRAINS, add_bar, disks,
                           panels, plain, subplots)

STYLES = ["-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2))]
WHERE = {"where": table_of(any_of(VALUE, list_of(VALUE)))}
LOOKS = {**WHERE, "color": LINE, "style": LINE}
FLOOR = 1e-20  # what is drawn of smaller numbers on a logarithmic scale


def chosen(rows, options):
    """The finished runs that a figure shows, and a note about failed ones."""
    where = {axis: value if isinstance(value, list) else [value]
             for axis, value in options.get("where", {}).items()}
    wanted = [row for row in rows if all(row["axes"].get(axis) in values
                                         for axis, values in where.items())]
    good = [row for row in wanted if row["status"] == "finished"]
    failed = [f"{row['label'] or row['group']}: {row['reason']}" for row in wanted
              if row["status"] != "finished"]
    return good, "failed: " + "; ".join(failed) if failed else ""


def note(figure, text):
    """Writes a note about what is missing under a figure."""
    if text:
        figure.text(0.01, -0.01, plain(text, 200), fontsize=9, color="#a00000", va="top")


def empty(text):
    """The figure of no runs."""
    figure, axes = subplots(figsize=(6., 1.2))
    axes.set_axis_off()
    axes.text(0.5, 0.5, plain(text or "no runs"), ha="center", va="center")
    return figure


def looks(rows, options):
    """Colour and line style of each run, given by two of its axes."""
    def order(axis):
        values = list(dict.fromkeys(row["axes"].get(axis) for row in rows))
        return [values.index(row["axes"].get(axis)) for row in rows]
    if "color" in options:
        colors = order(options["color"])
        styles = order(options["style"]) if "style" in options else [0] * len(rows)
    else:
        colors, styles = range(len(rows)), [0] * len(rows)
    return [{"color": COLORS[c % len(COLORS)],
             "linestyle": STYLES[s % len(STYLES)]} for c, s in zip(colors, styles)]


def statistics(row):
    """The columns of statistics.csv."""
    return read_table(row["folder"] / "statistics.csv")


@takes(**LOOKS, x=words("time", "displacement"), widths=list_of(POSITIVE, 1),
       names=list_of(LINE), names_of=table_of(LINE))
def load_time(rows, options):
    """Load against time or displacement, with Prandtl's loads of given widths.
    Options: x (time | displacement), widths [m], of which the first one is that of
    the scene, names (of these references), names_of (label of a run: its name)."""
    good, text = chosen(rows, options)
    if not good:
        return empty(text)
    figure, axes = subplots(figsize=(9.5, 4.6))
    by_time = options.get("x", "time") == "time"
    names = options.get("names_of", {})
    for row, look in zip(good, looks(good, options)):
        table = statistics(row)
        x = table["time (s)"] if by_time else 1e3 * table["displacement (m)"]
        axes.plot([0., *x], [0., *table["load (N/m)"] / 1e3], linewidth=1.6,
                  marker="o" if len(x) <= 30 else None, markersize=3.,
                  label=plain(names.get(row["label"], row["label"] or row["group"])),
                  **look)
    reference = good[0]["summary"]["limit_load"]["reference"]
    widths = options.get("widths", [0.2])
    labels = options.get("names", [f"Prandtl, {w} m" for w in widths])
    for width, label, style in zip(widths, labels, STYLES):
        value = reference * width / widths[0] / 1e3
        axes.axhline(value, color="black", linewidth=1.2, linestyle=style, zorder=1.5,
                     label=f"{plain(label)}: {value:.2f} kN/m")
    axes.set(xlabel="time (s)" if by_time else "displacement (mm)", ylabel="load (kN/m)",
             ylim=(0., None))
    axes.set_xlim(0., None)
    axes.legend(**BESIDE)
    note(figure, text)
    return figure


def bearing(phi, cohesion, width):
    """Prandtl's load of a weightless soil, (77): angle in degrees, N/m."""
    t = np.tan(np.radians(phi))
    return width * cohesion / t * (np.exp(np.pi * t) *
                                   np.tan(np.pi / 4. + np.radians(phi) / 2.)**2 - 1.)


@takes("angle", "cohesion", "width", **WHERE, angle=LINE, others=list_of(LINE),
       cohesion=POSITIVE, width=POSITIVE)
def load_angle(rows, options):
    """Largest loads against the friction angle beside (77), and their difference.
    Options: angle (axis), others (axes of the lines), cohesion (Pa), width (m)."""
    good, text = chosen(rows, options)
    if not good:
        return empty(text)
    angle, others = options["angle"], options.get("others", [])
    cohesion, width = options["cohesion"], options["width"]
    lines = {}
    for row in good:
        key = ", ".join(value_text(axis, row["axes"][axis]) for axis in others)
        lines.setdefault(key, []).append(
            (row["axes"][angle], row["summary"]["limit_load"]["peak"]))
    figure, (axes, below) = subplots(
        2, 1, figsize=(9.5, 6.4), sharex=True,
        gridspec_kw={"height_ratios": [3., 2.]})
    angles = np.array(sorted({phi for points in lines.values() for phi, _ in points}))
    fine = np.linspace(angles[0], angles[-1], 61)
    axes.plot(fine, bearing(fine, cohesion, width) / 1e3, "k-", linewidth=1.2,
              label="formula (77)")
    for i, (key, points) in enumerate(lines.items()):
        phi, load = np.array(sorted(points)).T
        look = {"color": COLORS[i % len(COLORS)], "marker": "osD^v"[i % 5],
                "linestyle": STYLES[(i // 2) % len(STYLES)], "markersize": 6.}
        axes.plot(phi, load / 1e3, label=plain(key), **look)
        below.plot(phi, 100. * (load / bearing(phi, cohesion, width) - 1.), **look)
    below.axhline(0., color="black", linewidth=1.2)
    below.axhspan(-5., 5., color="#e8e8e8", zorder=0., label="the paper: within 5 %")
    axes.set(ylabel="largest load (kN/m)")
    below.set(xlabel="friction angle (degrees)", ylabel="relative difference (%)")
    axes.legend(loc="upper left")
    below.legend(loc="lower left")
    note(figure, text)
    return figure


def value_text(axis, value):
    """A value of an axis in words."""
    return (value if isinstance(value, str) else
            f"{axis.rsplit('/', 1)[-1].lower()} = {value}")


def prandtl_lines(phi, width):
    """The borders of Prandtl's mechanism on the right of a footing: the wedge under
    it, the fan with its logarithmic spiral, the wedge beside it. Angle in radians."""
    edge = np.array([width / 2., 0.])
    steep, flat = np.pi / 4. + phi / 2., np.pi / 4. - phi / 2.  # to the horizontal
    r0 = width / 2. / np.cos(steep)  # from the edge to the tip of the first wedge
    psi = np.linspace(0., np.pi / 2., 91)
    # The spiral turns from the tip, below and left of the edge, to the right.
    angle = np.pi + steep + psi
    spiral = edge + (r0 * np.exp(psi * np.tan(phi)))[:, None] * np.stack(
        [np.cos(angle), np.sin(angle)], axis=1)
    exit_x = edge[0] + 2. * r0 * np.exp(np.pi / 2. * np.tan(phi)) * np.cos(flat)
    return [np.array([edge, spiral[0]]), spiral, np.array([edge, spiral[-1]]),
            np.array([spiral[-1], [exit_x, 0.]])]


def title_of(row, field):
    """The run and the time of a panel."""
    return ", ".join([*filter(None, [plain(row["label"])]), f"t = {field.time:.3g} s"])


@takes("view", **WHERE, series=words("points", "cells"), view=VIEW,
       mechanism=between(0, 89), width=POSITIVE, shown=POSITIVE)
def rates(rows, options):
    """Plastic strain rates at the end. Options: series (points | cells), view [x0,
    y0, x1, y1], mechanism (friction angle of the borders that are drawn), width,
    shown (rates below this part of the greatest one are drawn as none)."""
    good, text = chosen(rows, options)
    if not good:
        return empty(text)
    series = options.get("series", "points")
    fields = [read_states(row["folder"] / f"{series}.pvd")[0] for row in good]
    shown, (x0, y0, x1, y1) = options.get("shown", 1e-4), options["view"]
    figure, axes = panels(len(good), np.array([[x0, y0], [x1, y1]]))
    values = values_of(fields, "plastic_strain_rate")
    most = max(value.max() for value in values)
    for ax, row, field, value in zip(axes, good, fields, values):
        add_rates(ax, disks(ax, field, value) if series == "points" else
                  cells_of(field, value), LogNorm(shown * most, most))
        ax.set_title(title_of(row, field))
        if "mechanism" in options:
            for line in prandtl_lines(np.radians(options["mechanism"]), options["width"]):
                for sign in (1., -1.):
                    ax.plot(sign * line[:, 0], line[:, 1], color="black", linewidth=1.6,
                            path_effects=[Stroke(linewidth=3.2, foreground="white"),
                                          Normal()])
    note(figure, text)
    return figure


@takes("view", "width", "speed", "box", "cell", **WHERE, view=VIEW, width=POSITIVE,
       speed=POSITIVE, box=list_of(NUMBER, 2, 2), cell=any_of(POSITIVE, LINE))
def velocities(rows, options):
    """Vertical velocities of the points near the footing at the end, with the mesh.
    Options: view, width, speed (m/s, of the footing), box (lower left corner of the
    mesh), cell (axis of the cell size, or its value)."""
    good, text = chosen(rows, options)
    if not good:
        return empty(text)
    x0, y0, x1, y1 = options["view"]
    figure, axes = panels(len(good), np.array([[x0, y0], [x1, y1]]))
    for ax, row in zip(axes, good):
        field, = read_states(row["folder"] / "points.pvd")
        speed = -field.data["velocity"][:, 1] / options["speed"]
        size = row["axes"].get(options["cell"], options["cell"])
        corner = options["box"]
        for x in np.arange(corner[0], x1 + size, size):
            ax.axvline(x, color="black", linewidth=0.7, zorder=0.5)
        for y in np.arange(corner[1], y1 + size, size):
            ax.axhline(y, color="black", linewidth=0.7, zorder=0.5)
        inside = np.all((field.points > [x0, y0]) & (field.points < [x1, y1]), axis=1)
        drawn = ax.scatter(*field.points[inside].T, c=speed[inside], s=42.,
                           cmap=matplotlib.colormaps["coolwarm"], norm=Normalize(-2., 2.),
                           edgecolors="black", linewidths=0.4, zorder=2.)
        half, level = options["width"] / 2., -field.time * options["speed"]
        held = np.abs(field.data["displacement"][:, 1] - level) < 1e-6
        sunk = field.data["displacement"][:, 1] / level
        # The others in the cells beside the footing, at the depth of its points.
        from_axis = np.abs(field.points[:, 0])
        depth = field.points[held, 1].mean() if np.any(held) else level
        beside = ((np.abs(field.points[:, 1] - depth) < size / 2.) & ~held &
                  (from_axis > half) & (from_axis < half + size))
        for some, color, label in (
                (held, "#D55E00", "held by the footing"),
                (beside, "#009E73", "beside it, medians: have sunk "
                 f"{np.median(sunk[beside]):.2f} of its way,\n"
                 f"and have {np.median(speed[beside]):.2f} of its velocity")):
            ax.scatter(*field.points[some & inside].T, s=110., marker="s", label=label,
                       facecolors="none", edgecolors=color, linewidths=1.6, zorder=3.)
        ax.axvspan(-half, half, color=ORANGE, alpha=0.2, zorder=0.)
        ax.annotate("", (-half, y1 - 0.2 * size), (half, y1 - 0.2 * size),
                    arrowprops={"arrowstyle": "<->", "linewidth": 1.5})
        ax.text(0., y1 - 0.2 * size, "B", ha="center", va="center", fontsize=13,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5})
        ax.set_title(title_of(row, field))
        ax.legend(loc="lower left")
        add_bar(ax, drawn, "downward velocity\n/ velocity of the footing",
                     extend="both")
    note(figure, text)
    return figure


def frozen_problem(folder, number):
    """The problem of a step: arrays by name."""
    try:
        import h5py  # only this figure needs it
    except ImportError as problem:
        raise RuntimeError(f"{problem}; Debian has it in python3-h5py") from problem
    with h5py.File(folder / f"frozen-{number}.h5", "r") as file:
        return {name: file[name][...] for name in (
            "step", "points/first_point", "points/n_nodes", "points/nodes",
            "points/gradients", "points/stress", "dofs/start")}


def elastic_strains(stress, young, poisson):
    """S s in plane strain, in Mandel components (point, 3)."""
    shear = 2. * young / (2. * (1. + poisson))
    bulk = 2. * young * (poisson / ((1. + poisson) * (1. - 2. * poisson)) +
                         1. / (2. * (1. + poisson)))
    mean = (stress[:, :1] + stress[:, 1:2]) / 2.
    return (stress - mean * [1., 1., 0.]) / shear + mean * [1., 1., 0.] / bulk


def frozen_steps(folder, young, poisson):
    """Stresses at the ends of steps and increments z = S ds - h B v of them, with all
    digits, in Mandel components (step, point, 3), where each problem starts from the
    velocities that the step before has found, and from its stresses."""
    numbers = sorted(int(path.stem.split("-")[1]) for path in folder.glob("frozen-*.h5"))
    if len(numbers) < 2 or numbers != list(range(1, len(numbers) + 1)):
        raise RuntimeError(f"'{folder}' has not the frozen problems of all steps")
    substeps = read_table(folder / "statistics.csv")["substeps (-)"]
    stresses, increments, steps = [], [], []
    before = frozen_problem(folder, 1)
    for number in numbers[1:]:
        after = frozen_problem(folder, number)
        if substeps[number - 2] == 1. and substeps[number - 1] == 1.:  # else parts only
            first, n = before["points/first_point"], before["points/n_nodes"][0]
            cells = np.repeat(np.arange(len(first) - 1), np.diff(first))
            velocity = after["dofs/start"].reshape(-1, 2)[
                before["points/nodes"].reshape(-1, n)[cells]]
            rate = np.einsum("pni,pjn->pij", velocity,
                             before["points/gradients"].reshape(len(cells), 2, n))
            strain = before["step"][0] * np.stack(
                [rate[:, 0, 0], rate[:, 1, 1],
                 (rate[:, 0, 1] + rate[:, 1, 0]) / np.sqrt(2.)], axis=1)
            old, new = (problem["points/stress"].reshape(-1, 3)
                        for problem in (before, after))
            stresses.append(new)
            increments.append(elastic_strains(new - old, young, poisson) - strain)
            steps.append(number - 1)
        before = after
    return np.array(steps), np.array(stresses), np.array(increments)


def invariants(tensor):
    """I1 and the root of J2, both in the plane, of Mandel components."""
    xx, yy, xy = np.moveaxis(tensor, -1, 0)
    return xx + yy, np.hypot((xx - yy) / 2., xy / np.sqrt(2.))


def complementarity(stress, z, a, b, k):
    """How far y.(s + k/a n) is from zero at each point of each step, relative to the
    largest |y| times the largest stress of the step; y = z + (a - b) |z_t| n is that
    of (25). NaN where nothing flows."""
    n = -np.array([1., 1., 0.]) / np.sqrt(2.)
    size = np.linalg.norm(z - (z @ n)[..., None] * n, axis=-1)
    y = z + (a - b) * size[..., None] * n
    length = np.linalg.norm(y, axis=-1)
    largest = length.max(axis=1, keepdims=True)
    scale = largest * (np.linalg.norm(stress, axis=-1).max(axis=1, keepdims=True) + k)
    product = np.abs(np.sum(y * (stress + k / a * n), axis=-1)) / scale
    return np.where(length > 1e-12 * largest, np.maximum(product, FLOOR), np.nan)


def paths(axes, x, y, every):
    """A thin line from the origin for each point through time."""
    lines = np.stack([np.pad(x, ((1, 0), (0, 0))), np.pad(y, ((1, 0), (0, 0)))], axis=-1)
    axes.add_collection(LineCollection(
        lines.transpose(1, 0, 2)[::every], colors=BLUE, linewidths=0.5, alpha=0.35,
        rasterized=True))
    axes.plot(x[-1, ::every], y[-1, ::every], ".", color=COLORS[1], markersize=3.,
              label="last step", rasterized=True)
    axes.autoscale_view()


@takes("phi", "theta", "cohesion", "young", "poisson", "lowest", **WHERE, phi=between(0, 89),
       theta=between(0, 89), cohesion=POSITIVE, young=POSITIVE, poisson=between(0, 0.5),
       every=between(1, 1000, True), lowest=NUMBER)
def law(rows, options):
    """Four panels of one run with frozen problems of all steps: stresses and the cone,
    plastic strains and the cone of flow, complementarity, Newton's method. Options:
    phi and theta (degrees), cohesion, young (Pa), poisson, every (a line for each so
    many points), lowest (least I1 of the stress that is shown, kPa)."""
    good, text = chosen(rows, options)
    if not good:
        return empty(text)
    row, every = good[0], options.get("every", 3)
    steps, stress, z = frozen_steps(row["folder"], options["young"], options["poisson"])
    phi, theta = np.radians(options["phi"]), np.radians(options["theta"])
    a, b, k = np.sin(phi), np.sin(theta), np.sqrt(2.) * options["cohesion"] * np.cos(phi)
    figure, axes = subplots(2, 2, figsize=(11.5, 8.))
    i1, j = invariants(stress / 1e3)
    paths(axes[0, 0], i1, j, every)
    apex, lowest = 2e-3 * options["cohesion"] / np.tan(phi), options["lowest"]
    axes[0, 0].plot([lowest, apex], [a * (apex - lowest) / 2., 0.], "k--", linewidth=1.2,
                    label="the cone of phi and c")
    axes[0, 0].set(xlabel="$I_1$ of the stress (kPa)", ylabel=r"$\sqrt{J_2}$ (kPa)",
                   title="stress", xlim=(lowest, apex - 0.05 * lowest),
                   ylim=(-0.02 * a * (apex - lowest), 0.55 * a * (apex - lowest)))
    i1, j = invariants(-np.cumsum(z, axis=0))
    paths(axes[0, 1], i1, j, every)
    top = j.max()
    axes[0, 1].plot([0., 2. * b * top], [0., top], "k--", linewidth=1.4,
                    label="the cone of flow with theta")
    axes[0, 1].set(xlabel="$I_1$ of the plastic strain (-)", ylabel=r"$\sqrt{J_2}$ (-)",
                   title="plastic strain")
    product = complementarity(stress, z, a, b, k)
    lines = np.stack([np.broadcast_to(steps[:, None], product.shape), product], axis=-1)
    below = axes[1, 0]
    below.add_collection(LineCollection(
        lines.transpose(1, 0, 2)[::every], colors=BLUE, linewidths=0.4, alpha=0.3,
        rasterized=True))
    below.plot(steps, np.nanmax(product, axis=1), "o-", color=COLORS[1],
               markersize=3.5, label="largest of all points")
    below.axhline(1e-10, color="black", linestyle="--", linewidth=1.2,
                  label="tolerance of the solver")
    below.set(yscale="log", xlabel="step", ylim=(FLOOR, 1e-8), title="complementarity",
              ylabel=r"$|y \cdot (\sigma + (k/a)\, n)|$, relative (-)")
    below.xaxis.set_major_locator(MaxNLocator(integer=True))
    newton(axes[1, 1], row)
    for ax, place in zip(axes.flat, ("upper right", "lower right", "upper right",
                                     "upper right")):
        ax.legend(fontsize=9, loc=place)
    figure.suptitle(plain(row["label"] or row["group"]), fontsize=13)
    note(figure, text)
    return figure


def newton(axes, row):
    """The error of each iteration, a line for each attempt at a step."""
    table = read_table(row["folder"] / "newton.csv")
    _, bar = draw_attempts(axes, table,
                           np.maximum(table["relative residual (-)"], FLOOR))
    axes.axhline(1e-10, color="black", linestyle="--", linewidth=1.2,
                 label="tolerance of the solver")
    axes.set_title("Newton's method")
    axes.figure.colorbar(ax=axes, **bar)


@takes("times", "view", **WHERE, times=list_of(NUMBER, 1, 8), view=VIEW, largest=POSITIVE)
def strains(rows, options):
    """Cumulative plastic strain of points at given times, of one run.
    Options: where, times (s), view, largest (of the colours)."""
    good, text = chosen(rows, options)
    if not good:
        return empty(text)
    row = good[0]
    file = row["folder"] / "points.pvd"
    times = np.array([time for time, _ in read_series(file)])
    fields = read_states(file, nearest(times, options["times"]))
    x0, y0, x1, y1 = options["view"]
    figure, axes = panels(len(fields), np.array([[x0, y0], [x1, y1]]))
    values = values_of(fields, "cumulative_plastic_strain")
    norm = Normalize(0., options.get("largest") or max(v.max() for v in values))
    for i, (ax, field, value) in enumerate(zip(axes, fields, values)):
        drawn = disks(ax, field, value)
        drawn.set(cmap=STRAINS, norm=norm)
        ax.add_collection(drawn)
        ax.set_title(f"{'abcdefgh'[i]}) t = {field.time:.3g} s, "
                     f"up to {100. * value.max():.0f} %")
        ax.label_outer()
    figure.suptitle(plain(row["label"] or row["group"]), fontsize=13)
    figure.colorbar(drawn, ax=list(axes), label="cumulative plastic strain (-)",
                    aspect=40, pad=0.02, extend="max" if "largest" in options else
                    "neither")
    note(figure, text)
    return figure


def energy_table(row):
    """Energies of the paper's section 5.2 from t = 0 on, potential zero at the end."""
    table = statistics(row)
    start = row["summary"]["energy"]["initial_J_per_m"]
    potential = np.array([start, *table["potential energy (J/m)"]])
    energies = {
        "kinetic": np.array([0., *table["kinetic energy (J/m)"]]),
        "elastic": np.array([0., *table["elastic energy (J/m)"]]),
        "potential": potential - potential[-1]}
    energies["mechanical"] = sum(energies.values())
    energies["dissipation"] = np.array([0., *table["plastic dissipation (J/m)"]])
    energies["total"] = energies["mechanical"] + energies["dissipation"]
    return np.array([0., *table["time (s)"]]), energies


@takes(**WHERE)
def energies(rows, options):
    """The energies of section 5.2, a panel for each run, one beside the other."""
    good, text = chosen(rows, options)
    if not good:
        return empty(text)
    figure, axes = subplots(1, len(good), figsize=(5.2 * len(good) + 1.6, 4.6),
                                squeeze=False, sharey=True)
    colors = dict(zip(("kinetic", "elastic", "potential", "mechanical", "dissipation",
                       "total"),
                      (BLUE, ORANGE, "#009E73", "#D55E00", "#CC79A7", "black")))
    for ax, row in zip(axes.flat, good):
        time, curves = energy_table(row)
        for name, values in curves.items():
            ax.plot(time, values / 1e3, color=colors[name], marker="o", markersize=3.,
                    linestyle="--" if name == "total" else "-", label=name)
        ax.set(title=plain(row["label"] or row["group"]), xlabel="time (s)")
    axes[0, 0].set_ylabel("energy (kJ/m)")
    axes[0, -1].legend(**BESIDE)
    note(figure, text)
    return figure


def table_of(head, rows, cells):
    """Head and lines of a table: a run and its cells; a failed run is named as such."""
    lines = []
    for row in rows:
        name = f"{row['group']}: {row['label']}" if row["label"] else row["group"]
        lines.append([name, *cells(row)] if row["status"] == "finished" else
                     [name, "failed", *["-"] * (len(head) - 1)])
    return ["run", *head], lines


def load_numbers(row):
    """Loads of a footing (N/m) by name: first, last, largest, and late, the mean of the second
    half of the run."""
    table = statistics(row)
    load, time = table["load (N/m)"], table["time (s)"]
    return {"first": load[0], "last": load[-1], "largest": load.max(),
            "late": load[time > time[-1] / 2.].mean()}


@takes()
def loads_table(rows, _):
    """Head and lines: what each run of a footing has found."""
    def cells(row):
        summary, loads = row["summary"], load_numbers(row)
        exact = summary["limit_load"]["reference"]
        return [*(f"{value / 1e3:.2f}" for value in
                  (loads["largest"], loads["last"], loads["late"], exact)),
                f"{loads['largest'] / exact:.3f}", f"{loads['late'] / exact:.3f}",
                str(summary["size"].get("lost_points", 0)),
                f"{summary['newton']['iterations_mean']:.1f}",
                str(summary["newton"]["failures"])]
    return table_of(["largest load (kN/m)", "last load (kN/m)", "mean of the second "
                     "half (kN/m)", "Prandtl (kN/m)", "largest / Prandtl",
                     "mean / Prandtl", "points that left", "iterations per step",
                     "failed attempts"], rows, cells)


def energy_numbers(row):
    """Numbers of section 5.2 by name: the largest plastic strain, energies (J/m), the time of
    the largest kinetic energy (s), losses of the total relative to what is released and to
    the initial energy."""
    time, e = energy_table(row)
    loss = e["total"][0] - e["total"][-1]
    return {"strain": row["summary"]["state"]["largest_plastic_strain"],
            "released": e["potential"][0], "dissipated": e["dissipation"][-1],
            "largest kinetic": e["kinetic"].max(), "last kinetic": e["kinetic"][-1],
            "time of the largest kinetic": time[np.argmax(e["kinetic"])],
            "loss / released": loss / e["potential"][0],
            "loss / initial": loss / row["summary"]["energy"]["initial_J_per_m"],
            "largest rise of the total": max(0., np.diff(e["total"]).max())}


@takes()
def energies_table(rows, _):
    """Head and lines: what each run of a slope has found."""
    def cells(row):
        e = energy_numbers(row)
        return [f"{100. * e['strain']:.0f} %",
                f"{e['released'] / 1e3:.1f}", f"{e['dissipated'] / 1e3:.1f}",
                f"{e['largest kinetic'] / 1e3:.1f}", f"{e['time of the largest kinetic']:.2f}",
                f"{e['last kinetic'] / 1e3:.2f}", f"{100. * e['loss / released']:.1f}",
                f"{100. * e['loss / initial']:.2f}", f"{e['largest rise of the total']:.1f}",
                str(row["summary"]["size"].get("lost_points", 0))]
    return table_of(["largest plastic strain", "released potential energy (kJ/m)",
                     "dissipation (kJ/m)", "largest kinetic energy (kJ/m)", "at (s)",
                     "kinetic energy at the end (kJ/m)", "loss / released (%)",
                     "loss / initial (%)", "largest rise of the total (J/m)",
                     "points that left"], rows, cells)


@takes()
def misfits(rows, _):
    """Head and lines: how far slopes of several shapes (axes 'shape' and 'theta') are from
    the numbers of figures 16 to 19, the root mean square of the logarithms of their
    ratios; losses count above 5 %."""
    found = {(row["axes"]["shape"], row["axes"]["theta"]): energy_numbers(row)
             for row in rows if row["status"] == "finished"}
    lines = []
    for shape in dict.fromkeys(row["axes"]["shape"] for row in rows):
        try:
            a, z = found[shape, "theta = phi"], found[shape, "theta = 0"]
        except KeyError:
            lines.append([shape, "failed", *["-"] * 7])
            continue
        ratios = [a["strain"] / 2., z["strain"] / 3., z["released"] / a["released"] / 5.,
                  z["dissipated"] / a["dissipated"] / 10., a["time of the largest kinetic"] / 1.5,
                  *(max(1., e["loss / released"] / 0.05) for e in (a, z))]
        lines.append([shape, f"{np.sqrt(np.mean(np.log(ratios)**2)):.3f}",
                      f"{100. * a['strain']:.0f}", f"{100. * z['strain']:.0f}",
                      f"{z['released'] / a['released']:.1f}",
                      f"{z['dissipated'] / a['dissipated']:.1f}",
                      f"{a['time of the largest kinetic']:.2f}",
                      *(f"{100. * e['loss / released']:.1f}" for e in (a, z))])
    return ["shape", "misfit", "strain, theta = phi (%)", "strain, theta = 0 (%)",
            "ratio of energies", "ratio of dissipations", "time (s)",
            "loss, theta = phi (%)", "loss, theta = 0 (%)"], lines
