# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs against exact or bounded references.

A group's `check` (of the study file) names the value and the reference, both keys of
summary.json or the latter a number (or a number for each value of the axis that `by`
names), and the band [low, high] of value/reference - 1, or of the value itself if
there is no reference. status = "failed" is for runs that must not find an equilibrium.
"""

from geocone.report.figures import COLORS, number, percent, value_of
from geocone.report.schema import takes
from geocone.style import plain, subplots


def reference_of(row):
    """The reference of a row's check, or None."""
    check = row["check"]
    reference = check.get("reference")
    if isinstance(reference, dict):
        reference = reference.get(str(row["axes"].get(check["by"])))
    return value_of(row, reference) if isinstance(reference, str) else reference


def verdict(row):
    """Value, reference, error and whether the check holds."""
    check = row["check"]
    value, reference = value_of(row, check.get("value", "")), reference_of(row)
    wanted = check.get("status", "finished")
    if row["status"] != wanted:
        return value, reference, None, False
    if "value" not in check:
        return None, None, None, True
    if value is None:
        return value, reference, None, False
    measured = value if reference is None else value / reference - 1.
    good = check.get("low", -float("inf")) <= measured <= check.get("high", float("inf"))
    return value, reference, None if reference is None else measured, good


def band(check):
    """The band of a check in words."""
    relative = "reference" in check
    ends = [check.get(name) for name in ("low", "high")]
    words = ["" if end is None else f"{100. * end:+g} %" if relative else f"{end:g}"
             for end in ends]
    if ends[0] is None or ends[1] is None:
        return f">= {words[0]}" if words[0] else f"<= {words[1]}" if words[1] else "-"
    return f"{words[0]} to {words[1]}"


@takes()
def table(rows, options):
    """Each check: reference, value, error, band, verdict, source, command."""
    lines = []
    for row in rows:
        if not row["check"]:
            continue
        value, reference, error, good = verdict(row)
        check, unit = row["check"], row["check"].get("unit", "")
        ended = ("no equilibrium, as it must be" if check.get("status") == "failed"
                 else "")
        lines.append([
            ", ".join(word for word in (row["group"], row["label"]) if word),
            f"{number(reference, 5)} {unit}" if reference is not None else "-",
            f"{number(value, 5)} {unit}" if "value" in check else ended or "-",
            percent(error), band(check),
            "holds" if good else "MISSED" + (f": {row['reason']}" if row["reason"]
                                             else ""),
            check.get("source", "-"), row["command"]])
    return ["quantity", "reference", "value", "error", "band", "verdict", "source",
            "command"], lines


@takes()
def errors(rows, options):
    """The relative errors of all checks inside of their bands."""
    shown = [(row, *verdict(row)) for row in rows if "reference" in row["check"]]
    shown = [part for part in shown if part[3] is not None]
    figure, axes = subplots(figsize=(9.5, 1. + 0.24 * len(shown)))
    for i, (row, _, _, error, good) in enumerate(shown):
        low, high = (row["check"].get(name) for name in ("low", "high"))
        axes.barh(i, 100. * (high - low), left=100. * low, height=0.7, color="#dde7ee")
        axes.plot(100. * error, i, "o" if good else "X", markersize=5.,
                  color=COLORS[0] if good else COLORS[1])
    axes.axvline(0., color="black", linewidth=1.)
    axes.set_yticks(range(len(shown)), [plain(", ".join(
        word for word in (row["group"], row["label"]) if word)) for row, *_ in shown])
    axes.tick_params(axis="y", labelsize=8)
    axes.set(xlabel="error (%); grey: the band", ylim=(len(shown) - 0.4, -0.6))
    axes.grid(axis="y", visible=False)
    return figure
