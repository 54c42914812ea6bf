# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run as a notebook shows it: a small table and a picture."""

import html
from typing import TYPE_CHECKING

from geocone.modules import MissingModule, require

if TYPE_CHECKING:
    from geocone.reader import Run

# Numbers on the quality of a solution, and how they are written.
QUALITY = {"bounds/gap": "gap {:.2%}", "newton/failures": "{} failed substeps",
           "quality/natural_map_error_max": "natural-map error at most {:.1e}",
           "quality/cone_violation_max": "cone violation at most {:.1e}",
           "energy/identity_error_max": "energy identity within {:.1e}"}


def html_of(run: "Run") -> str:
    """A table of a run: name, status, answer, quality, size, cost, warnings, and its main
    picture if it has drawn one. Without the modules that draw, answer and picture are left
    out."""
    answer, picture = "", ""
    try:
        for name in "matplotlib", "PIL":
            require(name)
        from geocone.plots import page
        answer = page.answer_of(run)
        files = [run.folder / name for name in page.CAPTIONS if name != "model.png"]
        picture = next((page.as_data(file.read_bytes()) for file in files if file.is_file()), "")
    except MissingModule:
        pass
    numbers = {key: run.value(key) for key in QUALITY}
    size = [f"{run.value(f'size/{name}')} {name}" for name in ("cells", "points")
            if run.value(f"size/{name}")]
    seconds = run.value("cost/total_s")
    rows = {"status": run.status, "answer": answer,
            "quality": ", ".join(QUALITY[key].format(value) for key, value in numbers.items()
                                 if isinstance(value, (int, float))),
            "size": ", ".join([run.method or "", *size]).lstrip(", "),
            "time": "" if seconds is None else f"{seconds:.3g} s",
            "warnings": "; ".join(run.warnings), "folder": str(run.folder)}
    lines = "".join(f"<tr><th style='text-align:left'>{name}</th>"
                    f"<td style='text-align:left'>{html.escape(text)}</td></tr>"
                    for name, text in rows.items() if text)
    return (f"<table><caption><b>{html.escape(run.name)}</b></caption>{lines}</table>" +
            (f"<img src='{picture}' style='max-width:40em' alt='{html.escape(answer)}'>"
             if picture else ""))
