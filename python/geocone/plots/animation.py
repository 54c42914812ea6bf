# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""points.gif, or points_film.png: the points of a run at all times at which fields were
written, coloured by their plastic strain or, of an elastic body, by the largest shear
stress in the plane."""

import io

import numpy as np
from PIL import Image

from geocone.files import write_listed
from geocone.plots.point_values import strain_or_shear
from geocone.plots.points import look_at
from geocone.style import STRAINS, Skipped, draw_obstacles, panels, plain

SECONDS = 8.  # that a film takes
MOST = 200  # pictures


def draw(run, paths):
    """Draws the film of a run, as a GIF (of 128 colours) or an animated PNG each, by the
    ends of their names."""
    series = run.times("points")
    if len(series) < 2:
        raise Skipped("fewer than two times have points")
    chosen = np.unique(np.linspace(0, len(series) - 1, min(MOST, len(series))).astype(int))
    fields = run.states("points", tuple(chosen))
    values, label, norm, extend = strain_or_shear(fields)
    look = look_at(fields, values, lambda size: 0.1 * np.max(size))
    figure, (axes,) = panels(1, look.box)
    look.finish(axes)
    bar, films = None, {path: [] for path in paths}
    for field, value in zip(fields, values):
        drawn = look.collection(axes, field, value)
        drawn.set(cmap=STRAINS, norm=norm)
        axes.add_collection(drawn)
        obstacles = draw_obstacles(axes, run, field.time)
        bar = bar or figure.colorbar(drawn, ax=axes, label=label, aspect=40,
                                     location="bottom", extend=extend)
        axes.set_title(f"{plain(run.name)}: t = {field.time:.4g} s")
        figure.canvas.draw()
        frame = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
        for path, frames in films.items():
            frames.append(frame.quantize(128) if path.suffix == ".gif" else frame)
        drawn.remove()
        obstacles.remove()
    for path, frames in films.items():
        film = io.BytesIO()
        frames[0].save(film, format=path.suffix[1:], save_all=True,
                       append_images=frames[1:],
                       duration=round(1e3 * SECONDS / len(frames)), loop=0)
        write_listed(path, film.getvalue())
        print(path)
