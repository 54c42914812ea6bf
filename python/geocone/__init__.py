# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs geocone and reads the results.

    import geocone
    run = geocone.run("prm/footing_mpm.prm", {"Mesh/Cell size": 0.1}, progress=True)
    run = geocone.read("results/footing_mpm")       # the same, of a run that is there
    runs = geocone.run_many("prm/footing_mpm.prm", {  # side by side
        size: {"Mesh/Cell size": size} for size in (0.1, 0.05)})
    run.summary["limit_load"]["value"]              # N/m
    run.statistics["load (N/m)"]                    # a numpy array, a value per step
    run.fields("points").point_data["velocity"]     # meshio, the last state
    run.figure("load_displacement")                 # a figure of matplotlib
    geocone.to_dataframe(runs)                      # a table of pandas
    scene = geocone.Scene("prm/footing_mpm.prm")
    scene["Materials"]["soil"]["Cohesion"] = 3e3    # Pa
    scene.run()
    clay = geocone.MaterialPoint("prm/element/undrained_triaxial.prm")   # in this process
    clay.run()["q (Pa)"].max()

`python3 -m geocone plot RUN-FOLDER` draws pictures, `python3 -m geocone report` computes
studies. Nothing that is read is executed.
"""

from geocone.modules import MissingModule, require

require("numpy")  # the error has a remedy

# pylint: disable=wrong-import-position
from geocone.frames import to_dataframe  # noqa: E402
from geocone.program import example, find_program  # noqa: E402
from geocone.point import MaterialPoint  # noqa: E402
from geocone.progress import Progress  # noqa: E402
from geocone.reader import Missing, ReadError, Run, Table, read  # noqa: E402
from geocone.runner import RunFailed, run  # noqa: E402
from geocone.scene import Scene, Section, UnknownParameter  # noqa: E402
from geocone.side_by_side import run_many  # noqa: E402

__all__ = ["MaterialPoint", "Missing", "MissingModule", "Progress", "ReadError", "Run",
           "RunFailed", "Scene", "Section", "Table", "UnknownParameter", "example",
           "find_program", "read", "run", "run_many", "to_dataframe"]

for name in __all__:  # as users and the reference name them
    globals()[name].__module__ = "geocone"
del name
