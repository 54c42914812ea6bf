#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kills runs at random moments, resumes them, and compares the results with those of
runs that were left alone:

    trial.py PROGRAM                        # each method once, on 1 and 2 ranks
    trial.py PROGRAM --count 10 --seed 3    # ten times
    trial.py PROGRAM --cases fem:kill:1 mpm:terminate:2 explicit:ranks:1
    #                        METHOD:DEED:RANKS

Deeds: kill (SIGKILL to all ranks, after the first checkpoint), terminate (SIGTERM at any
moment, also within a step), truncate (killed, and the last checkpoint cut to half: the
one before it must be taken), ranks (killed on RANKS, resumed on 1 or 2 others).

After SIGKILL all numbers of statistics.csv and of the summary must be the same bit by bit,
but for implicit steps on several ranks, where two runs that are left alone are not the
same either (MUMPS adds in the order in which messages come); these, and all others, to
1e-10 (the sums of a step that was stopped, or of other ranks, are added up in another
order). The series of fields must have the same times. Exit code 1 if anything else is found."""

import argparse
import csv
import json
import math
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS))
from processes import ranks_of  # noqa: E402

METHODS = {
    "fem": ("fem/footing-associated-01.prm", {
        "Loading/push/Output every": "3"}),
    "mpm": ("mpm/footing-segments-01.prm", {
        "Loading/push/Output every": "3"}),
    "explicit": ("explicit/collapse.prm", {
        "Loading/fall/Duration": "1.2", "Loading/fall/Step size": "0.04",
        "Mesh/Cell size": "0.05", "Mesh/Box": "0, 0; 6, 2.4", "Loading/fall/Output every": "3"}),
    # A free obstacle on points.
    "obstacle": ("explicit/obstacle_plate-01.prm", {
        "Mesh/Cell size": "0.025", "Loading/settle/Step size": "0.02",
        "Loading/settle/Duration": "1", "Loading/settle/Output every": "3"}),
    # Soil with history, stages with resets, points that are taken away in time.
    "cut": ("explicit/slope_cut-01.prm", {
        "Loading/settle/Duration": "2", "Loading/stand/Duration": "0.5",
        "Loading/cut/Duration": "2", "Loading/cut/Removal duration": "1",
        "Loading/cut/Output every": "3"}),
    # Points that are found in the cells of any mesh.
    "general": ("explicit/collapse-general-01.prm", {
        "Mesh/Cell size": "0.1", "Loading/fall/Duration": "1",
        "Loading/fall/Step size": "0.04", "Loading/fall/Output every": "3"}),
    # Cells and points that go and come, and forces that fade.
    "stages fem": ("../prm/stages/built_column.prm", {
        "Mesh/Cell size": "0.0078125", "Loading/build 2/Step size": "0.1",
        "Loading/build 4/Step size": "0.1"}),
    "stages mpm": ("../prm/stages/excavated_column_mpm.prm", {
        "Mesh/Cell size": "0.015625", "Loading/weight/Step size": "2.5e5",
        "Loading/dig/Step size": "5e4"}),
    # Excess pore pressures, and a load factor.
    "undrained": ("fem/undrained_footing-01.prm", {"Loading/push/Output every": "2"}),
    # Excess pore pressures that are unknowns.
    "consolidation": ("../prm/consolidation/terzaghi.prm", {
        "Loading/consolidate/Output every": "5"}),
    "consolidation mpm": ("../prm/consolidation/mud_mpm.prm", {
        "Loading/settle/Output every": "5", "Loading/settle/Duration": "8e5"}),
    # Pore water that flows, and points that are taken away in time.
    "two-phase": ("../prm/consolidation/cut_below_water.prm", {
        "Mesh/Cell size": "1", "Loading/cut/Duration": "2",
        "Loading/cut/Step size": "0.05", "Loading/cut/Output every": "3"}),
    "raised": ("fem/raised_footing-01.prm", {"Loading/raise/Output every": "2"}),
    # Sides that move and absorb, by explicit steps.
    "sides": ("explicit/traction_wave-01.prm", {"Loading/shake/Output every": "5"}),
    # Obstacles: a free body on soil, and particles that slide.
    "free": ("contact/free_footing-01.prm", {"Loading/push/Output every": "3"}),
    "slide": ("contact/incline-MPM-01.prm", {
        "Loading/slide/Duration": "0.25", "Loading/slide/Output every": "10"}),
    # A bond that breaks.
    "bond": ("contact/bond-01.prm", {
        "Mesh/Cell size": "0.02", "Time stepping/Inertia": "true", "Loading/lift/Output every": "2"}),
    # A body that slides over another one.
    "bodies": ("contact/incline_bodies-01.prm", {"Loading/slide/Output every": "20"}),
    "bodies_mpm": ("contact/blocks-MPM-01.prm", {"Loading/slide/Output every": "12"}),
    # A bar that hits a wall, by the midpoint rule.
    "impact": ("contact/bar_impact-01.prm", {"Loading/fly/Output every": "20"}),
    # One point of a law with history.
    "point": ("element/cyclic_shear-01.prm", {
        "Path/forth/Increments": "30000", "Path/failure/Increments": "30000",
        "Checkpoint/Every steps": "5000"}),
    # A body that turns, with APIC, and implicit steps that are cut.
    "slope": ("mpm/slope-dilatancy_free-01.prm", {}),
    # Three dimensions.
    "three": ("three/column_layer-01.prm", {
        "Mesh/Cell size": "0.125", "Loading/collapse/Output every": "3"}),
    "three explicit": ("three/explicit_layer-01.prm", {
        "Mesh/Cell size": "0.0625", "Loading/collapse/Step size": "0.02",
        "Loading/collapse/Output every": "3"})}
ALWAYS = {"Output/Expectations": "", "Output/Report for tests": "none",
          "Output/Pictures": "false", "Output/Fields": "true"}
DEEDS = ("kill", "terminate", "truncate", "ranks")
NOT_COMPARED = {"run", "cost", "warnings"}  # of the summary
TIMES = {"CPU time of rank 0 (s)"}
# Counts, errors that are rounding themselves, and the place of an extreme: where two points
# share it to the last digits, rounding chooses; the extreme itself is compared.
NOISE = ("(-)", "limiting point", "newton", "quality", "residual", "identity", "least_step", "cone excess",
         "relative_error", "penetration", "drift", "natural_map", "nonzeros", "ranks", "imbalance",
         "repartitions")
PATIENCE = 300.  # s


class Wrong(Exception):
    """What is not as it must be."""


def start(arguments, n_ranks, folder):
    """A process of geocone."""
    call = ["mpirun", "-np", str(n_ranks)] if n_ranks > 1 else []
    with open(folder / "screen.txt", "ab") as screen:
        return subprocess.Popen(call + [str(a) for a in arguments], cwd=folder,
                                stdout=screen, stderr=screen, start_new_session=True)


def run(program, method, n_ranks, folder):
    """The call of a run into folder/results, as a process."""
    file, settings = METHODS[method]
    arguments = [program, TESTS / file, "--quiet", "--output", folder / "results"]
    for name, value in {"Checkpoint/Every steps": "2", **settings, **ALWAYS}.items():
        arguments += ["--set", f"{name} = {value}"]
    return start(arguments, n_ranks, folder)


def end_of(process, folder):
    """Waits; the exit code."""
    try:
        return process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        raise Wrong(f"no end within {PATIENCE} s: see {folder}") from None


def numbers(folder):
    """All numbers of a run by name, and the times of its fields."""
    found = {}
    table = next(path for name in ("statistics.csv", "path.csv")
                 if (path := folder / name).exists())
    with open(table, newline="") as file:
        for i, row in enumerate(csv.DictReader(file), 1):
            for name, value in row.items():
                if name not in TIMES:
                    found[f"{table.name}, line {i}, {name}"] = float(value)

    def collect(value, name):
        if isinstance(value, dict):
            for key, part in value.items():
                collect(part, f"{name}/{key}")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            found[name] = float(value)
    summary = json.loads((folder / "summary.json").read_text())
    if summary["status"] != "finished":
        raise Wrong(f"status '{summary['status']}'")
    for key, part in summary.items():
        if key not in NOT_COMPARED:
            collect(part, key)
    series = [path.read_text() for path in sorted(folder.glob("*.pvd"))]
    return found, [line.split('"')[1] for text in series for line in text.splitlines()
                   if "timestep" in line]


# Of a key of the summary, as "momentum/x_N_s_per_m"; columns have theirs in brackets.
UNIT = re.compile(r"[_/]((?:(?:Pa|kg|J|N|m|s)_)*(?:Pa|kg|J|N|m|m2|m3|s)(?:_per_[ms])?)"
                  r"(?:_least|_most|_max)?$")


def unit_of(column):
    """The unit of its values, that of moments without their arm; empty of a pure number."""
    if column.endswith(")"):
        unit = column.rsplit("(", 1)[-1][:-1]
    else:
        found = UNIT.search(column)
        unit = found[1].replace("_per_", "/").replace("_", " ") if found else ""
    return unit.replace("N m", "N").replace("^", "")


def compare(expected, results, tolerance):
    """@throws Wrong if numbers differ by more than a part of the largest of a column."""
    (numbers_a, times_a), (numbers_b, times_b) = expected, results
    if times_a != times_b:
        raise Wrong(f"the fields are of {times_b} instead of {times_a}")
    if numbers_a.keys() != numbers_b.keys():
        raise Wrong(f"other numbers: {sorted(numbers_a.keys() ^ numbers_b.keys())[:4]}")
    scale, largest = {}, {}
    for name, value in numbers_a.items():
        column = name.split(", ")[-1]
        unit = unit_of(column)
        scale[column] = max(scale.get(column, 0.), abs(value))
        largest[unit] = max(largest.get(unit, 0.), abs(value))
    for name, value in numbers_a.items():
        column = name.split(", ")[-1]
        other = numbers_b[name]
        # What rounding leaves of nothing is compared with the largest of its unit, and a
        # pure number, such as a loss relative to the work, with one.
        unit = unit_of(column)
        allowed = tolerance * max(scale[column], 0.1 * largest[unit] if unit else 1.)
        if tolerance > 0. and any(word in column for word in NOISE):
            continue
        if not (other == value or abs(other - value) <= allowed or
                math.isnan(other) and math.isnan(value)):
            raise Wrong(f"{name}: {other!r} instead of {value!r}")


def interrupt(program, case, folder, seconds, chance):
    """Starts a run and ends it by force at a random moment; whether it was running."""
    method, deed, n_ranks = case
    began = time.monotonic()
    process = run(program, method, n_ranks, folder)
    checkpoints = 2 if deed == "truncate" else 1
    while (process.poll() is None and
           len(list((folder / "results").glob("checkpoint-*.h5"))) < checkpoints):
        time.sleep(0.005)
    # Any moment from then on until about the end.
    time.sleep(chance.random() * max(0., 0.9 * seconds - (time.monotonic() - began)))
    ranks = ranks_of(process, program)
    for pid in ranks:
        try:
            os.kill(pid, signal.SIGTERM if deed == "terminate" else signal.SIGKILL)
        except ProcessLookupError:
            pass
    end_of(process, folder)
    deadline = time.monotonic() + 10.
    while True:
        status = json.loads((folder / "results" / "summary.json").read_text())["status"]
        if status != "running" or time.monotonic() > deadline:
            break
        time.sleep(0.05)
    return not status.startswith("finished"), status


def trial(program, case, folder, expected, seconds, chance):
    """One case. @return what happened"""
    method, deed, n_ranks = case
    exact = deed in ("kill", "truncate") and (
        n_ranks == 1 or method in ("explicit", "cut", "general"))
    # The soil model amplifies rounding near its similarity centre: runs that are left
    # alone differ by 3e-7 on one and two ranks.
    tolerance = 0. if exact else 1e-5 if method == "cut" else 1e-10
    cut, status = interrupt(program, case, folder, seconds, chance)
    results = folder / "results"
    if not cut:
        compare(expected, numbers(results), tolerance)
        return "had finished before"
    checkpoints = sorted(results.glob("checkpoint-*.h5"))
    last = int(checkpoints[-1].stem.split("-")[1])
    if deed == "truncate":
        if len(checkpoints) < 2:
            return "no checkpoint before the last one"
        size = checkpoints[-1].stat().st_size
        os.truncate(checkpoints[-1], size // 2)
    n_again = (1 if n_ranks > 1 else 2) if deed == "ranks" else n_ranks
    code = end_of(start([program, "--resume", results, "--quiet"], n_again, folder), folder)
    if code != 0:
        raise Wrong(f"resumed after '{status}': exit code {code}:\n" +
                    (folder / "screen.txt").read_text()[-600:])
    compare(expected, numbers(results), tolerance)
    log = (results / "log.txt").read_text()
    if "resumed at t" not in log:
        raise Wrong("the log does not tell that it was resumed")
    if deed == "truncate" and f"'{checkpoints[-1].name}' is left out" not in log:
        raise Wrong("the log does not name the damaged checkpoint")
    return f"{status.split(':')[0]}, resumed after step {last}"


def main():
    """Runs the cases."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--output", type=Path, help="folder to work in, which is kept")
    parser.add_argument("--count", type=int, default=1, help="how often each case is tried")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", nargs="*", metavar="METHOD:DEED:RANKS",
                        default=[f"{method}:{deed}:{n}" for method in METHODS
                                 for deed in DEEDS for n in (1, 2)
                                 if method != "point" or n == 1 and deed != "ranks"])
    options = parser.parse_args()
    program = options.program.resolve()
    root = (options.output or Path(tempfile.mkdtemp(prefix="resumed-"))).resolve()
    bad = 0
    references = {}
    for text in options.cases:
        method, deed, n_ranks = text.split(":")
        case = method, deed, int(n_ranks)
        for i in range(options.count):
            name = f"{method}-{deed}-{n_ranks}-{i}"
            chance = random.Random(f"{options.seed} {name}")
            folder = root / name
            folder.mkdir(parents=True, exist_ok=True)
            key = method, case[2]
            if key not in references:
                alone = root / f"{method}-alone-{n_ranks}"
                alone.mkdir(parents=True, exist_ok=True)
                began = time.monotonic()
                if end_of(run(program, *key, alone), alone) != 0:
                    sys.exit(f"error: {alone}: the run left alone has failed")
                references[key] = numbers(alone / "results"), time.monotonic() - began
            try:
                print(f"{name}: {trial(program, case, folder, *references[key], chance)}",
                      flush=True)
            except Wrong as wrong:
                bad += 1
                print(f"{name}: WRONG: {wrong}", flush=True)
    print(f"{bad} of {options.count * len(options.cases)} wrong; {root}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
