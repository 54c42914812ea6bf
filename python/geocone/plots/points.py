# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of material points at several times; of implicit runs plastic_strain.png or,
of an elastic body, shear_stress.png."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator

from geocone.plots import overlay
from geocone.plots.answer import heading, moment
from geocone.plots.point_values import (SHEAR, STRAIN, level_of, shear_stress, states_at,
                                        values_of, view_of)
from geocone.plots.solid import SolidLook
from geocone.style import STRAINS, Skipped, disks, panels, save


class Look:
    """Drawing of the points of some fields: in the plane as disks.

    box  that of the picture; words  that say from where it is seen"""

    words = ""

    def __init__(self, fields, reach):
        self.box = view_of(fields, reach)

    def collection(self, axes, field, values):
        """The points of a field, with their values."""
        return disks(axes, field, values)

    def draw(self, axes, field, values, colors, norm):
        """Draws the points of a field in the colours of their values. @return what is drawn"""
        drawn = self.collection(axes, field, values)
        drawn.set(cmap=colors, norm=norm)
        return axes.add_collection(drawn)

    def finish(self, axes):
        """Further settings of the axes."""
        if np.ptp(self.box, axis=0)[0] > 5. * np.ptp(self.box, axis=0)[1]:  # flat
            axes.yaxis.set_major_locator(MaxNLocator(2))

    def surroundings(self, axes, run, field):
        """Outlines, obstacles and water at the time of a field. @return what is drawn"""
        return overlay.draw_scene(axes, run, field)


def look_at(fields, values, reach):
    """The look of fields in the plane or in space; `reach` as in view_of()."""
    if fields[0].points.shape[1] == 3:
        return SolidLook(fields, values, reach)
    return Look(fields, reach)


def draw_panels(run, path, fields, look, values, norm, label, colors=STRAINS,
                extend="neither"):
    """Draws the points at some times, coloured by values, with one colour bar."""
    figure, axes = panels(len(fields), look.box)
    for ax, field, value in zip(axes, fields, values):
        look.draw(ax, field, value, colors, norm)
        look.surroundings(ax, run, field)
        ax.set_title(moment(run, field.time))
        look.finish(ax)
        ax.label_outer()
    figure.suptitle(heading(run, label.rsplit(" (", 1)[0] + look.words), fontsize=13)
    if figure.get_figheight() < 5.:
        label = label.replace(" stress", "\nstress").replace(" strain", "\nstrain")
    figure.colorbar(ScalarMappable(norm, colors), ax=list(axes), label=label, aspect=40,
                    pad=0.02, extend=extend)
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
        values, label = shear_stress(fields), SHEAR.replace("Pa", run.unit("Pa"))
        path = path.with_stem("shear_stress")
    draw_panels(run, path, fields, look_at(fields, values, lambda size: size / 2.),
                values, Normalize(0., level_of(fields, values)), label, extend="max")
