# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Progress of runs, from the lines that the program prints."""

import contextlib
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from geocone.parameter_file import IncludeError, parameters_of

STEP = re.compile(r"step (\d+)(?:/(\d+))?  |level (\d+): ")
TIME = re.compile(r"\bt = (\S+) s\b")
LEFT = re.compile(r"  (\d+) s left$")


class Progress(NamedTuple):
    """Progress of a run. A value that the program does not print is None.

    Attributes
    ----------
    text : str
        Line of the program.
    step : int or None
        Number of the last step, or of the mesh of a limit analysis.
    steps : int or None
        Number of steps of the programme; a run may end earlier.
    time : float or None
        Time in the scene (s).
    end_time : float or None
        Time in the scene at the end of the last stage (s).
    seconds_left : float or None
        Time on the clock, if steps cost as much as those before (s).
    """

    text: str
    step: int | None = None
    steps: int | None = None
    time: float | None = None
    end_time: float | None = None
    seconds_left: float | None = None


def progress_in(line: str, end_time: Callable[[], float | None]) -> Progress | None:
    """Progress that a line of the program is about; None if it is another line.

    Parameters
    ----------
    line
        As printed.
    end_time
        Returns the time of the end (s); called if the line has a time.
    """
    begin = STEP.match(line)
    if begin is None:
        return None
    step, steps, level = begin.groups()
    time, left = TIME.search(line), LEFT.search(line)
    return Progress(line.strip(), int(step or level), int(steps) if steps else None,
                    float(time[1]) if time else None, end_time() if time else None,
                    float(left[1]) if left else None)


class EndTime:
    """The time of the end (s) of the run of a folder, once its parameters are there."""

    def __init__(self, folder: Path):
        self.file, self.value = folder / "parameters.prm", None

    def __call__(self) -> float | None:
        with contextlib.suppress(IncludeError, OSError, ValueError, KeyError):
            if self.value is None:
                values = parameters_of(self.file)
                self.value = sum(float(values[f"Loading/{stage.strip()}/Duration"])
                                 for stage in values["Loading/Stages"].split(","))
        return self.value


def listener(folder: Path, report: Callable[[Progress], Any]) -> Callable[[str], None]:
    """A function of a line that reports the progress of the run of a folder."""
    end_time = EndTime(folder)

    def hear(line):
        progress = progress_in(line, end_time)
        if progress:
            report(progress)
    return hear


@contextlib.contextmanager
def reporter(progress: Callable | bool | None) -> Iterator[Callable | None]:
    """The function that reports progress as a user has asked for it: his own, None, or for
    True one that prints a line which replaces the one before."""
    if progress is not True:
        yield progress or None
        return
    width = 0

    def show(*arguments):
        nonlocal width
        *names, state = arguments
        text = ": ".join([*map(str, names), state.text])
        text = text[:shutil.get_terminal_size((120, 1)).columns - 1]
        print("\r" + text.ljust(width), end="", flush=True)
        width = len(text)
    try:
        yield show
    finally:
        if width:
            print()
