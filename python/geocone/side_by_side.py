# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls of programs that go side by side."""

import functools
import os
import threading
from collections.abc import Callable, Hashable, Mapping, Sequence
from pathlib import Path
from typing import Any

from geocone.progress import Progress, reporter
from geocone.reader import Run
from geocone.runner import (Ended, RunFailed, finish, free_folder, options_of, result_of, start)
from geocone.scene import Scene


class SideBySide:
    """Does jobs side by side, as many as there are cores for, and ends the programs that
    they have called if it is interrupted.

    Attributes
    ----------
    cores : int
        Number of cores that jobs take at a time.
    stopped : bool
        Whether it was interrupted: what a job gets from call() then is not a result.
    """

    def __init__(self, cores: int):
        self.cores, self.stopped = cores, False
        self.children, self.changed = set(), threading.Condition()

    def call(self, words: Sequence[str], time_limit: float | None = None,
             hear: Callable[[str], Any] | None = None) -> Ended:
        """Calls a program, from a job, and waits for it as finish() does."""
        child = start(words)
        with self.changed:
            self.children.add(child)
            if self.stopped:  # while it was started
                child.ask_to_end()
        try:
            return finish(child, time_limit, hear)
        finally:
            with self.changed:
                self.children.discard(child)

    def stop(self) -> None:
        """Ends what is being computed: runs write a checkpoint and end."""
        with self.changed:
            self.stopped = True
            for child in self.children:
                child.ask_to_end()

    def do(self, jobs: Sequence[tuple[int, Callable[[], Any]]]) -> None:
        """Does all jobs, the first one first.

        Parameters
        ----------
        jobs
            Of each the number of cores that it takes, and its function.

        Raises
        ------
        BaseException
            The error of the first job that has failed, or the interruption; nothing is being
            computed any more then.
        """
        free, problems = self.cores, []

        def work(function, taken):
            nonlocal free
            try:
                if not self.stopped:
                    function()
            except BaseException as problem:  # pylint: disable=broad-exception-caught
                problems.append(problem)
                self.stop()
            finally:
                with self.changed:
                    free += taken
                    self.changed.notify()

        def wait_for_all():
            # Not by Thread.join: what interrupts that (Ctrl-C) makes Python take the
            # thread for ended.
            with self.changed:
                self.changed.wait_for(lambda: free == self.cores)

        try:
            for wanted, function in jobs:
                taken = min(wanted, self.cores)
                with self.changed:
                    self.changed.wait_for(lambda taken=taken: free >= taken)
                    if self.stopped:
                        break
                    free -= taken
                threading.Thread(target=work, args=(function, taken)).start()
            wait_for_all()
        except BaseException:
            self.stop()
            wait_for_all()
            raise
        if problems:
            raise problems[0]


def run_many(file: str | os.PathLike | Scene, variants: Mapping[Hashable, Mapping[str, Any]],
             *, cores: int | None = None, ranks: int = 1,
             output: str | os.PathLike | None = None, program: str | os.PathLike = "geocone",
             time_limit: float | None = None, force: bool = False,
             run_gmsh_script: bool = False, load_library: bool = False,
             keep_failed: bool = False,
             progress: Callable[[Hashable, Progress], Any] | bool | None = None
             ) -> dict[Hashable, Run | RunFailed]:
    """Runs variants of a parameter file or a scene side by side, as run() does each.

    Parameters
    ----------
    file
        Path of a parameter file, or a `Scene`.
    variants
        {name: {"Section/Name": value}}; the folder of a run has the name of its variant. A
        name may be a number, too: the folder of 6000.0 is 6000.
    cores
        Number of cores for all runs. None: all of this machine. A run takes as many as it
        has ranks.
    output
        Folder of the runs' folders. None: results/NAME of the working folder, or
        results/NAME-2 and so on if that is there.
    keep_failed
        True: a `RunFailed` is in the place of a run that has failed. False: once all have
        ended, the first one of them is raised.
    progress
        A function that is called with the name of a variant and a `Progress`, never twice at
        a time; an error that it raises ends all runs. True: print one line, which is
        replaced.
    ranks, program, time_limit, force, run_gmsh_script, load_library
        As run() has them.

    Returns
    -------
    dict
        {name: Run}, in the order of the variants.

    Raises
    ------
    RunFailed
        If a run fails; its folder shows which one.
    ValueError
        If a name is not that of a folder.
    """
    folder = Path(output) if output is not None else free_folder(file)
    folders = {name: folder_name(name) for name in variants}
    names = list(folders.values())
    for name in names:
        if name in ("", "..") or name != Path(name).name or names.count(name) > 1:
            raise ValueError(f"the variant '{name}' cannot have a folder of its name")
    if cores is not None and cores < 1:
        raise ValueError(f"cores = {cores}; allowed: 1 and more")
    calls = SideBySide(cores or len(os.sched_getaffinity(0)))
    results, one_at_a_time = {}, threading.Lock()

    def compute(name, parameters, report):
        def report_of_variant(state):
            with one_at_a_time:
                report(name, state)

        def call(words, hear):
            return calls.call(words, time_limit, hear)

        try:
            results[name] = result_of(call, file, parameters, ranks, folder / folders[name],
                                      program, options_of(force, run_gmsh_script, load_library),
                                      report and report_of_variant)
        except RunFailed as problem:
            results[name] = problem

    with reporter(progress) as report:
        calls.do([(ranks, functools.partial(compute, *item, report))
                  for item in variants.items()])
    results = {name: results[name] for name in variants}
    for result in results.values():
        if isinstance(result, RunFailed) and not keep_failed:
            raise result
    return results


def folder_name(name: Hashable) -> str:
    """Name of the folder of a variant; that of a whole number has no decimals."""
    text = str(name)
    return text.removesuffix(".0") if isinstance(name, float) else text
