# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of material points at several times; of implicit runs plastic_strain.png or,
of an elastic body, shear_stress.png."""

import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.ticker import MaxNLocator

from geocone.reader import nearest
from geocone.style import STRAINS, Skipped, disks, draw_obstacles, panels, plain, save

STRAIN = "cumulative_plastic_strain"
SHEAR = "largest shear stress in the plane (Pa)"


def states_at(run, wanted):
    """The states of the points of a run at the times nearest to those wanted."""
    return run.states("points", tuple(nearest(run.times("points"), wanted)))


def values_of(fields, *names):
    """The values of the first of the names that the points have, a list over the
    fields; or None."""
    for name in names:
        if all(name in field.data for field in fields):
            return [field.data[name][:, 0] for field in fields]
    return None


def shear_stress(fields):
    """The largest shear stress in the plane (Pa), a list over the fields."""
    parts = [values_of(fields, f"stress_{name}") for name in ("xx", "yy", "xy")]
    if None in parts:
        raise Skipped("its points have neither plastic strain nor stress")
    return [np.hypot((xx - yy) / 2., xy) for xx, yy, xy in zip(*parts)]


def strain_or_shear(fields):
    """What is shown of points: plastic strain, on a scale of its logarithm, or the
    shear stress of an elastic body.

    @return values, a list over the fields; their name; their scale; its open ends"""
    values = values_of(fields, STRAIN)
    if values is not None and np.any(np.concatenate(values) > 0.):
        everything = np.concatenate(values)
        most = np.quantile(everything[everything > 0.], 0.99)
        return (values, "cumulative plastic strain (-)", LogNorm(1e-3 * most, most),
                "both")
    values = shear_stress(fields)
    most = np.quantile(np.concatenate(values), 0.995)
    return values, SHEAR, Normalize(0., max(most, np.finfo(float).tiny)), "max"


def view_of(fields, reach):
    """The box of all points but those that have flown far away: farther from the box of
    nearly all of them than `reach` tells of its size (2)."""
    points = np.concatenate([field.points for field in fields])
    low, high = np.quantile(points, [0.005, 0.995], axis=0)
    far = reach(high - low)
    near = points[np.all((points >= low - far) & (points <= high + far), axis=1)]
    margin = 0.03 * np.ptp(near, axis=0).max()
    return near.min(axis=0) - margin, near.max(axis=0) + margin


class Look:
    """How the points of some fields are looked at: in the plane as disks.

    box  that of the picture; words  that tell from where it is seen"""

    words = ""

    def __init__(self, fields, reach):
        self.box = view_of(fields, reach)

    def collection(self, axes, field, values):
        """The points of a field, in the colours of their values."""
        return disks(axes, field, values)

    def finish(self, axes):
        """What the axes need besides."""
        if np.ptp(self.box, axis=0)[0] > 5. * np.ptp(self.box, axis=0)[1]:  # flat
            axes.yaxis.set_major_locator(MaxNLocator(2))


def look_at(fields, values, reach):
    """The look of fields in the plane or in space; `reach` as in view_of()."""
    if fields[0].points.shape[1] == 3:
        from geocone.plots import solid
        return solid.SolidLook(fields, values, reach)
    return Look(fields, reach)


def draw_panels(run, path, fields, look, values, norm, label, colors=STRAINS,
                extend="neither"):
    """Draws the points at some times, coloured by values, with one colour bar."""
    figure, axes = panels(len(fields), look.box)
    for ax, field, value in zip(axes, fields, values):
        drawn = look.collection(ax, field, value)
        drawn.set(cmap=colors, norm=norm)
        ax.add_collection(drawn)
        draw_obstacles(ax, run, field.time)
        ax.set_title(f"t = {field.time:.4g} s")
        look.finish(ax)
        ax.label_outer()
    title = f"{plain(run.name)}: {label.rsplit(' (', 1)[0]}{look.words}"
    if len(fields) == 1:
        axes[0].set_title(f"{title}, {axes[0].get_title()}")
    else:
        figure.suptitle(title, fontsize=13)
    if figure.get_figheight() < 5.:
        label = label.replace(" stress", "\nstress").replace(" strain", "\nstrain")
    figure.colorbar(drawn, ax=list(axes), label=label, aspect=40, pad=0.02,
                    extend=extend)
    save(figure, run, path, cropped=True)


def draw_strains(run, path, times=None):
    """Draws how points that move deform, at up to four times."""
    series = run.times("points")
    started = series[series > 0.]
    if not times and not len(started):
        raise Skipped("its points do not move")
    fields = states_at(run, times or np.linspace(*started[[0, -1]], 4))
    if "displacement" not in fields[0].data:
        raise Skipped("its points do not move")
    values, label = values_of(fields, STRAIN), "cumulative plastic strain (-)"
    if not np.any(np.concatenate(values)):
        # Nothing yields in an elastic body: its stress is shown.
        values, label = shear_stress(fields), SHEAR
        path = path.with_name("shear_stress.png")
    norm = Normalize(0., max(np.max(np.concatenate(values)), np.finfo(float).tiny))
    draw_panels(run, path, fields, look_at(fields, values, lambda size: size / 2.),
                values, norm, label)
