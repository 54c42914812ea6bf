# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A table of runs, in Markdown."""

from geocone.files import write_listed
from geocone.reader import ReadError, reason

WORDS = ("run", "method", "element", "reference")  # columns of texts


def cell_size(run):
    """The size of the run's cells as its parameters give it (m)."""
    values = run.parameters
    try:
        if values["Geometry/Shape"] == "file":
            return "-"
        if values["Mesh/Type"] == "uniform":
            return values["Mesh/Cell size"]
        return f"{values['Mesh/Smallest size']} to {values['Mesh/Largest size']}"
    except KeyError as problem:
        raise ReadError(f"'{run.folder / 'parameters.prm'}' has no {problem}")


def cells_of(run, unit):
    """The cells of a run's line, by the names of the columns."""
    def number(key, digits, factor=1.):
        value = run.value(key)
        return "-" if value is None else f"{factor * value:.{digits}f}"
    return {"run": run.folder.resolve().name, "method": run.value("size/method") or "FEM",
            "element": run.summary["size"]["element"], "cells (m)": cell_size(run),
            "points": number("size/points", 0),
            "unknowns": number("size/dofs", 0),
            "steps": number("newton/steps", 0),
            "iterations per step": number("newton/iterations_mean", 1),
            "time (s)": number("cost/total_s", 1),
            f"limit load ({unit})": number("limit_load/value", 2),
            "reference": f"{run.value('limit_load/reference_name') or ''} "
            f"{number('limit_load/reference', 2)}".strip(),
            "error (%)": number("limit_load/relative_error", 2, 100.)}


def write_table(runs, path):
    """Writes and prints the table, with aligned columns."""
    try:
        unit = ", ".join(sorted({run.per_metre("N") for run in runs}))
        lines = [{name: " ".join(str(cell).replace("|", "\\|").split())
                  for name, cell in cells_of(run, unit).items()} for run in runs]
    except (LookupError, TypeError, ValueError) as problem:
        raise ReadError(f"a summary.json is damaged: {reason(problem)}")
    columns = [[name, *(line[name] for line in lines)] for name in lines[0]]
    widths = [max(map(len, column)) for column in columns]
    rows = [[cell.ljust(width) if name in WORDS else cell.rjust(width)
             for cell, width, name in zip(row, widths, lines[0])]
            for row in zip(*columns)]
    rows.insert(1, ["-" * width if name in WORDS else "-" * (width - 1) + ":"
                    for width, name in zip(widths, lines[0])])
    text = "".join(f"| {' | '.join(row)} |\n" for row in rows)
    write_listed(path, text)
    print(text + str(path))
