# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls of geocone."""

import contextlib
import os
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from geocone.parameter_file import setting
from geocone.program import ROOT, environment, example, find_program
from geocone.progress import Progress, listener, reporter
from geocone.reader import Run, read
from geocone.scene import Scene

__all__ = ["ROOT", "Ended", "RunFailed", "command", "example", "find_program", "finish",
           "free_folder", "run", "start"]


class Ended(NamedTuple):
    """How a call has ended."""

    code: int | None  #: as subprocess has it; None: stopped as it took too long
    output: str  #: all that was printed
    seconds: float  #: on the clock
    reason: str  #: why it has failed, in a line; empty if it has not


class RunFailed(Exception):
    """A run that has failed, with the reason in a line.

    Attributes
    ----------
    folder : pathlib.Path
        Folder of the run, which can be read as far as it is there.
    output : str
        All that the program has printed.
    """

    def __init__(self, reason: str, folder: Path, output: str = ""):
        super().__init__(reason)
        self.folder, self.output = folder, output


def run(file: str | os.PathLike | Scene, parameters: Mapping[str, Any] | None = None, *,
        ranks: int = 1, output: str | os.PathLike | None = None,
        program: str | os.PathLike = "geocone", time_limit: float | None = None,
        force: bool = False, run_gmsh_script: bool = False,
        load_library: bool = False,
        progress: Callable[[Progress], Any] | bool | None = None) -> Run:
    """Runs a parameter file or a scene, and reads its results.

    Parameters
    ----------
    file
        Path of a parameter file, or a `Scene`.
    parameters
        {"Section/Name": value} that replace those of the file: texts, numbers, truth values,
        lists. {"Output/Pictures": False} saves seconds.
    ranks
        Number of processes of MPI.
    output
        Folder of the results, new or empty. None: results/NAME of the working folder, or
        results/NAME-2 and so on if that is there.
    program
        "geocone", which `find_program` looks for, or the path of a program.
    time_limit
        A run that takes longer fails (s).
    force
        Run also a scene that is too large for the memory of the machine.
    run_gmsh_script
        Run the geo script of 'Geometry/File': a program, which can run commands and write
        files with your rights.
    load_library
        Load the shared objects of 'Materials/NAME/Library': programs with your rights.
    progress
        A function that is called with a `Progress` as the run proceeds; an error that it
        raises ends the run. True: print one line, which is replaced. Nothing is reported
        with 'Output/Verbosity' = 0.

    Returns
    -------
    Run
        The results.

    Raises
    ------
    RunFailed
        If the run fails, if one of its expectations does not hold, or if there is no such
        program; with the program's words.
    """
    def call(words, hear):
        return finish(start(words), time_limit, hear)

    with reporter(progress) as report:
        return result_of(call, file, parameters, ranks,
                         Path(output) if output is not None else free_folder(file),
                         program, options_of(force, run_gmsh_script, load_library), report)


def options_of(force: bool, run_gmsh_script: bool, load_library: bool) -> list[str]:
    """Options that no parameter file has, as words of a call."""
    return (["--force"] * force + ["--run-gmsh-script"] * run_gmsh_script
            + ["--load-library"] * load_library)


def result_of(call: Callable, file: str | os.PathLike | Scene,
              parameters: Mapping[str, Any] | None, ranks: int, folder: Path,
              program: str | os.PathLike, options: Sequence[str],
              report: Callable | None) -> Run:
    """Result of a run, or the error, as run() has them.

    Parameters
    ----------
    call
        A function of the words of a call and of one that hears its lines, or None; it returns
        how the call has ended, an `Ended`.
    report
        A function of a `Progress`, or None.
    """
    changes = dict(parameters or {})
    if isinstance(file, Scene):
        file, changes = file.file, {**file.changes, **changes}
    settings = [setting(*item) for item in changes.items()]
    try:
        words = command(find_program(program), file, settings, folder, ranks, options,
                        quiet=report is None)
        ended = call(words, report and listener(folder, report))
    except OSError as problem:
        raise RunFailed(one_line(str(problem)), folder)
    if ended.reason:
        raise RunFailed(ended.reason.removeprefix("error: "), folder, ended.output)
    return read(folder)


def free_folder(file: str | os.PathLike | Scene) -> Path:
    """A new folder for a run: results/NAME, or results/NAME-2, ..."""
    path = file.file if isinstance(file, Scene) else Path(file)
    name, i = Path("results") / path.stem, 1
    folder = name
    while folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        i += 1
        folder = name.with_name(f"{name.name}-{i}")
    return folder


def command(program: str | os.PathLike, file: str | os.PathLike, settings: Iterable[str],
            folder: str | os.PathLike, ranks: int = 1, options: Iterable[str] = (),
            quiet: bool = True) -> list[str]:
    """The call of a program, as a list of words; settings are 'Section/Name = value'."""
    launcher = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    return [*launcher, str(program), *options, str(file), *["--quiet"] * quiet, "--output",
            str(folder), *(word for text in settings for word in ("--set", text))]


class Call(subprocess.Popen):
    """A call, in a session of its own so that mpirun's children end with it. One thread for
    each rank."""

    def __init__(self, words: Sequence[str]):
        super().__init__(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         stdin=subprocess.DEVNULL, text=True, errors="replace",
                         env=environment(), start_new_session=True)
        self._not_asked = threading.Lock()

    def send(self, number: int) -> None:
        """Sends a signal to the call and all that it has started."""
        with contextlib.suppress(ProcessLookupError):  # it has just ended
            os.killpg(self.pid, number)

    def ask_to_end(self) -> None:
        """Asks the run to write a checkpoint and end, once: a second signal would kill it."""
        if self._not_asked.acquire(blocking=False):
            self.send(signal.SIGTERM)


def start(words: Sequence[str]) -> Call:
    """Starts a call."""
    return Call(words)


def finish(child: Call, time_limit: float | None = None,
           hear: Callable[[str], Any] | None = None) -> Ended:
    """Waits for a call.

    Parameters
    ----------
    child
        Of start().
    time_limit
        A call that takes longer is killed (s).
    hear
        A function of each line as soon as it is printed; an error that it raises ends the
        call.
    """
    began, lines, is_late = time.monotonic(), [], threading.Event()

    def kill():
        is_late.set()
        child.send(signal.SIGKILL)

    timer = threading.Timer(time_limit or 0., kill)
    with child:
        try:
            if time_limit is not None:
                timer.start()
            for line in child.stdout:
                lines.append(line)
                if hear:
                    hear(line.rstrip("\n"))
            child.wait()
        except BaseException:  # e.g. Ctrl-C
            child.ask_to_end()
            child.stdout.read()  # its last words must not fail
            raise
        finally:
            timer.cancel()
    output, seconds = "".join(lines), time.monotonic() - began
    if is_late.is_set():
        return Ended(None, output, seconds, f"no end in {duration(time_limit)}")
    return Ended(child.returncode, output, seconds, reason_of(child.returncode, output))


def one_line(text: str) -> str:
    """A text with all gaps between words made single blanks."""
    return " ".join(text.split())


def reason_of(code: int, output: str) -> str:
    """Why a call has failed, in a line; empty if it has not."""
    if code == 0:
        return ""
    if code < 0:
        return f"ended by signal {-code}"
    lines = [one_line(line) for line in output.splitlines() if line.strip()]
    for i, line in enumerate(lines):
        if line.startswith("error:"):
            return " ".join(lines[i:i + 3])
    said = [line.removeprefix("warning: ") for line in lines]
    unmet = [line for line in said if line.startswith("expected ") and ": NO" in line]
    return "; ".join(unmet) or (lines[-1] if lines else f"exit code {code}")


def duration(seconds: float) -> str:
    """A duration in words."""
    if seconds < 90.:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.:.0f} min" if seconds < 5400. else f"{seconds / 3600.:.1f} h"
