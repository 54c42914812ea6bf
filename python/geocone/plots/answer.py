# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The answer of a run in words: its factor of safety or its load, with the bracket."""

from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal

import numpy as np

from geocone.reader import Missing
from geocone.style import plain, unit_for


def number_in(run, key):
    """A number of the summary, or None."""
    value = run.value(key)
    return None if isinstance(value, (str, bool)) else value


def bracket_text(lower, upper, digits, factor=1.):
    """Both ends of a bracket, rounded outwards, so that the text is a bracket too."""
    low, high = (Context(prec=digits, rounding=rounding).create_decimal(
        Decimal(repr(float(value))) / Decimal(factor))
                 for value, rounding in ((lower, ROUND_FLOOR), (upper, ROUND_CEILING)))
    return f"{float(low):.{digits}g} to {float(high):.{digits}g}"


def is_strength_reduction(run):
    """Whether strength is reduced in a run: time is then a measure of the factor."""
    return "safety" in run.summary


def certainty_of(run):
    """In brackets, whether a bracket of bounds is certified: both bounds are for associated
    flow; for less dilatancy the upper one alone is."""
    if run.value("bounds/certified") is False:
        return " (not certified)"
    return (" (certified)" if "non_associated" not in run.summary else
            " (the upper end is certified)")


def short_answer(run):
    """The answer as titles of pictures have it; empty if there is no single one."""
    lower, upper = number_in(run, "bounds/lower"), number_in(run, "bounds/upper")
    if number_in(run, "safety/factor") is not None:
        if run.method == "strength reduction":
            return (f"F = {bracket_text(run.value('safety/lower'), run.value('safety/upper'), 4)}"
                    + certainty_of(run))
        return f"F = {run.value('safety/factor'):.4g}"
    if run.method == "limit load" and lower is not None and upper is not None:
        name, factor = unit_of(run.value("bounds/unit"), max(abs(lower), abs(upper)))
        return (("load " if name else "load factor ") + bracket_text(lower, upper, 4, factor)
                + f" {name}".rstrip() + certainty_of(run))
    value = number_in(run, "limit_load/value")
    if value is not None:
        name, factor = unit_of(run.value("limit_load/unit"), abs(value))
        return (("limit load " if name else "limit load factor ") +
                f"{value / factor:.4g} {name}".rstrip())
    return ""


def unit_of(unit, size):
    """Name and value of the unit of a number up to a size; no name of factors."""
    return ("", 1.) if unit in (None, "-", "") else unit_for(size, unit)


def heading(run, quantity=""):
    """The title of a picture of a run: its name, its answer, and the quantity shown."""
    words = [word for word in (short_answer(run), quantity) if word]
    return plain(run.name) + (": " if words else "") + ", ".join(words)


def moment(run, time):
    """When a field was written, in the quantity that the run increases: the factor of
    safety, the factor of raised loads, or time."""
    try:
        table = run.statistics
        row = int(np.argmin(np.abs(table["time (s)"] - time)))
        for name, symbol in (("strength factor (-)", "F"), ("load factor (-)", "load factor")):
            if name in table and np.isfinite(table[name][row]):
                return f"{symbol} = {table[name][row]:.4g}"
    except (Missing, KeyError, IndexError):
        pass
    return f"t = {time:.4g} s"
