# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls of programs that go side by side."""

import functools
import os
import signal
import threading
from pathlib import Path

from geocone.runner import (RunFailed, finish, free_folder, options_of, result_of, send,
                            start)


class SideBySide:
    """Does jobs side by side, as many as there are cores for, and ends what they have
    called if it is interrupted.

    cores    at a time
    stopped  whether it was interrupted: what a job gets from call() then is not a result
    """

    def __init__(self, cores):
        self.cores, self.stopped = cores, False
        self.children, self.changed = set(), threading.Condition()

    def call(self, words, time_limit=None):
        """Calls a program, from a job; what came of it, an Ended."""
        child = start(words)
        with self.changed:
            self.children.add(child)
            if self.stopped:  # while it was started
                send(child, signal.SIGTERM)
        try:
            return finish(child, time_limit)
        finally:
            with self.changed:
                self.children.discard(child)

    def stop(self):
        """Ends what is being computed: runs write a checkpoint and end."""
        with self.changed:
            self.stopped = True
            for child in self.children:
                send(child, signal.SIGTERM)

    def do(self, jobs):
        """Does all jobs, the first one first.

        @param jobs [(cores that it takes, function)]
        @throw what the first job that has failed has thrown, or what has interrupted;
          nothing is being computed any more then"""
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


def run_many(file, variants, *, cores=None, ranks=1, output=None, program="geocone",
             time_limit=None, force=False, run_gmsh_script=False, keep_failed=False):
    """Runs variants of a parameter file side by side, as run() does each.

    @param variants {"name": {"Section/Name": value}}; runs leave their folders
      under these names. A name may be a number, too
    @param cores how many there are for all; None: all of this machine. A run takes as
      many as it has ranks
    @param output the folder of the runs' folders; None: results/NAME of the working
      folder, or results/NAME-2 and so on if that is there
    @param keep_failed True: what has failed is a RunFailed in the place of its run.
      False: once all have ended, the first one of them is thrown
    @param ranks, program, time_limit, force, run_gmsh_script as run() has them
    @return {"name": Run}, in the order of the variants
    @throw RunFailed as told; its folder tells which one it is
    @throw ValueError if a name is not that of a folder"""
    folder = Path(output) if output is not None else free_folder(file)
    variants = dict(variants)
    names = [str(name) for name in variants]
    for name in names:
        if name in ("", "..") or name != Path(name).name or names.count(name) > 1:
            raise ValueError(f"the variant '{name}' cannot have a folder of its name")
    if cores is not None and cores < 1:
        raise ValueError(f"cores = {cores}; allowed: 1 and more")
    calls = SideBySide(cores or len(os.sched_getaffinity(0)))
    results = {}

    def compute(name, parameters):
        try:
            results[name] = result_of(
                functools.partial(calls.call, time_limit=time_limit), file, parameters,
                ranks, folder / str(name), program,
                options_of(force, run_gmsh_script))
        except RunFailed as problem:
            results[name] = problem

    calls.do([(ranks, functools.partial(compute, *item)) for item in variants.items()])
    results = {name: results[name] for name in variants}
    for result in results.values():
        if isinstance(result, RunFailed) and not keep_failed:
            raise result
    return results
