# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Summaries of many runs as a table of pandas."""

from collections.abc import Hashable, Iterable, Mapping
from typing import TYPE_CHECKING

from geocone.modules import require
from geocone.reader import Run, leaves
from geocone.runner import RunFailed

if TYPE_CHECKING:
    import pandas


def to_dataframe(runs: Mapping[Hashable, Run | RunFailed] | Iterable[Run | RunFailed],
                 columns: Iterable[str] | None = None) -> "pandas.DataFrame":
    """Puts the summaries of runs into a table.

    Parameters
    ----------
    runs
        {key: run} as of run_many(), also with keep_failed; or runs, whose keys are the names
        of their folders.
    columns
        Values of the summaries, e.g. ["limit_load/value", "size/cells"]. None: all numbers,
        texts and truth values but those of the process.

    Returns
    -------
    pandas.DataFrame
        A row for each run with its key as index (tuples are an index of several levels);
        the column "status", and those of the values, "topic/name".

    Raises
    ------
    MissingModule
        If pandas is not installed.
    """
    pandas = require("pandas")
    if not isinstance(runs, Mapping):
        runs = {run.folder.name: run for run in runs}
    rows = []
    for run in runs.values():
        if isinstance(run, RunFailed):
            rows.append({"status": f"failed: {run}"})
            continue
        values = {key: value for key, value in leaves(run.summary).items()
                  if key != "status" and not key.startswith("run/")
                  and not isinstance(value, list)}
        rows.append({"status": run.status, **values})
    frame = pandas.DataFrame(rows, index=pandas.Index(list(runs)))
    return frame if columns is None else frame.reindex(columns=["status", *columns])
