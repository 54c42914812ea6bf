#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Computes studies and writes their report.

A study is a file that names parameter files and what varies (studies/*.toml tell
how they are written; doc/studies.md explains them). Each run is an ordinary run of
geocone in a folder of its own. What is there already and unchanged (the parameters,
the files they include, the program) is used again, so an interrupted study goes on
where it was. Without a file all studies of studies/ are computed but the quick one.

Leaves in the output folder:
  report.html     one page with all figures, tables and the command of each run
  NAME.csv        a line for each run of studies/NAME.toml
  figures/        the figures as files, the tables as Markdown
  runs/NAME/      the folders of the runs

scripts/study calls this when the program is built.
"""

import argparse
import os
import signal
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # no __pycache__ beside this script
sys.path[0] = str(Path(__file__).resolve().parents[1])
# pylint: disable=wrong-import-position
from report.page import check_kinds, write_report  # noqa: E402
from report.runs import ROOT, Computer, command_text, write_csv  # noqa: E402
from report.study_file import StudyError, read_study  # noqa: E402

ORDER = ("speed", "paper", "validation")


def default_studies():
    """All but the quick one, in the order of the report."""
    files = {path.stem: path for path in (ROOT / "studies").glob("*.toml")}
    files.pop("quick", None)
    return [files.pop(name) for name in ORDER if name in files] + sorted(files.values())


def main():
    """Does what the command line asks for; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="scripts/study", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path, metavar="STUDY.toml")
    parser.add_argument("--quick", action="store_true",
                        help="the study studies/quick.toml, some minutes")
    parser.add_argument("--output", type=Path, metavar="FOLDER",
                        help="default: results/study, or results/study-NAME of one file")
    parser.add_argument("--program", type=Path, metavar="GEOCONE",
                        help="a built program (default: that of scripts/build)")
    parser.add_argument("--cores", type=int, default=len(os.sched_getaffinity(0)),
                        help="how many runs go side by side (default: all cores)")
    parser.add_argument("--list", action="store_true",
                        help="only print the commands of the runs")
    parser.add_argument("--report-only", action="store_true",
                        help="compute nothing; report what is there")
    call = parser.parse_args()
    files = call.files or ([ROOT / "studies" / "quick.toml"] if call.quick else
                           default_studies())
    output = call.output or ROOT / "results" / (
        f"study-{files[0].stem}" if len(files) == 1 else "study")
    if call.cores < 1:
        parser.error("--cores must be 1 or more")
    try:
        studies = [read_study(file) for file in files]
        for study in studies:
            check_kinds(study)
    except StudyError as problem:
        print(f"error: {problem}", file=sys.stderr)
        return 1
    if call.list:
        for study in studies:
            for run in study.runs:
                print(command_text(run))
        return 0
    program = (call.program or ROOT / "build" / "release" / "geocone").resolve()
    if not program.is_file():
        print(f"error: there is no program '{program}'", file=sys.stderr)
        return 1
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    results = []
    for study in studies:
        computer = Computer(program, output / "runs" / study.name, call.cores)
        runs = study.runs
        if call.report_only:
            runs = [run for run in runs if computer.record(run)]
        else:
            print(f"study: {study.title}: {len(runs)} runs", file=sys.stderr)
            computer.compute(runs)
        rows = [computer.row(run) for run in runs]
        write_csv(output / f"{study.name}.csv", rows)
        results.append((study, rows))
    problems = write_report(output / "report.html", results, program)
    print(output / "report.html")
    return 1 if problems else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        print("\nstudy: interrupted; the same command goes on from here",
              file=sys.stderr)
        sys.exit(130)
