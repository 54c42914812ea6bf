# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the results of geocone runs.

For each run folder, as far as the files for them exist:
  model.png                        model.json: soils, mesh, supports, loads, stages
  load_displacement.png, .svg      statistics.csv, the reference and the plateau
  plates.png                       plates.csv: moments, forces and displacements of plates
  newton.png                       newton.csv: the residuals of all steps
  energy.png                       statistics.csv: where the energy goes
  plastic_strain_rate.png          the last cells-*.vtu, or points-*.vtu if they move, with
                                   the displacement (or the velocity)
  principal_stresses.png           the last cells-*.vtu, points-*.vtu or bounds-*.vtu, if
                                   Output/Principal stresses = true (or by --stresses)
  excess_pore_pressure.png         the last cells-*.vtu or points-*.vtu of undrained soil
  plastic_strain.png               points-*.vtu at several times, if they move;
                                   shear_stress.png of an elastic body instead
of an explicit run energy.png, runout.png, points.png (plastic strain or shear stress at
six times), slide.png where points are taken away, structure.png and loading.png of soils
with such ratios, excess_pore_pressure.png where pore water flows; of an element test
stress_strain.png, stress_path.png, compression.png and ratios.png; of seepage
flow_net.png and discharge.png.
Of each run also report.html, a page with all of it, and, of fields, paraview_state.py,
which opens them in ParaView. With --format svg or pdf only pictures are drawn, as vectors.
Films show all times at which fields were written; for 50 pictures or more let a stage write
them so often by 'Loading/STAGE/Output every'.
"""

import argparse
import contextlib
import sys
import warnings
from pathlib import Path

from geocone.reader import Missing, ReadError, Run, reason

try:
    from geocone.style import PlotError, Skipped, finish, plain
except ImportError as error:
    sys.exit(f"error: {error}; Debian has it in python3-matplotlib")


def pictures_of(run, times=None):
    """Drawing functions of the pictures of a run, by name: functions of the run and the path.
    Modules are loaded for what is drawn only."""
    if run.method == "point":
        from geocone.plots import element
        return element.pictures(run)
    found = pictures_of_method(run, times)
    if run.parameters.get("Output/Principal stresses") == "true":
        from geocone.plots import stresses
        found["principal_stresses.png"] = stresses.draw_run
    return found


def pictures_of_method(run, times):
    """The pictures that all runs of a method have."""
    if run.method in ("limit load", "strength reduction"):
        from geocone.plots import bounds
        return bounds.pictures(run)
    if run.method == "seepage":
        from geocone.plots import seepage
        return seepage.pictures(run)
    if run.method == "reliability":
        from geocone.plots import reliability
        return reliability.pictures(run)
    if run.method == "shakedown":
        from geocone.plots import shakedown
        return shakedown.pictures(run)
    if run.method == "explicit MPM":
        from geocone.plots import explicit
        return explicit.pictures(run, times)
    from geocone.plots import energy, load, newton, plates, points, pressures, rates, safety
    curve = ({"safety.png": safety.draw_run} if "safety" in run.summary else
             {"load_displacement.png": load.draw_run})
    undrained = ({"excess_pore_pressure.png": pressures.draw_run}
                 if pressures.is_undrained(run) else {})
    bending = ({"plates.png": plates.draw_run}
               if (run.folder / "plates.csv").is_file() else {})
    return {**curve, **bending, **undrained,
            "newton.png": newton.draw_run,
            "energy.png": energy.draw_implicit,
            "plastic_strain_rate.png": rates.draw_run,
            "plastic_strain.png": lambda run, path: points.draw_strains(run, path, times)}


def draw_run(run, folder, times=None, kind="png"):
    """Draws all pictures of a run into a folder, and the page of those that are png."""
    from geocone.plots import model
    folder.mkdir(parents=True, exist_ok=True)
    try:
        pictures = {"model.png": model.draw_run, **pictures_of(run, times)}
        for name, draw in pictures.items():
            with contextlib.suppress(Missing, Skipped):  # e.g. nothing flows
                draw(run, (folder / name).with_suffix(f".{kind}"))
        finish()  # the page holds the pictures
        if kind != "png":
            return
        from geocone.plots import page
        print(page.write_page(run, folder, pictures))
        write_state(run, folder)
    except (PlotError, ReadError, OSError):
        raise
    except Exception as problem:  # damaged results may fail anywhere
        raise PlotError(f"what is in '{run.folder}' cannot be drawn: {reason(problem)}")


def draw_models(folders, output, kind="png"):
    """Draws the models of runs, or of checks, each into its folder or into one in another."""
    from geocone.plots import model
    for folder in folders:
        below = output / folder.resolve().name if output else folder
        below.mkdir(parents=True, exist_ok=True)
        model.draw(folder, below / f"model.{kind}")
    finish()


def write_state(run, folder):
    """Writes the script that opens the run's fields in ParaView, where there are any."""
    from geocone.plots import paraview
    with contextlib.suppress(Missing, Skipped):
        print(paraview.write_state(run, folder))


def numbers(text):
    """Numbers that are separated by commas."""
    return [float(word) for word in text.split(",")]


def main(arguments, prog="plot"):
    """Draws what the command line asks for; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="RUN-FOLDER")
    parser.add_argument("--output", type=Path, metavar="DIR",
                        help="folder of the pictures (of several runs: a folder "
                        "in it for each) instead of the run's own")
    parser.add_argument("--compare", type=Path, metavar="FILE.png",
                        help="only draw the curves of all runs, into this picture")
    parser.add_argument("--table", type=Path, metavar="FILE.md",
                        help="only print a table of all runs, also into this file")
    parser.add_argument("--times", type=numbers, metavar="T1,T2,...",
                        help="times of the pictures of points (s)")
    parser.add_argument("--animation", dest="films", action="append_const",
                        const="points.gif",
                        help="only draw points.gif, a film of the points")
    parser.add_argument("--apng", dest="films", action="append_const",
                        const="points_film.png",
                        help="only draw points_film.png, the same film as an animated "
                        "PNG, in all its colours")
    parser.add_argument("--mp4", dest="films", action="append_const", const="points.mp4",
                        help="only draw points.mp4, the same film, by the program ffmpeg")
    parser.add_argument("--format", choices=("png", "svg", "pdf"), default="png",
                        help="of the pictures; report.html, which holds them, comes with png "
                        "only")
    parser.add_argument("--paraview", action="store_true",
                        help="only write paraview_state.py, which opens the fields in "
                        "ParaView")
    parser.add_argument("--stresses", action="store_true",
                        help="only draw principal_stresses.png, crosses of the principal "
                        "stresses")
    parser.add_argument("--model", action="store_true",
                        help="only draw model.png, also of a folder of --dry-run --picture")
    call = parser.parse_args(arguments)
    # Fonts lack characters of some names; what is not finite is not drawn.
    warnings.simplefilter("ignore")
    for stream in (sys.stdout, sys.stderr):  # names of files may be no text
        stream.reconfigure(errors="backslashreplace")
    try:
        if call.model:
            draw_models(map(Path, call.folders), call.output, call.format)
            return 0
        runs = [Run(folder) for folder in call.folders]
        names = [run.folder.resolve().name for run in runs]
        if call.compare:
            from geocone.plots import load
            load.draw_curves([plain(name) for name in names], map(load.curve_of, runs),
                             "load-displacement curves", None, call.compare)
        if call.table:
            from geocone.plots.table import write_table
            write_table(runs, call.table)
        if call.compare or call.table:
            finish()
            return 0
        for run, name in zip(runs, names):
            below = call.output and (call.output / name if len(runs) > 1 else call.output)
            if call.films:
                from geocone.plots import animation
                (below or run.folder).mkdir(parents=True, exist_ok=True)
                animation.draw(run, [(below or run.folder) / film
                                     for film in call.films])
                continue
            if call.stresses:
                from geocone.plots import stresses
                (below or run.folder).mkdir(parents=True, exist_ok=True)
                stresses.draw_run(run, (below or run.folder) / f"principal_stresses.{call.format}")
                continue
            if call.paraview:
                from geocone.plots import paraview
                (below or run.folder).mkdir(parents=True, exist_ok=True)
                print(paraview.write_state(run, below or run.folder))
                continue
            draw_run(run, below or run.folder, call.times, call.format)
        finish()
    except (PlotError, ReadError, Skipped, OSError) as problem:
        try:
            finish()
        except PlotError:  # the first problem is reported
            pass
        print(f"error: {problem}", file=sys.stderr)
        return 1
    return 0
