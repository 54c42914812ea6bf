# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of explicit runs for scripts/plot, which hands itself over as `plot`:
  energy.png      statistics.csv: where the energy goes, and what the integration takes
  points.png      points-*.vtu at up to six times: plastic strain, or shear stress
  structure.png   the same: the ratio Rb of the structure, of soils that have one
  loading.png     the same: the ratio R of the subloading surface
  runout.png      statistics.csv: how far and how high the body reaches
"""

import functools
import re

import matplotlib
import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.ticker import MaxNLocator

# A column of statistics.csv, its name in the picture and its colour in plot.COLORS.
ENERGIES = [("kinetic energy", "kinetic energy", 0),
            ("gravity work", "released potential\nenergy (gravity work)", 3),
            ("stress work", "stress work", 1), ("damping work", "damping", 2),
            ("support work", "work of the supports", 4),
            ("stopped energy", "stopped kinetic energy", 5),
            ("removed kinetic energy", "removed kinetic energy", 6)]
UNTOUCHED = "#d4d4d4"  # points that have hardly deformed


def is_explicit(run):
    """Whether a run is one of explicit MPM."""
    try:
        with open(run.folder / "statistics.csv", encoding="utf-8") as file:
            return "stress work (J/m)" in file.readline()
    except OSError:
        return False


def draw_energy(plot, run, folder):
    """Draws energy.png: where the energy goes, and the residual of the balance."""
    table = plot.read_table(run.folder / "statistics.csv")
    time = table["time (s)"]
    lines = [(table[f"{key} (J/m)"], label, plot.COLORS[color])
             for key, label, color in ENERGIES if np.any(table.get(f"{key} (J/m)", 0.))]
    residual = table.get("energy residual (J/m)", np.zeros_like(time))
    if not lines:
        raise plot.Skipped("all energies are zero")
    figure, (axes, below) = plot.subplots(2, 1, figsize=(9., 6.2), sharex=True,
                                          gridspec_kw={"height_ratios": [3., 2.]})
    largest = max(np.max(np.abs(values)) for values, _, _ in lines)
    lines = [line for line in lines if np.max(np.abs(line[0])) > 1e-4 * largest]
    name, factor = unit_for(largest)
    for values, label, color in lines:
        axes.plot(time, values / factor, color=color, label=label)
    axes.set(title=f"{run.name}: energies", ylabel=f"energy ({name})")
    axes.legend(loc="upper left", bbox_to_anchor=(1., 1.02))
    name, factor = unit_for(np.max(np.abs(residual)))
    below.plot(time, residual / factor, color=plot.COLORS[-1])
    below.axhline(0., color="black", linewidth=0.8)
    below.set(title="residual of the balance (negative: taken by time steps and transfer)",
              xlabel="time (s)", ylabel=f"residual ({name})")
    percent = 100. * factor / largest
    below.secondary_yaxis("right", functions=(lambda y: y * percent,
                                              lambda y: y / percent)
                          ).set_ylabel("% of the largest\nenergy above")
    plot.save(figure, run, folder / "energy.png")


def unit_for(size):
    """The unit that energies up to a size are told in: its name and value."""
    for name, value in (("MJ/m", 1e6), ("kJ/m", 1e3), ("J/m", 1.), ("mJ/m", 1e-3),
                        ("µJ/m", 1e-6)):
        if size >= value:
            return name, value
    return "nJ/m", 1e-9


def draw_runout(plot, run, folder):
    """Draws runout.png: how far and how high the body reaches in time."""
    table = plot.read_table(run.folder / "statistics.csv")
    time, drawn = table["time (s)"], []
    for key, label, color, style in (
            ("x of 99 % of the mass (m)", "x of 99 % of the mass", 0, "-"),
            ("x largest (m)", "x of the farthest point", 0, ":"),
            ("x of 1 % of the mass (m)", "x of 1 % of the mass", 2, "-"),
            ("y largest (m)", "y of the highest point", 1, "-")):
        if key in table and np.ptp(table[key]) > 0.:
            drawn.append((table[key], label, plot.COLORS[color], style))
    size = max((np.max(np.abs(values)) for values, *_ in drawn), default=0.)
    drawn = [line for line in drawn if np.ptp(line[0]) > 0.01 * size]
    if not drawn:
        raise plot.Skipped("the outline of the body does not move")
    figure, axes = plot.subplots(figsize=(8., 4.6))
    for values, label, color, style in drawn:
        axes.plot(time, values, color=color, linestyle=style, label=label)
    axes.set(title=f"{run.name}: reach of the body", xlabel="time (s)",
             ylabel="coordinate (m)")
    axes.legend(loc="upper left", bbox_to_anchor=(1., 1.02))
    plot.save(figure, run, folder / "runout.png")


def snapshots_of(plot, run, times):
    """The fields at up to six times, and the box of all points but lone ones."""
    snapshots = plot.read_fields(run.folder / "points.pvd", chosen_times(times))
    if not snapshots:
        raise plot.Skipped("there are no points")
    points = np.concatenate([field.points for field, _ in snapshots])
    low, high = np.quantile(points, [0.005, 0.995], axis=0)
    reach = 0.1 * np.max(high - low)
    near = points[np.all((points >= low - reach) & (points <= high + reach), axis=1)]
    margin = 0.03 * np.ptp(near, axis=0).max()
    return snapshots, (near.min(axis=0) - margin, near.max(axis=0) + margin)


@functools.lru_cache(maxsize=4)
def chosen_times(times):
    """A function that chooses the wanted times, or six, from those of a series; the
    same one for the same times, so that the fields are read once."""
    def choose(series):
        wanted = times or np.linspace(series[0], series[-1], 6)
        return np.unique([np.argmin(np.abs(series - t)) for t in wanted])
    return choose


def draw_panels(plot, run, path, snapshots, view, values, norm, label, **options):
    """Draws the points at some times, coloured by values, with one colour bar."""
    figure, axes = plot.panels(len(snapshots), view)
    if np.ptp(view, axis=0)[0] > 5. * np.ptp(view, axis=0)[1]:  # flat
        for ax in axes:
            ax.yaxis.set_major_locator(MaxNLocator(2))
    colors = matplotlib.colormaps[options.get("colors", "viridis")].copy()
    colors.set_extremes(under=UNTOUCHED, bad=UNTOUCHED)
    for ax, ((points, _, data), time), value in zip(axes, snapshots, values):
        drawn = plot.disks(ax, points, data, value)
        drawn.set(cmap=colors, norm=norm)
        ax.add_collection(drawn)
        ax.set_title(f"t = {time:.3g} s")
        ax.label_outer()
    figure.suptitle(f"{run.name}: {label.rsplit(' (', 1)[0]}", fontsize=13)
    if figure.get_figheight() < 5.:
        label = label.replace(" stress", "\nstress").replace(" strain", "\nstrain")
    figure.colorbar(drawn, ax=list(axes), label=label, aspect=40, pad=0.02,
                    extend=options.get("extend", "neither"))
    plot.save(figure, run, path, cropped=True)


def column(snapshots, *names):
    """The values of the first of the names that the points have, at all times."""
    for name in names:
        if all(name in field.data for field, _ in snapshots):
            return [field.data[name][:, 0] for field, _ in snapshots]
    return None


def draw_points(plot, run, folder, times=None):
    """Draws points.png: plastic strain or, of an elastic body, shear stress."""
    snapshots, view = snapshots_of(plot, run, times)
    values = column(snapshots, "cumulative_plastic_strain")
    if values is not None and np.any(np.concatenate(values) > 0.):
        everything = np.concatenate(values)
        most = np.quantile(everything[everything > 0.], 0.99)
        draw_panels(plot, run, folder / "points.png", snapshots, view, values,
                    LogNorm(1e-3 * most, most), "cumulative plastic strain (-)",
                    extend="both")
        return
    parts = [column(snapshots, f"stress_{name}") for name in ("xx", "yy", "xy")]
    if None in parts:
        raise plot.Skipped("its points have neither plastic strain nor stress")
    values = [np.hypot((xx - yy) / 2., xy) for xx, yy, xy in zip(*parts)]
    most = np.quantile(np.concatenate(values), 0.995)
    draw_panels(plot, run, folder / "points.png", snapshots, view, values,
                Normalize(0., max(most, np.finfo(float).tiny)),
                "largest shear stress in the plane (Pa)", extend="max")


def draw_ratio(plot, run, folder, names, file, label, least, times=None):
    """Draws a ratio, between a least value and one or more, that some soils show."""
    snapshots, view = snapshots_of(plot, run, times)
    values = column(snapshots, *names)
    if values is None or not np.any(np.isfinite(np.concatenate(values))):
        raise plot.Skipped(f"its points have no {names[0]}")
    most = np.nanquantile(np.concatenate(values), 0.995)
    draw_panels(plot, run, folder / file, snapshots, view, values,
                Normalize(least, max(1., most) if most > least + 1e-3 else least + 1.),
                label, colors="cividis", extend="max" if most > 1. else "neither")


RATIOS = {"structure.png": (("structure_ratio", "Rb"), "structure ratio Rb (-)", 1.),
          "loading.png": (("subloading_ratio", "R"), "subloading ratio R (-)", 0.)}


def columns_of(run):
    """The names of what the points of a run have."""
    for file in sorted(run.folder.glob("points-*.vtu")):
        start = file.read_bytes().decode("ascii", "replace")
        return set(re.findall(r'Name="([^"]*)"', start))
    return set()


def pictures(plot, run, times=None):
    """The pictures of an explicit run: what draws them, by their names."""
    times = tuple(times) if times else None
    found = {"energy.png": functools.partial(draw_energy, plot),
             "runout.png": functools.partial(draw_runout, plot),
             "points.png": functools.partial(draw_points, plot, times=times)}
    for file, (names, label, least) in RATIOS.items():
        if columns_of(run) & set(names):
            found[file] = functools.partial(draw_ratio, plot, names=names, file=file,
                                            label=label, least=least, times=times)
    return found
