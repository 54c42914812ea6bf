# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs geocone and reads what its runs have left.

    import geocone
    run = geocone.run("prm/footing_mpm.prm", {"Mesh/Cell size": 0.1})
    run = geocone.read("results/footing_mpm")       # the same, of a run that is there
    runs = geocone.run_many("prm/footing_mpm.prm", {  # side by side
        size: {"Mesh/Cell size": size} for size in (0.1, 0.05)})
    run.summary["limit_load"]["value"]              # N/m
    run.statistics["load (N/m)"]                    # a numpy array, a value per step
    run.fields("points").point_data["velocity"]     # meshio, the last state

`python3 -m geocone plot RUN-FOLDER` draws pictures, `python3 -m geocone report` computes
studies. Nothing that is read is executed.
"""

from geocone.reader import Missing, ReadError, Run, read
from geocone.runner import RunFailed, example, run
from geocone.side_by_side import run_many

__all__ = ["Missing", "ReadError", "Run", "RunFailed", "example", "read", "run",
           "run_many"]
