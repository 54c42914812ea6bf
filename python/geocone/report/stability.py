# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of studies/stability.toml: what becomes of hard cases.

A scene whose check says status = "failed" has no solution and must be refused. Equations
that are solved are not yet a right load: a case whose limit load is known counts as solved
if its load is near enough to that.
"""

import numpy as np

from geocone.reader import ReadError, leaves, read_table
from geocone.parameter_file import parameters_of
from geocone.report.schema import takes

TOLERANCE = 1e-10  # 'Newton/Tolerance'
LAW = 1e-8  # natural-map error of an accepted state
ENERGY = 1e-6  # relative error of the balance of energies
NEAR = 0.05  # relative error of the load of a solved case
HEAD = ["case", "phi, theta, nu", "method", "unknowns", "steps",
        "iterations per step, mean / max", "failed tries", "natural-map error",
        "worst residual", "known limit (N/m)", "load against it", "time (s)", "verdict"]


def name_of(row):
    """The case as the table calls it."""
    return ", ".join(filter(None, (row["group"], row["label"])))


def steps_of(row):
    """The columns of statistics.csv; none if no step is done."""
    try:
        return read_table(row["folder"] / "statistics.csv")
    except ReadError:
        return {}


def parameters(row):
    """The parameters of a run; none if it was refused."""
    file = row["folder"] / "parameters.prm"
    return parameters_of(file) if file.is_file() else {}


def soil_value(values, name):
    """A parameter of the first material."""
    soil = values.get("Materials/Names", "soil").split(",")[0].strip()
    return values.get(f"Materials/{soil}/{name}", "-")


def load_of(row):
    """The limit load, or that of the last step, over the known one; None without one."""
    limit = row["summary"].get("limit_load") or {}
    value = limit.get("last") if limit.get("value") is None else limit["value"]
    known = limit.get("reference")
    return value / known if known and value is not None else None


def is_known(row):
    """Whether the known load is that of the case: it is the limit of associated flow."""
    values = parameters(row)
    return load_of(row) is not None and (
        soil_value(values, "Friction angle") == soil_value(values, "Dilatancy angle"))


def verdict(row):
    """Outcome of a run: (kind, text)."""
    table, reason = steps_of(row), row["reason"]
    must_fail = row["check"].get("status") == "failed"
    if row["code"] is None:
        steps = len(table.get("step", []))
        return "late", f"**no end in time**, {steps} steps done"
    if row["code"] not in (0, 1) or (row["code"] == 1 and
                                     not reason.startswith("error: ")):
        return "crash", f"**crash**, code {row['code']}: {reason[:200]}"
    numbers = [value for value in leaves(row["summary"]).values()
               if isinstance(value, float)]
    if not np.all(np.isfinite(np.concatenate([numbers, *table.values()]))):
        return "garbage", "**numbers that are not finite**"
    if row["code"] == 1:
        first = reason.removeprefix("error: ").split(" allowed: ")[0]
        return (("refused", f"refused, as it must be: {first}") if must_fail else
                ("reported", f"ended: {first}"))
    if must_fail:
        return "garbage", "**not refused**"
    # Rounding in the stresses may be larger than the tolerance (doc/theory/newton.md).
    at_floor = leaves(row["summary"]).get("newton/steps_at_rounding_floor", 0)
    if np.count_nonzero(table["residual (-)"] > TOLERANCE) > at_floor:
        return "unsolved", "**finished, but a residual is above 1e-10**"
    if max(table["natural-map error (-)"]) > LAW:
        return "unsolved", f"**finished, but a natural-map error is above {LAW:g}**"
    energy = row["summary"]["energy"]
    if (energy["identity_error_max"] or 0.) > ENERGY or \
            (energy["least_step_loss_relative"] or 0.) < -ENERGY:
        return "unsolved", "**finished, but the energies do not balance**"
    if not is_known(row):
        return "converged", "converged; its load is not known"
    error = load_of(row) - 1.
    if abs(error) > NEAR:
        return "off", f"converged; **its load is off by {100. * error:+.1f} %**"
    return "solved", "solved"


def load(row):
    """The reference, what it is, and the load against it."""
    limit, ratio = row["summary"].get("limit_load") or {}, load_of(row)
    if not limit.get("reference"):
        return "-", "-"
    name = "Prandtl" if limit.get("reference_name") == "Prandtl" else "given"
    kind = " (last)" if limit.get("value") is None else ""
    known = row["status"] == "finished" and ratio is not None
    return (f"{name}, {limit['reference']:.4g}",
            f"{100. * (ratio - 1.):+.1f} %{kind}" if known else "-")


def line_of(row):
    """The line of a run."""
    summary, values, table = row["summary"], parameters(row), steps_of(row)
    size = summary.get("size", {})
    # Not the summary: a run that was stopped has none.
    iterations = table.get("iterations (-)", [])

    def largest(name):
        return f"{max(table[name]):.0e}" if table else "-"
    return [name_of(row), ", ".join(soil_value(values, name) for name in (
        "Friction angle", "Dilatancy angle", "Poisson ratio")),
            " ".join((size.get("method", "-"), size.get("element", ""))).strip(),
            size.get("dofs", "-"), len(iterations) if summary else "-",
            f"{np.mean(iterations):.1f} / {max(iterations):.0f}" if table else "-",
            f"{sum(table['failed substeps (-)']):.0f}" if table else "-",
            largest("natural-map error (-)"), largest("residual (-)"), *load(row),
            f"{row['seconds']:.0f}", verdict(row)[1]]


@takes()
def table(rows, _):
    """A line for each case."""
    return HEAD, [line_of(row) for row in rows]


@takes()
def counts(rows, _):
    """How many cases have come to which end."""
    kinds = [verdict(row)[0] for row in rows]
    reported = kinds.count("reported") + kinds.count("refused")
    near, off, unknown = map(kinds.count, ("solved", "off", "converged"))
    converged = near + off + unknown
    return (["cases", "converged to 1e-10", "solved: with a load within 5 % of the known one",
             "with a load that is further off", "whose load is not known",
             "ended by a clear report", "otherwise"],
            [[len(kinds), converged, near, off, unknown, reported,
              len(kinds) - converged - reported]])


@takes()
def scenes(rows, _):
    """Description of each scene: the comment at the beginning of its parameter file."""
    lines = []
    for name, file in {row["group"]: row["file"] for row in rows}.items():
        words = []
        for line in file.read_text().splitlines():
            if not line.startswith("#"):
                break
            words.append(line[1:].strip())
        lines.append([f"`{name}`", " ".join(words)])
    return ["scene", "what it is"], lines
