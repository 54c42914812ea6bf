# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.html: one page for a run, which begins with its answer and its scene, holds
pictures, numbers and parameters, and needs nothing else to be looked at or printed."""

import base64
import io
import re
import struct
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from PIL import Image

from geocone.files import write_listed
from geocone.plots import bounds, load, points, rates
from geocone.plots.answer import answer_of, meaning_of, moment
from geocone.plots.point_values import strain_or_shear
from geocone.plots.scene_tables import tables_of
from geocone.reader import Missing, ReadError
from geocone.style import STRAINS, PlotError, Skipped

TEMPLATE = Path(__file__).with_name("run.html")
MOST_FRAMES = 16
MOST_BYTES = 4_500_000  # of a page, in pictures
LARGE = 100_000  # bytes of a picture

# Results shown first, and their captions.
TOPICS = {"safety": "Factor of safety", "seepage": "Seepage", "bounds": "Bounds", "limit_load": "Load",
          "non_associated": "Less dilatancy than friction",
          "reference": "Reference", "contact": "Contact",
          "structures": "Structures", "failure": "Failure",
          "points": "Observed points", "motion": "Motion", "energy": "Energy",
          "newton": "Newton's method", "quality": "Quality of the solution",
          "state": "State", "start": "At the start", "final": "At the end",
          "extremes": "Least and most", "size": "Size", "cost": "Cost"}
# Topics and numbers that are folded away: they describe the computation.
COMPUTATION = ("newton", "quality", "size", "cost", "state", "energy", "friction_memory")
OF_SOLVER = ("penetration_max", "natural_map_error_max")  # numbers of contact, likewise
OF_BOUNDS = ("unit", "lower", "upper", "middle", "gap", "certified")  # those that are results
# Captions of pictures, in the order in which a reader wants to see them.
CAPTIONS = {
    "model.png": "The model", "load_displacement.png": "Load against displacement",
    "safety.png": "Displacement while the strength is reduced",
    "plates.png": "Moments, forces and displacements of plates at the ends of stages",
    "mechanism.png": "How the body fails, and where the bounds differ",
    "structures.png": "Where structures yield, and their forces",
    "dependence.png": "What the bounds depend on",
    "principal_stresses.png": "Principal stresses at the end",
    "plastic_strain_rate.png": "Where the soil yields at the end, and how it moves",
    "excess_pore_pressure.png": "Excess pore pressure",
    "plastic_strain.png": "Plastic strain of the material points",
    "shear_stress.png": "Largest shear stress of the material points",
    "points.png": "The material points at some times", "runout.png": "Reach of the body",
    "slide.png": "The slide", "structure.png": "Structure of the soil",
    "loading.png": "Loading ratio of the soil",
    "flow_net.png": "Pore pressures, heads and flow",
    "stress_strain.png": "Stress against strain", "stress_path.png": "Stress path",
    "compression.png": "Compression", "ratios.png": "Ratios of the soil's memory"}
# Pictures of the computation, which are folded away too.
OF_COMPUTATION = {"bounds.png": "Both bounds and their gap",
                  "discharge.png": "Discharge by mesh", "energy.png": "Energies",
                  "newton.png": "Newton's method: residuals"}
# The unit at the end of a name of the summary, as in "angular_N_m_s_per_m".
UNIT = re.compile(r"_((?:(?:MB|k?Pa|kg|t|k?J|k?N|m|m2|m3|s)_)*(?:MB|k?Pa|kg|t|k?J|k?N|m|m2|m3|s)"
                  r"(?:_per_(?:m|s))?)(_least|_most)?$")
LONG = 32  # texts from here on have a line of their own


def text_of(value):
    """A value of the summary as the page shows it."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    return " Remedy: ".join(part.strip() for part in str(value).split("remedy:"))


def name_of(key):
    """A name of the summary in words, with its unit: "work_J_per_m" is "work (J/m)"."""
    words = UNIT.sub(lambda found: f"{found[2] or ''} (" + found[1]
                     .replace("_per_", "/").replace("_", " ") + ")", f"_{key}")
    return words.replace("_", " ").strip()


def title_of(topic, run):
    """Title of a topic of the summary. Bounds that made the mesh of a strength
    reduction by steps are those of a load: they say nothing of the factor of safety."""
    if (topic == "bounds" and "safety" in run.summary and
            run.method != "strength reduction"):
        return "Bounds of the factor of all loads at full strength"
    return TOPICS.get(topic, topic.replace("_", " ").capitalize())


def is_shown(topic, name, value, results):
    """Whether a number of the summary is among the results, or else among those of the
    computation. Results that there are not are left out, but for the main ones."""
    if isinstance(value, (dict, list)) or is_result(topic, name) != results:
        return False
    return value is not None or not results or name in ("value", "factor")


def is_result(topic, name):
    """Whether a number of the summary is a result, not one of the computation."""
    return (topic not in COMPUTATION and name not in OF_SOLVER and
            (topic != "bounds" or name in OF_BOUNDS))


def numbers_of(run, results=True):
    """The topics of the summary, of results or of the computation: title, and rows of name,
    value, the exact value with its path, and whether it is long."""
    known = {key: run.summary[key] for key in TOPICS if key in run.summary}
    others = {key: value for key, value in run.summary.items()
              if key not in TOPICS and key not in ("run", "stages")}
    found = [(title_of(key, run),
              [(name_of(name), text_of(value), f"{key}/{name} = {value}",
                len(text_of(value)) > LONG)
               for name, value in topic.items() if is_shown(key, name, value, results)])
             for key, topic in {**known, **others}.items() if isinstance(topic, dict)]
    if results:
        found.append(("What the bounds depend on: % per %", dependence_rows(run)))
        found.append(("For all parameters of the intervals", interval_rows(run)))
    return [(title, rows) for title, rows in found if rows]


def dependence_rows(run):
    """Rows of numbers_of() for the gradients of bounds."""
    return [(name, f"{lower:.3f} (lower), {upper:.3f} (upper)",
             f"{name}: {lower!r}, {upper!r}", False)
            for name, lower, upper in bounds.dependence_of(run)]


def interval_rows(run):
    """Rows of numbers_of() for the bounds of a whole box of parameters."""
    interval = run.summary.get("bounds", {}).get("interval", {})
    rows = [(side, text_of(interval[side]), f"bounds/interval/{side} = {interval[side]!r}", False)
            for side in ("lower", "upper") if side in interval]
    for name, limits in interval.get("intervals", {}).items():
        limits = limits if isinstance(limits, list) else [limits]
        rows.append((name, " to ".join(text_of(limit) for limit in limits),
                     f"{name}: {limits!r}", False))
    return rows


def is_wide(png):
    """Whether a picture is so wide that half of the page would make it too small."""
    width, height = struct.unpack(">II", png[16:24])
    return width > 2.5 * height


def as_data(content):
    """A picture as a page holds it: a large one with 256 colours, a third of its bytes."""
    if len(content) > LARGE:
        picture = Image.open(io.BytesIO(content)).convert("RGB")
        stream = io.BytesIO()
        picture.quantize(256, dither=Image.Dither.NONE).save(stream, "PNG")
        content = min(content, stream.getvalue(), key=len)
    return "data:image/png;base64," + base64.b64encode(content).decode()


def frame_of(run, field, look, values, norm):
    """A small picture of the body at a time."""
    figure, (axes,) = points.panels(1, look.box)
    look.finish(axes)
    look.draw(axes, field, values, STRAINS, norm)
    look.surroundings(axes, run, field)
    axes.set_title(moment(run, field.time))
    figure.colorbar(ScalarMappable(norm, STRAINS), ax=axes, shrink=0.8)
    stream = io.BytesIO()
    with matplotlib.rc_context({"savefig.bbox": None}):
        figure.savefig(stream, dpi=90, format="png")
    return stream.getvalue()


class CellsLook(points.Look):
    """Drawing of the cells of some fields in the plane."""

    def collection(self, axes, field, values):
        """The cells of a field, with their values."""
        return rates.cells_of(field, values)


def frames_of(run):
    """The body at the times of output, or at some of them: pictures for a slider, and
    what they show; nothing where there is one time only. In the plane, points that stay
    are shown by their cells."""
    try:
        last, = run.states("points")
        cells = "displacement" not in last.data and last.points.shape[1] == 2
        series = "cells" if cells else "points"
        times = run.times(series)
        if len(times) < 2:
            return [], ""
        chosen = np.unique(np.linspace(0, len(times) - 1,
                                       min(len(times), MOST_FRAMES)).astype(int))
        fields = run.states(series, tuple(int(i) for i in chosen))
        values, label, norm, _ = strain_or_shear(run, fields)
        look = (CellsLook(fields, lambda size: 0.5 * size) if cells else
                points.look_at(fields, values, lambda size: 0.5 * size))
    except (Missing, Skipped):
        return [], ""
    return [{"time": moment(run, field.time),
             "data": as_data(frame_of(run, field, look, value, norm))}
            for field, value in zip(fields, values)], label


def caption_of(run, name):
    """The caption of a picture."""
    if name == "load_displacement.png" and load.is_at_rest(load.curve_of(run)):
        return "Load against time"
    return CAPTIONS.get(name) or OF_COMPUTATION.get(name) or Path(name).stem.replace("_", " ")


class Pictures:
    """The pictures in a folder as a page holds them, as long as there is room.

    left_out  names of those for which there was none"""

    def __init__(self, run, folder, room):
        self.run, self.folder, self.room, self.left_out = run, folder, room, []

    def take(self, names):
        """The pictures of some names that are there: data, caption, whether they are wide."""
        taken = []
        for name in names:
            path = self.folder / name
            if name == "plastic_strain.png" and not path.is_file():
                path = path.with_name("shear_stress.png")  # of an elastic body
            if not path.is_file():
                continue
            content = path.read_bytes()
            data = as_data(content)
            if len(data) > self.room:
                self.left_out.append(path.name)
                continue
            self.room -= len(data)
            taken.append({"data": data, "wide": is_wide(content),
                          "caption": caption_of(self.run, path.name)})
        return taken


def write_page(run, folder, names):
    """Writes report.html beside the pictures.

    @param names of the pictures; those that are not there are left out
    @return the path"""
    try:
        import jinja2
    except ImportError as error:
        raise PlotError(f"report.html needs python3-jinja2: {error}")
    frames, shown = frames_of(run)
    pictures = Pictures(run, folder, MOST_BYTES - sum(len(frame["data"]) for frame in frames))
    model = pictures.take(["model.png"])
    results = pictures.take([
        *(name for name in CAPTIONS if name in names and name != "model.png"),
        *(name for name in names if name not in CAPTIONS and name not in OF_COMPUTATION)])
    computation = pictures.take([name for name in OF_COMPUTATION if name in names])
    try:
        parameters = (run.folder / "parameters.prm").read_text(errors="replace")
    except OSError:
        parameters = ""
    environment = jinja2.Environment(autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    try:
        page = environment.from_string(TEMPLATE.read_text()).render(
            run=run, status=text_of(run.status), answer=answer_of(run),
            meaning=meaning_of(run), started=str(run.value("run/started") or ""),
            model=model, tables=tables_of(run), results=results, numbers=numbers_of(run),
            computation=computation, of_computation=numbers_of(run, False),
            left_out=pictures.left_out, frames=frames, shown=shown, parameters=parameters)
    except jinja2.TemplateError as problem:
        raise ReadError(f"the page of '{run.folder}' cannot be made: {problem}")
    path = folder / "report.html"
    write_listed(path, page)
    return path
