# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The slope whose toe is cut off (studies/slope_cut.toml): a group is a soil, the axis
`cells` its cells and points. Option: cells (the runs of a picture).

Of the influence of its constants (studies/slope_cut_parameters.toml) two groups of runs
are compared. One at a time: the axis `variant` is `base`, or a factor, `low` or `high`,
and its value. Design of experiments: the axis `levels` has a letter, L or H, for each
factor, in the order in which the variants name them. The axis `points` of both is the
resolution. Options: toe (x of the cut, m), points (the resolution that is ranked).
"""

import itertools

import numpy as np
from matplotlib.colors import LogNorm

from geocone.reader import Run, nearest, read_series, read_states, read_table
from geocone.report.schema import NUMBER, VALUE, VIEW, list_of, takes, words
from geocone.style import BLUE, COLORS, ORANGE, STRAINS, disks, plain, subplots

MOVED = 1.  # m: soil that has moved by more has failed
RESPONSES = {"run-out": "m", "time of failure": "s"}
SYMBOLS = {"alpha": "α", "ca": "$c_a$", "cb": "$c_b$", "cbeta": "$c_β$", "cR": "$c_R$"}


def shown(rows, options):
    """The finished runs of a picture, one for each soil."""
    return [row for row in rows if row["axes"]["cells"] == options["cells"] and
            row["status"] == "finished"]


def states_at(row, times):
    """The states of the points that are nearest to some times."""
    file = row["folder"] / "points.pvd"
    series = np.array([time for time, _ in read_series(file)])
    return read_states(file, nearest(series, times))


def before_cut(row):
    """The columns of statistics.csv, and the place of the last step before soil is taken
    away. The time of that depends on how long the slope has needed to come to rest."""
    table = read_table(row["folder"] / "statistics.csv")
    return table, int(np.flatnonzero(table["removed mass (kg/m)"] == 0.)[-1])


def end_of(row):
    """The places of the points at the end of a run (m), and which have moved by more than
    MOVED."""
    last, = read_states(row["folder"] / "points.pvd")
    return last.points, np.linalg.norm(last.data["displacement"], axis=1) > MOVED


@takes("crest", crest=NUMBER)
def table(rows, options):
    """A line for each run. Options: crest (m, height of the ground behind the slope)."""
    lines = []
    for row in rows:
        if row["status"] != "finished":
            lines.append([row["group"], row["label"], "failed", *["-"] * 9])
            continue
        steps, before = before_cut(row)
        places, moved = end_of(row)
        x, y = places.T
        weight = 9.81 * steps["mass (kg/m)"][before]
        speed, work = steps["largest speed (m/s)"], steps["gravity work (J/m)"]
        lines.append([
            row["group"], row["label"], row["summary"]["state"]["points"],
            row["summary"]["explicit"]["steps"],
            f"{steps['unbalanced force (N/m)'][before] / weight:.1e}",
            f"{speed[before]:.3f}", f"{speed[before + 1:].max():.1f}",
            f"{steps['kinetic energy (J/m)'][before + 1:].max() / 1e3:.1f}",
            f"{(work[-1] - work[before]) / 1e3:.0f}",
            f"{x[~moved & (y > options['crest'] - 0.5)].max():.2f}",
            f"{x[moved].max():.2f}" if np.any(moved) else "-",
            f"{100. * steps['numerical loss (J/m)'][-1] / work[-1]:.2f} %"])
    return ["soil", "cells, points per cell", "points", "explicit steps", "unbalanced",
            "fastest point before (m/s)", "fastest point after (m/s)",
            "largest kinetic energy (kJ/m)", "released (kJ/m)", "edge (m)", "slide (m)",
            "numerical loss"], lines


def removed_polygons(row):
    """The polygons that stages of a run take away, their vertices (m)."""
    return [np.array([[float(x) for x in vertex.split(",")] for vertex in text.split(";")])
            for path, text in Run(row["folder"]).parameters.items()
            if path.startswith("Loading/") and path.endswith("/Removed polygon") and text]


@takes("cells", "times", "view", cells=VALUE, times=list_of(NUMBER, 1, 20), view=VIEW)
def points(rows, options):
    """The points of all soils at some times, before the cut with the outline of what it
    takes away. Options: times (s), view [x0, y0, x1, y1]."""
    soils, times = shown(rows, options), options["times"]
    x0, y0, x1, y1 = options["view"]
    figure, grid = subplots(len(times), len(soils), figsize=(5.5 * len(soils), 10.),
                            sharex=True, sharey=True, squeeze=False)
    for column, row in zip(grid.T, soils):
        steps, before = before_cut(row)
        for axes, state in zip(column, states_at(row, times)):
            after = state.time - steps["time (s)"][before]
            axes.set(aspect="equal", xlim=(x0, x1), ylim=(y0, y1))
            drawn = disks(axes, state, state.data["cumulative_plastic_strain"][:, 0])
            drawn.set(cmap=STRAINS, norm=LogNorm(1e-2, 10.))
            axes.add_collection(drawn)
            axes.grid(False)
            is_cut = after > 1e-9
            if not is_cut:
                for polygon in removed_polygons(row):
                    axes.fill(*polygon.T, fill=False, edgecolor=ORANGE, linewidth=1.5)
            axes.set_title(plain(row["group"]) + (f", t = {after:.2g} s after the cut"
                                                  if is_cut else ", before the cut"))
            axes.set(xlabel="x (m)", ylabel="y (m)")
            axes.label_outer()
    figure.colorbar(drawn, ax=grid, extend="both", shrink=0.6,
                    label="cumulative plastic strain since the slope stands (-)")
    return figure


@takes("cells", cells=VALUE)
def energies(rows, options):
    """Kinetic energy, and where the released energy goes."""
    figure, (kinetic, works) = subplots(1, 2, figsize=(10., 4.))
    for row, color in zip(shown(rows, options), COLORS):
        steps, cut = before_cut(row)
        time, soil = steps["time (s)"][cut:] - steps["time (s)"][cut], plain(row["group"])
        kinetic.plot(time, steps["kinetic energy (J/m)"][cut:] / 1e3, color=color,
                     label=soil)
        for name, style in (("gravity work", "-"), ("stress work", "--")):
            work = steps[f"{name} (J/m)"][cut:]
            works.plot(time, (work - work[0]) / 1e3, style, color=color,
                       label=f"{soil}, {name}")
    for axes, title in ((kinetic, "kinetic energy"), (works, "work since the cut")):
        axes.set(title=title, xlabel="time after the cut (s)", ylabel="energy (kJ/m)")
        axes.legend(fontsize=9)
    return figure


def failure_time(row, point):
    """When an observed point has moved by more than MOVED since the cut (s); infinity if it
    has not until the end of the run."""
    steps, before = before_cut(row)
    moved = np.hypot(*(steps[f"displacement of point {point} {axis} (m)"][before:] -
                       steps[f"displacement of point {point} {axis} (m)"][before]
                       for axis in "xy"))
    time = steps["time (s)"][before:] - steps["time (s)"][before]
    beyond = np.flatnonzero(moved > MOVED)
    if not beyond.size:
        return np.inf
    i = beyond[0]
    return np.interp(MOVED, moved[i - 1:i + 1], time[i - 1:i + 1])


def run_out(row, toe):
    """How far the farthest point that has moved by more than MOVED is from the toe (m); 0
    if none has."""
    places, moved = end_of(row)
    return max(0., places[moved, 0].max() - toe) if np.any(moved) else 0.


def response(row, name, options):
    """A response of a run by its name; not a number of one that has not finished."""
    if row["status"] != "finished":
        return np.nan
    return failure_time(row, 1) if name == "time of failure" else run_out(row, options["toe"])


def followed(rows):
    """How long all finished runs have been followed after the cut (s)."""
    ends = []
    for row in rows:
        if row["status"] == "finished":
            steps, before = before_cut(row)
            ends.append(steps["time (s)"][-1] - steps["time (s)"][before])
    return min(ends)


def variants(rows):
    """The run with the constants of the scene, and for each factor those with its low and
    its high value: {factor: {"low": (value, row), "high": (value, row)}}."""
    base, factors = None, {}
    for row in rows:
        parts = row["axes"]["variant"].split(maxsplit=2)
        if len(parts) == 3:
            factors.setdefault(parts[0], {})[parts[1]] = parts[2], row
        elif parts == ["base"]:
            base = row
    if base is None or any(levels.keys() != {"low", "high"} for levels in factors.values()):
        raise ValueError("one at a time: 'base', and FACTOR low VALUE and FACTOR high VALUE "
                         "of each factor are needed")
    return base, factors


def signs_of(levels):
    """A line of signs for each run of a design, from its letters: -1 is L, 1 is H.
    @throw ValueError unless no main effect is aliased with another one or with a two-factor
    interaction (resolution IV)"""
    signs = np.array([[{"L": -1., "H": 1.}.get(letter, 0.) for letter in text]
                      for text in levels])
    columns = np.hstack([np.ones((len(signs), 1)), signs])
    clear = np.array_equal(columns.T @ columns, len(signs) * np.eye(columns.shape[1]))
    if not clear or np.any(columns.T @ interactions(signs)):
        raise ValueError("the runs are no design of two levels of resolution IV")
    return signs


def interactions(signs):
    """The columns of two-factor interactions, products of two columns, each once. Those of
    several pairs may be one: their effects are aliased."""
    products = np.array([signs[:, i] * signs[:, j] for i, j in
                         itertools.combinations(range(signs.shape[1]), 2)])
    return np.unique(products * products[:, :1], axis=0).T


def effects_of(columns, values):
    """Mean of the values where a column is 1 less that where it is -1, of each column."""
    return columns.T @ values / (0.5 * len(values))


def with_interactions(signs, values):
    """Main effects, and the root mean square of the two-factor interactions."""
    return (effects_of(signs, values),
            np.sqrt(np.mean(effects_of(interactions(signs), values)**2)))


def design(rows, name, options):
    """The main effects of a response, the root mean square of its two-factor interactions,
    the signs, and the values. A slope that stands may fail after the end of its run: the
    end is taken."""
    signs = signs_of([row["axes"]["levels"] for row in rows])
    values = np.array([response(row, name, options) for row in rows])
    if np.any(np.isnan(values)):
        raise ValueError("runs of the design have not finished")
    if name == "time of failure":
        values = np.minimum(values, followed(rows))
    return *with_interactions(signs, values), signs, values


def compared(rows, options):
    """The runs one at a time of the resolution that is ranked; those of the design, by their
    resolution, that one first."""
    single = [row for row in rows if "variant" in row["axes"] and
              row["axes"]["points"] == options["points"]]
    designs = {options["points"]: []}
    for row in rows:
        if "levels" in row["axes"]:
            designs.setdefault(row["axes"]["points"], []).append(row)
            if len(row["axes"]["levels"]) != len(variants(single)[1]):
                raise ValueError("levels have a letter for each factor of the variants")
    return single, designs


def shown_value(value, longest=np.inf, digits=2):
    """A response as tables show it."""
    return ("-" if np.isnan(value) else f"> {longest:.0f}" if value > longest else
            f"{value:.{digits}f}")


@takes("points", "response", "toe", points=VALUE, toe=NUMBER, response=words(*RESPONSES))
def ranking(rows, options):
    """A line for each factor, by the size of its main effect. Options: response."""
    name = options["response"]
    unit, is_time = RESPONSES[name], name == "time of failure"
    single, designs = compared(rows, options)
    base, factors = variants(single)
    found = {points: design(runs, name, options) for points, runs in designs.items()}
    longest = followed(single)
    main, noise, signs, values = found[options["points"]]
    if is_time:  # effects that multiply are sums in the logarithm
        stands, (logs, log_noise) = values >= longest, with_interactions(signs, np.log(values))
    lines = []
    for i in np.argsort(-np.abs(main)):
        factor = [*factors][i]
        level = factors[factor]
        lines.append([
            len(lines) + 1, factor, *(level[side][0] for side in ("low", "high")),
            *(shown_value(response(level[side][1], name, options), longest)
              for side in ("low", "high")),
            *(f"{effects[i]:+.2f}" for effects, *_ in found.values()),
            f"{abs(main[i]) / noise:.1f}"])
        if is_time:
            lines[-1] += [f"{np.exp(logs[i]):.2f}", f"{abs(logs[i]) / log_noise:.1f}",
                          ", ".join(f"{np.sum(stands & (signs[:, i] == sign))}"
                                    for sign in (-1., 1.))]
    lines.append(["-", "none (base)", "-", "-",
                  *[shown_value(response(base, name, options), longest)] * 2,
                  *["-"] * (len(found) + 1), *["-"] * 3 * is_time])
    lines.append(["-", "two-factor interactions (rms)", *["-"] * 4,
                  *(f"{rms:.2f}" for _, rms, *_ in found.values()), "1.0",
                  *([f"{np.exp(log_noise):.2f}", "1.0", "-"] if is_time else [])])
    return ["rank", "factor", "low", "high", f"{name} at low ({unit})", f"at high ({unit})",
            *(f"main effect, {points} ({unit})" for points in found), "over rms",
            *["ratio high to low", "its logarithm over rms",
              "runs that stand, low, high"] * is_time], lines


@takes("toe", toe=NUMBER)
def responses(rows, options):
    """A line for each run."""
    lines = []
    for row in rows:
        what = row["axes"].get("variant", row["axes"].get("levels"))
        if row["status"] != "finished":
            lines.append([row["group"], row["axes"]["points"], what, row["reason"][:80],
                          *["-"] * 5])
            continue
        steps, before = before_cut(row)
        longest = followed([row])
        work = steps["gravity work (J/m)"]
        lines.append([
            row["group"], row["axes"]["points"], what,
            f"{steps['largest speed (m/s)'][before]:.3f}",
            f"{run_out(row, options['toe']):.2f}",
            *(shown_value(failure_time(row, point), longest) for point in (1, 2)),
            f"{(work[-1] - work[before]) / 1e3:.0f}",
            f"{steps['kinetic energy (J/m)'][-1] / 1e3:.1f}"])
    return ["runs", "points per cell", "constants", "fastest point before (m/s)",
            "run-out (m)", "time of failure (s)", "crest fails (s)", "released (kJ/m)",
            "kinetic energy at the end (kJ/m)"], lines


def draw_singles(axes, single, name, options):
    """Bars from the response of the scene to those with one constant changed."""
    base, factors = variants(single)
    longest, middle = followed(single), response(base, name, options)
    ends = {factor: [response(levels[side][1], name, options) for side in ("low", "high")]
            for factor, levels in factors.items()}
    order = sorted(ends, key=lambda factor: np.ptp(np.minimum([*ends[factor], middle],
                                                              longest)))
    for place, (color, side) in enumerate(((BLUE, "low"), (ORANGE, "high"))):
        values = np.array([ends[factor][place] for factor in order])
        y = np.arange(len(order)) + 0.2 - 0.4 * place
        axes.barh(y, np.minimum(values, longest) - middle, 0.38, middle, color=color,
                  label=f"{side} value")
        late = values > longest
        axes.plot(0. * y[late] + longest, y[late], ">", color=color, markersize=8)
    axes.axvline(middle, color="k", linewidth=1., label="values of the scene")
    axes.set_yticks(range(len(order)), [
        f"{SYMBOLS.get(factor, plain(factor))}  ({factors[factor]['low'][0].split()[0]}, "
        f"{plain(factors[factor]['high'][0])})" for factor in order])
    axes.set(title=f"{name}, one at a time", xlabel=f"{name} ({RESPONSES[name]})")


def draw_design(axes, designs, factors, name, options):
    """Bars of main effects; marks of those of other resolutions."""
    found = {points: design(runs, name, options) for points, runs in designs.items()}
    main, noise, *_ = found[options["points"]]
    order = np.argsort(np.abs(main))
    y = np.arange(len(order))
    axes.axvspan(-2. * noise, 2. * noise, color="#e4e4e4", zorder=0.5,
                 label="within 2 rms of two-factor interactions")
    axes.barh(y, main[order], 0.6, color=COLORS[2],
              label=f"main effect, {plain(options['points'])}")
    for (points, (effects, *_)), marker in zip(list(found.items())[1:], "os^D"):
        axes.plot(effects[order], y, marker, color="k", markerfacecolor="white",
                  label=f"main effect, {plain(points)}")
    axes.axvline(0., color="k", linewidth=1.)
    axes.set_yticks(y, [SYMBOLS.get(factors[i], plain(factors[i])) for i in order])
    axes.set(title=f"{name}, design of {len(found[options['points']][-1])} runs",
             xlabel=f"mean at high less mean at low ({RESPONSES[name]})")


@takes("points", "toe", points=VALUE, toe=NUMBER)
def effects(rows, options):
    """Effects of each constant on run-out and time of failure, ranked: one at a time, and
    main effects of the design."""
    single, designs = compared(rows, options)
    figure, grid = subplots(len(RESPONSES), 2, figsize=(11., 9.))
    for (left, right), name in zip(grid, RESPONSES):
        draw_singles(left, single, name, options)
        draw_design(right, designs, [*variants(single)[1]], name, options)
        for axes in left, right:
            axes.grid(axis="y", visible=False)
    for axes, columns in zip(grid[-1], (3, 2)):
        axes.legend(fontsize=9, ncols=columns, loc="upper center", bbox_to_anchor=(0.5, -0.14))
    return figure
