# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Computes studies and writes their report.

A study is a file that names parameter files and what varies (studies/*.toml show
how they are written; doc/studies.md explains them). Each run is an ordinary run of
geocone in a folder of its own. Results that are there and unchanged (the parameters,
the files they include, the program) are used again, so an interrupted study goes on
where it was. Without a file the studies speed, paper and validation are computed.

Leaves in the output folder:
  report.html     one page with all figures, tables and the command of each run
  NAME.csv        a line for each run of studies/NAME.toml
  NAME.md         what the page shows of it, as Markdown
  figures/        the figures as files, the tables as Markdown
  runs/NAME/      the folders of the runs
  .study          that a study has made the folder; other folders are not written into

scripts/study calls this when the program is built.
"""

import argparse
import os
import signal
import sys
from pathlib import Path

from geocone.parameter_file import IncludeError
from geocone.report.page import write_report
from geocone.report.runs import Computer, command_text, own_folder, take_output, write_csv
from geocone.report.schema import StudyError, require
from geocone.report.study_file import read_study
from geocone.runner import ROOT, find_program, options_of

ALL = ("speed", "paper", "validation")  # studies of the report without arguments


def main(arguments, prog):
    """Does what the command line asks for; returns the exit code."""
    try:
        return report(arguments, prog)
    except KeyboardInterrupt:
        print("\nstudy: interrupted; the same command goes on from here",
              file=sys.stderr)
        return 130


def report(arguments, prog):
    """Does what the command line asks for; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path, metavar="STUDY.toml")
    parser.add_argument("--quick", action="store_true",
                        help="the study studies/quick.toml, some minutes")
    parser.add_argument("--output", type=Path, metavar="FOLDER",
                        help="default: results/study, or results/study-NAME of one file")
    parser.add_argument("--program", type=Path, metavar="GEOCONE",
                        help="a built program (default: that of scripts/build)")
    parser.add_argument("--page", type=Path, metavar="FILE.md",
                        help="also write the study as this page, its figures into "
                        "'images' beside it; of one study, all of whose figures and "
                        "tables can be shown")
    parser.add_argument("--cores", type=int, default=len(os.sched_getaffinity(0)),
                        help="how many runs go side by side (default: all cores)")
    parser.add_argument("--run-gmsh-script", action="store_true",
                        help="run the geo scripts that the scenes name: programs, which "
                        "can run commands and write files with your rights")
    parser.add_argument("--load-library", action="store_true",
                        help="load the shared objects of laws that the scenes name: programs "
                        "with your rights")
    parser.add_argument("--only", action="append", metavar="GROUP",
                        help="only this group of runs; repeatable")
    parser.add_argument("--list", action="store_true",
                        help="only print the commands of the runs")
    parser.add_argument("--report-only", action="store_true",
                        help="compute nothing; report what is there")
    call = parser.parse_args(arguments)
    options = options_of(False, call.run_gmsh_script, call.load_library)
    files = call.files or [ROOT / "studies" / f"{name}.toml"
                           for name in (["quick"] if call.quick else ALL)]
    output = call.output or ROOT / "results" / (
        f"study-{files[0].stem}" if len(files) == 1 else "study")
    if call.page and (len(files) != 1 or call.page.suffix != ".md"
                      or not call.page.parent.is_dir()):
        parser.error("--page takes a file NAME.md in an existing folder, and one study")
    if call.cores < 1:
        parser.error("--cores must be 1 or more")
    try:
        studies = [read_study(file) for file in files]
        for study in studies:
            same = [other.path for other in studies if other.name == study.name]
            require(len(same) == 1, study.path, f"'{same[-1]}' has the same name",
                    "studies of different names in one call", "rename one, or call twice")
            if call.only:
                study.only(call.only)
        if not call.list:
            return compute(studies, output, find_program(call.program or "geocone"),
                           options, call)
    except (StudyError, IncludeError, OSError) as problem:
        print(f"error: {problem}", file=sys.stderr)
        return 1
    for study in studies:
        for run in study.runs:
            print(command_text(run, options))
    return 0


def compute(studies, output, program, options, call):
    """Computes studies, if the call does not say otherwise, and writes their report; returns
    the exit code.
    @throw StudyError"""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    lock = take_output(output)
    own_folder(output / "runs")
    results = []
    for study in studies:
        computer = Computer(program, output / "runs" / study.name, call.cores, options)
        runs = study.runs
        if call.report_only:
            runs = [run for run in runs if computer.record(run)]
        else:
            print(f"study: {study.title}: {len(runs)} runs", file=sys.stderr)
            computer.compute(runs)
        rows = [computer.row(run) for run in runs]
        write_csv(output / f"{study.name}.csv", rows)
        results.append((study, rows))
    problems = write_report(output / "report.html", results, program, call.page)
    lock.close()
    print(output / "report.html")
    return 1 if problems else 0
