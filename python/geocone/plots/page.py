# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.html: one page for a run, which holds its numbers, pictures and parameters,
and needs nothing else to be looked at."""

import base64
import io
from pathlib import Path

import matplotlib
import numpy as np

from geocone.files import add_to_list, write_whole
from geocone.plots import points
from geocone.reader import Missing, ReadError
from geocone.style import STRAINS, PlotError, Skipped, draw_water

TEMPLATE = Path(__file__).with_name("run.html")
MOST_FRAMES = 16
MOST_BYTES = 4_500_000  # of a page, in pictures

# What a reader asks for first, and what it is called.
TOPICS = {"safety": "Factor of safety", "bounds": "Bounds", "limit_load": "Load",
          "non_associated": "Less dilatancy than friction",
          "reference": "Reference", "contact": "Contact", "failure": "Failure",
          "points": "Observed points", "motion": "Motion", "energy": "Energy",
          "newton": "Newton's method", "quality": "Quality of the solution",
          "state": "State", "size": "Size", "cost": "Cost"}
CAPTIONS = {
    "load_displacement.png": "Load against displacement",
    "safety.png": "Displacement while the strength is reduced",
    "bounds.png": "Both bounds and their gap",
    "mechanism.png": "Where the bounds differ, and the mechanisms of both",
    "plastic_strain_rate.png": "Where the soil flows at the end",
    "excess_pore_pressure.png": "Excess pore pressure at the end",
    "plastic_strain.png": "Plastic strain of the material points",
    "energy.png": "Energies", "newton.png": "Newton's method: residuals"}


def text_of(value):
    """A value of the summary as the page shows it."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    return str(value)


def numbers_of(run):
    """The topics of the summary: title, and rows of name and value."""
    known = {key: run.summary[key] for key in TOPICS if key in run.summary}
    others = {key: value for key, value in run.summary.items()
              if key not in TOPICS and isinstance(value, dict) and key != "run"}
    return [(TOPICS.get(key, key.replace("_", " ")),
             [(name.replace("_", " "), text_of(value)) for name, value in topic.items()
              if not isinstance(value, (dict, list))])
            for key, topic in {**known, **others}.items() if isinstance(topic, dict)]


def as_data(content):
    """A picture as a page holds it."""
    return "data:image/png;base64," + base64.b64encode(content).decode()


def frame_of(run, field, look, values, norm):
    """A small picture of the points at a time."""
    figure, (axes,) = points.panels(1, look.box)
    look.finish(axes)
    drawn = look.collection(axes, field, values)
    drawn.set(cmap=STRAINS, norm=norm)
    axes.add_collection(drawn)
    draw_water(axes, run)
    axes.set_title(f"t = {field.time:.4g} s")
    figure.colorbar(drawn, ax=axes, shrink=0.8)
    stream = io.BytesIO()
    with matplotlib.rc_context({"savefig.bbox": None}):
        figure.savefig(stream, dpi=90, format="png")
    return stream.getvalue()


def frames_of(run):
    """The points at the times of output, or at some of them: pictures for a slider,
    and what they show; nothing where there is one time only."""
    try:
        times = run.times("points")
        if len(times) < 2:
            return [], ""
        chosen = np.unique(np.linspace(0, len(times) - 1,
                                       min(len(times), MOST_FRAMES)).astype(int))
        fields = run.states("points", tuple(int(i) for i in chosen))
        values, label, norm, _ = points.strain_or_shear(fields)
        look = points.look_at(fields, values, lambda size: 0.5 * size)
    except (Missing, Skipped):
        return [], ""
    return [{"time": f"{field.time:.4g} s",
             "data": as_data(frame_of(run, field, look, value, norm))}
            for field, value in zip(fields, values)], label


def write_page(run, folder, names):
    """Writes report.html beside the pictures.

    @param names of the pictures, in their order; those that are not there are left out
    @return the path"""
    try:
        import jinja2
    except ImportError as error:
        raise PlotError(f"report.html needs python3-jinja2: {error}")
    frames, shown = frames_of(run)
    size, pictures = sum(len(frame["data"]) for frame in frames), []
    for name in names:
        path = folder / name
        if not path.is_file():
            continue
        data = as_data(path.read_bytes())
        size += len(data)
        if size <= MOST_BYTES:
            pictures.append({"name": name, "data": data,
                             "caption": CAPTIONS.get(name, name.rsplit(".", 1)[0]
                                                     .replace("_", " "))})
    try:
        parameters = (run.folder / "parameters.prm").read_text(errors="replace")
    except OSError:
        parameters = ""
    environment = jinja2.Environment(autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    try:
        page = environment.from_string(TEMPLATE.read_text()).render(
            run=run, numbers=numbers_of(run), pictures=pictures, frames=frames,
            shown=shown, parameters=parameters)
    except jinja2.TemplateError as problem:
        raise ReadError(f"the page of '{run.folder}' cannot be made: {problem}")
    path = folder / "report.html"
    write_whole(path, page)
    add_to_list(path)
    return path
