# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Computes the runs of studies, side by side, and gathers what they found.

Each run has a folder, and beside it FOLDER.json: a digest of all that the result
depends on, and how the run ended. A run whose digest is unchanged is used again. Only
what studies and their runs have written is replaced or deleted: never what a link shows,
or what else somebody has put into a folder.
"""

import csv
import fcntl
import functools
import hashlib
import io
import json
import shlex
import shutil
import sys
import threading
import time

from geocone.files import files_of_run, remove_run, write_whole
from geocone.reader import ReadError, leaves, read
from geocone.report.schema import StudyError
from geocone.runner import ROOT, Ended, command, duration
from geocone.side_by_side import SideBySide


def read_json(path):
    """The object in a file; {} if there is none or it is damaged."""
    try:
        found = json.loads(path.read_text()) if path.is_file() else {}
    except (OSError, ValueError, RecursionError):
        found = {}
    return found if isinstance(found, dict) else {}


def command_text(run, options=()):
    """The call that a reader may repeat."""
    file = run.file.relative_to(ROOT) if run.file.is_relative_to(ROOT) else run.file
    ranks = ["-n", str(run.ranks)] if run.ranks > 1 else []
    return shlex.join(["scripts/geocone", *ranks, str(file), *options, *run.options()])


class Progress:
    """One line that is updated on a terminal, plain lines in a file."""

    def __init__(self, total, out=sys.stderr):
        self.total, self.out, self.done, self.failed = total, out, 0, 0
        self.left = 0.

    def show(self, text):
        """Logs what has ended and how long the rest will take."""
        line = (f"study: {self.done}/{self.total} done" +
                (f", {self.failed} failed" if self.failed else "") +
                (f", about {duration(self.left)} left" if self.done < self.total
                 else "") + f": {text}")
        if self.out.isatty():
            width = shutil.get_terminal_size().columns - 1
            end = "\n" if self.done == self.total else ""
            self.out.write("\r" + line[:width].ljust(width) + end)
        else:
            self.out.write(line + "\n")
        self.out.flush()


MARK = ".study"  # in the output folder of studies; locked while they are computed


def own_folder(path):
    """Makes a folder of a study, if it is not there, and returns its path.
    @throw StudyError if it is a link, which may lead anywhere"""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise StudyError(f"the folder '{path}' cannot be made: {problem.strerror}\n"
                         "  remedy:  name another one with --output")
    if path.is_symlink():
        raise StudyError(f"'{path}' is a link\n  allowed: a folder\n"
                         "  remedy:  name another output folder with --output")
    return path


def take_output(path):
    """Takes the output folder: a new one, an empty one, or that of a study before.
    @return what must be kept open as long as nobody else may write there
    @throw StudyError if it is another one, or in use"""
    mark = path / MARK
    if path.is_dir() and any(path.iterdir()) and (mark.is_symlink() or not mark.is_file()):
        raise StudyError(
            f"the folder '{path}' is not empty, and no study has made it\n"
            f"  allowed: a new or an empty folder, or one with the file {MARK} of a study\n"
            "  remedy:  name another one with --output; if a study of an older geocone has "
            f"made it, make an empty file {MARK} in it")
    path.mkdir(parents=True, exist_ok=True)
    lock = open(mark, "a")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        raise StudyError(f"another study is being computed in '{path}'\n"
                         "  remedy:  wait for it, or name another folder with --output")
    return lock


class Computer:
    """Calls the program for runs."""

    def __init__(self, program, folder, cores, options=()):
        self.program, self.folder, self.cores = program, folder, cores
        self.options = options
        self.digest = hashlib.sha256(program.read_bytes()).hexdigest()
        self.calls = SideBySide(cores)
        own_folder(folder)

    def key(self, run):
        """A digest of all that the result depends on."""
        return hashlib.sha256((self.digest + run.inputs()).encode()).hexdigest()

    def record(self, run):
        """How the run has ended before, or {}."""
        record = read_json(self.folder / (run.name + ".json"))
        return record if {"key", "status", "reason", "seconds",
                          "command"} <= record.keys() else {}

    def is_done(self, run):
        """Whether the result is there and unchanged; what failed may need an option."""
        record = self.record(run)
        return record.get("key") == self.key(run) and (
            record["status"] == "finished" or
            record.get("options", []) == list(self.options))

    def call(self, run):
        """Computes a run and writes its record."""
        record = self.folder / (run.name + ".json")
        folder = self.folder / run.name
        key = self.key(run)  # of the files as they are now, not when it has ended
        remove_run(folder)
        record.unlink(missing_ok=True)
        try:
            ended = self.calls.call(
                command(self.program, run.file, run.settings, folder, run.ranks,
                        self.options),
                run.time_limit)
        except OSError as problem:  # e.g. there is no mpirun
            ended = Ended(1, "", 0., f"error: it cannot be called: {problem}")
        if self.calls.stopped:
            return
        write_whole(record, json.dumps(
            {"key": key, "status": "failed" if ended.reason else "finished",
             "reason": ended.reason, "code": ended.code,
             "seconds": round(ended.seconds, 3), "options": list(self.options),
             "command": command_text(run, self.options),
             "output": ended.output[-4000:]}, indent=1))

    def check_folder(self, run):
        """Refuses to replace what is not an earlier run that has ended.
        @throw StudyError"""
        folder, record = self.folder / run.name, self.folder / (run.name + ".json")
        try:
            files = files_of_run(folder)
            if record.is_dir():
                raise FileExistsError(f"'{record}' is a folder")
        except OSError as problem:
            raise StudyError(f"the run '{run.name}' cannot be computed again: {problem}\n"
                             "  remedy:  move that elsewhere, or name another output folder "
                             "with --output")
        try:
            going_on = files and read(folder).status == "running"
        except ReadError:
            going_on = False
        if going_on:
            raise StudyError(f"the run '{run.name}' goes on in '{folder}'\n"
                             "  remedy:  wait for it or end it, or name another output "
                             "folder with --output")

    def compute(self, runs):
        """Computes what is not there yet, the longest first as far as is known.
        @throw StudyError, before anything is computed, if a folder is not the runs' own"""
        expected = {run.name: self.record(run).get("seconds") for run in runs}
        known = [seconds for seconds in expected.values() if seconds]
        mean = sum(known) / len(known) if known else 5.
        waiting = [run for run in runs if not self.is_done(run)]
        # Those that need the machine for themselves come last, one by one.
        for run in waiting:
            self.check_folder(run)
        waiting.sort(key=lambda run: (run.alone, -(expected[run.name] or mean)))
        progress = Progress(len(runs))
        progress.done = len(runs) - len(waiting)
        missing = {run.name for run in waiting}
        progress.failed = sum(self.record(run)["status"] == "failed"
                              for run in runs if run.name not in missing)
        progress.show(f"{progress.done} there from before")
        began, computed, lock = time.monotonic(), [], threading.Lock()

        def work(run):
            self.call(run)
            if self.calls.stopped:
                return
            with lock:
                record = self.record(run)
                computed.append(run.name)
                progress.done += 1
                progress.failed += record.get("status") != "finished"
                # Time of completed runs relative to the estimate.
                ended = sum(expected[name] or mean for name in computed)
                rest = sum(expected[other.name] or mean for other in waiting
                           if other.name not in computed)
                progress.left = (time.monotonic() - began) * rest / ended
                progress.show(run.name + (
                    f": {record['reason']}" if record.get("reason") else ""))

        self.calls.do([(self.cores if run.alone else run.ranks,
                        functools.partial(work, run)) for run in waiting])

    def row(self, run):
        """Data of a run, for figures and tables."""
        record, folder = self.record(run), self.folder / run.name
        summary = read_json(folder / "summary.json")
        status, reason = record["status"], record["reason"]
        if status == "finished" and not summary:
            status, reason = "failed", "its folder has no summary.json"
        return {"group": run.group, "label": run.label, "axes": run.axes,
                "name": run.name, "file": run.file, "folder": folder,
                "status": status, "code": record.get("code"), "reason": reason,
                "seconds": record["seconds"], "command": record["command"],
                "check": run.check, "summary": summary}


def write_csv(path, rows):
    """One line for each run: its axes, how it ended, all of its summary."""
    lines = [{"group": row["group"],
              **{f"axis {name}": value for name, value in row["axes"].items()},
              "status": row["status"], "reason": row["reason"],
              "seconds": row["seconds"],
              # The status of a summary is what the run knew, e.g. that it goes on.
              **{key: value for key, value in leaves(row["summary"]).items()
                 if key != "status"},
              "command": row["command"]} for row in rows]
    columns = list(dict.fromkeys(key for line in lines for key in line
                                 if key != "command")) + ["command"]
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(lines)
    write_whole(path, text.getvalue())
