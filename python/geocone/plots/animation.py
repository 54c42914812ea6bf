# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""points.gif: the points of a run at all times at which fields were written, coloured by
their plastic strain or, of an elastic body, by the largest shear stress in the plane."""

import numpy as np
from matplotlib.colors import LogNorm, Normalize
from PIL import Image

from geocone.plots.points import SHEAR, STRAIN, shear_stress, values_of, view_of
from geocone.style import STRAINS, Skipped, disks, panels, plain

SECONDS = 8.  # that a film takes
MOST = 200  # pictures


def scale_of(values):
    """Colours for plastic strain: logarithmic, to what nearly all points have."""
    everything = np.concatenate(values)
    most = np.quantile(everything[everything > 0.], 0.99)
    return LogNorm(1e-3 * most, most)


def draw(run, path):
    """Draws the film of a run."""
    series = run.times("points")
    if len(series) < 2:
        raise Skipped("fewer than two times have points")
    chosen = np.unique(np.linspace(0, len(series) - 1, min(MOST, len(series))).astype(int))
    fields = run.states("points", tuple(chosen))
    values, label = values_of(fields, STRAIN), "cumulative plastic strain (-)"
    if values is not None and np.any(np.concatenate(values) > 0.):
        norm = scale_of(values)
    else:
        values, label = shear_stress(fields), SHEAR
        norm = Normalize(0., max(np.max(np.concatenate(values)), np.finfo(float).tiny))
    figure, (axes,) = panels(1, view_of(fields, lambda size: 0.1 * np.max(size)))
    bar, frames = None, []
    for field, value in zip(fields, values):
        drawn = disks(axes, field, value)
        drawn.set(cmap=STRAINS, norm=norm)
        axes.add_collection(drawn)
        bar = bar or figure.colorbar(drawn, ax=axes, label=label, aspect=40,
                                     location="bottom")
        axes.set_title(f"{plain(run.name)}: t = {field.time:.4g} s")
        figure.canvas.draw()
        frames.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba()))
                      .convert("RGB").quantize(128))
        drawn.remove()
    temporary = path.with_name(path.name + ".part")
    frames[0].save(temporary, format="GIF", save_all=True, append_images=frames[1:],
                   duration=round(1e3 * SECONDS / len(frames)), loop=0)
    temporary.replace(path)
