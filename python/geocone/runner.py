# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls geocone."""

import contextlib
import os
import shutil
import signal
import subprocess
import time
from collections import namedtuple
from pathlib import Path

from geocone.parameter_file import setting
from geocone.reader import read

ROOT = Path(__file__).resolve().parents[2]  # of the source, or share/geocone
# code: as of subprocess, None: stopped for want of time; seconds: on the clock.
Ended = namedtuple("Ended", "code output seconds reason")


class RunFailed(Exception):
    """Why a run has failed, in a line. Its folder, as far as there is one, can be read
    (member `folder`); `output` is what the program has said."""

    def __init__(self, reason, folder, output=""):
        super().__init__(reason)
        self.folder, self.output = folder, output


def run(file, parameters=(), *, ranks=1, output=None, program="geocone",
        time_limit=None, force=False, run_gmsh_script=False):
    """Runs a parameter file and reads what it has left.

    @param file a path
    @param parameters {"Section/Name": value} that count instead of those of the file:
      texts, numbers, truth values, lists. {"Output/Pictures": False} saves seconds
    @param ranks of MPI
    @param output the folder, new or empty; None: results/NAME of the working folder, or
      results/NAME-2 and so on if that is there
    @param program "geocone": beside this package where it was built
      or installed, or else in the PATH; or the path of a program
    @param time_limit in s; a run that takes longer fails
    @param force runs also what is too large for the machine's memory
    @param run_gmsh_script runs the geo script of 'Geometry/File': a program, which can
      run commands and write files with your rights
    @return a Run
    @throw RunFailed if the run fails, if one of its expectations does not hold, or if
      there is no such program; with the program's words"""
    return result_of(lambda words: finish(start(words), time_limit), file, parameters,
                     ranks, Path(output) if output is not None else free_folder(file),
                     program, options_of(force, run_gmsh_script))


def options_of(force, run_gmsh_script):
    """What no parameter file may say, as words of a call."""
    return ["--force"] * force + ["--run-gmsh-script"] * run_gmsh_script


def result_of(call, file, parameters, ranks, folder, program, options):
    """What run() returns or throws, by a function that calls words and tells what came
    of it."""
    settings = [setting(*item) for item in dict(parameters).items()]
    try:
        ended = call(command(find_program(program), file, settings, folder, ranks,
                             options))
    except OSError as problem:
        raise RunFailed(str(problem), folder)
    if ended.reason:
        raise RunFailed(ended.reason.removeprefix("error: "), folder, ended.output)
    return read(folder)


def example(name):
    """The path of a parameter file that comes with geocone, e.g.
    example("safety/slope_2to1.prm"): in prm of the source, or where it is installed.
    @throw FileNotFoundError if there is none"""
    places = [ROOT / "prm" / name, ROOT.parent / "doc" / "geocone" / "examples" / name]
    for place in places:
        if place.is_file():
            return place
    raise FileNotFoundError(f"there is no example '{name}' in {places[0].parent}")


def free_folder(file):
    """The folder of a run without a name: results/NAME, or results/NAME-2, ..."""
    name, i = Path("results") / Path(file).stem, 1
    folder = name
    while folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        i += 1
        folder = name.with_name(f"{name.name}-{i}")
    return folder


def find_program(name="geocone"):
    """The path of a program: a path, or a name that is looked for.
    @throw FileNotFoundError if there is none"""
    if isinstance(name, Path) or os.sep in name:
        places = [Path(name)]
    else:
        found = shutil.which(name)
        places = [ROOT / "build" / "release" / name,
                  *(parent / "bin" / name for parent in ROOT.parents[1:2]),
                  *([Path(found)] if found else [])]
    for place in places:
        if place.is_file():
            return place.resolve()
    raise FileNotFoundError(f"there is no program '{name}'; scripts/build makes it")


def command(program, file, settings, folder, ranks=1, options=()):
    """The call of a program, as a list of words.
    @param settings ['Section/Name = value']"""
    launcher = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    return [*launcher, str(program), *options, str(file), "--quiet", "--output",
            str(folder), *(word for text in settings for word in ("--set", text))]


def start(call):
    """Starts a call, in a session of its own so that mpirun's children end with it. One
    thread for each rank."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    if os.geteuid() == 0:
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            stdin=subprocess.DEVNULL, text=True, errors="replace",
                            env=environment, start_new_session=True)


def send(child, number):
    """Sends a signal to a call and all that it has started."""
    with contextlib.suppress(ProcessLookupError):  # it has just ended
        os.killpg(child.pid, number)


def finish(child, time_limit=None):
    """Waits for a call, at most so many seconds; what came of it."""
    began = time.monotonic()
    with child:
        try:
            output, _ = child.communicate(timeout=time_limit)
            code, reason = child.returncode, reason_of(child.returncode, output)
        except subprocess.TimeoutExpired:
            send(child, signal.SIGKILL)
            output, _ = child.communicate()
            code, reason = None, f"no end in {duration(time_limit)}"
        except BaseException:  # e.g. Ctrl-C: the run writes a checkpoint and ends
            send(child, signal.SIGTERM)
            raise
    return Ended(code, output, time.monotonic() - began, reason)


def reason_of(code, output):
    """Why a call has failed, in a line; empty if it has not."""
    if code == 0:
        return ""
    if code < 0:
        return f"ended by signal {-code}"
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    for i, line in enumerate(lines):
        if line.startswith("error:"):
            return " ".join(lines[i:i + 3])
    unmet = [line for line in lines if line.startswith("expected ") and ": NO" in line]
    return "; ".join(unmet) or (lines[-1] if lines else f"exit code {code}")


def duration(seconds):
    """A duration in words."""
    if seconds < 90.:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.:.0f} min" if seconds < 5400. else f"{seconds / 3600.:.1f} h"
