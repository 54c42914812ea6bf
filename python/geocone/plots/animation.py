# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Films: the points of a run at all times at which fields were written, coloured by their
plastic strain or, of an elastic body, by the largest shear stress in the plane. points.gif,
points_film.png (an animated PNG), or points.mp4, which the program ffmpeg writes."""

import io
import shutil
import subprocess

import numpy as np
from matplotlib.cm import ScalarMappable
from PIL import Image

from geocone.files import write_listed
from geocone.plots.answer import moment
from geocone.plots.point_values import strain_or_shear
from geocone.plots.points import look_at
from geocone.style import STRAINS, PlotError, Skipped, panels, plain

SECONDS = 8.  # that a film takes
MOST = 200  # pictures
DOTS = 88  # per inch: films of many pictures are large
COLORS_OF_GIF = 127  # and one that is transparent


def mp4_of(frames, seconds):
    """The content of an MP4 file of some pictures.
    @throw PlotError without ffmpeg, or if it fails"""
    program = shutil.which("ffmpeg")
    if program is None:
        raise PlotError("a film as .mp4 needs the program ffmpeg; Debian has it in ffmpeg; "
                        "--animation and --apng need nothing")
    width, height = (size // 2 * 2 for size in frames[0].size)  # the format wants even ones
    # A pipe cannot be searched: such a file is of fragments.
    words = [program, "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
             f"{width}x{height}", "-framerate", f"{len(frames) / seconds:.4f}", "-i", "-",
             "-pix_fmt", "yuv420p", "-movflags", "frag_keyframe+empty_moov", "-f", "mp4", "-"]
    ended = subprocess.run(words, capture_output=True, check=False, input=b"".join(
        frame.crop((0, 0, width, height)).tobytes() for frame in frames))
    if ended.returncode != 0:
        raise PlotError(f"ffmpeg has failed: {ended.stderr.decode(errors='replace').strip()}")
    return ended.stdout


def gif_of(frames, seconds):
    """The content of a GIF of some pictures, which have the same colours: white, black and
    those of four of them. Pixels that do not change are transparent, which halves the file."""
    width, height = frames[0].size
    some = Image.new("RGB", (width, 4 * height))
    for k in range(4):
        some.paste(frames[k * (len(frames) - 1) // 3], (0, k * height))
    palette = some.quantize(COLORS_OF_GIF - 2, dither=Image.NONE)
    colors = [255] * 3 + [0] * 3 + palette.getpalette()[:3 * (COLORS_OF_GIF - 2)]
    palette.putpalette(colors + colors[:3] * (256 - COLORS_OF_GIF))
    images, last = [], None
    for frame in frames:
        now = np.array(frame.quantize(palette=palette, dither=Image.NONE))
        # Pillow takes colours that are nearly the nearest ones.
        now[np.all(np.asarray(frame) == 255, axis=2)] = 0
        images.append(Image.fromarray(
            now if last is None else np.where(now == last, COLORS_OF_GIF, now).astype(np.uint8),
            "P"))
        images[-1].putpalette(colors + colors[:3])
        last = now
    film = io.BytesIO()
    images[0].save(film, format="gif", save_all=True, append_images=images[1:],
                   duration=round(1e3 * seconds / len(images)), loop=0, disposal=1,
                   transparency=COLORS_OF_GIF, optimize=False)
    return film.getvalue()


def png_of(frames, seconds):
    """The content of an animated PNG of some pictures."""
    film = io.BytesIO()
    frames[0].save(film, format="png", save_all=True, append_images=frames[1:],
                   duration=round(1e3 * seconds / len(frames)), loop=0)
    return film.getvalue()


WRITERS = {".gif": gif_of, ".png": png_of, ".mp4": mp4_of}


def draw(run, paths):
    """Draws the film of a run, as a GIF (of 128 colours), an animated PNG or an MP4 file each,
    by the ends of their names."""
    series = run.times("points")
    if len(series) < 2:
        raise Skipped("fewer than two times have points")
    chosen = np.unique(np.linspace(0, len(series) - 1, min(MOST, len(series))).astype(int))
    fields = run.states("points", tuple(chosen))
    values, label, norm, extend = strain_or_shear(run, fields)
    look = look_at(fields, values, lambda size: 0.1 * np.max(size))
    figure, (axes,) = panels(1, look.box)
    # The colour bar is below, not beside the axes.
    figure.set_size_inches(*(figure.get_size_inches() + [-0.9, 0.8]))
    figure.set_dpi(DOTS)
    look.finish(axes)
    figure.colorbar(ScalarMappable(norm, STRAINS), ax=axes, label=label, aspect=40,
                    location="bottom", extend=extend)
    frames = []
    for field, value in zip(fields, values):
        drawn = look.draw(axes, field, value, STRAINS, norm)
        around = look.surroundings(axes, run, field)
        axes.set_title(f"{plain(run.name)}: {moment(run, field.time)}")
        figure.canvas.draw()
        frames.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
        for artist in [drawn, *around]:
            artist.remove()
    for path in paths:
        write_listed(path, WRITERS[path.suffix](frames, SECONDS))
        print(path)
