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


def digits_of(value, digits=4):
    """A number with so many significant digits, zeros at its end included."""
    return f"{value:#.{digits}g}".rstrip(".")


def bracket_text(lower, upper, digits, factor=1.):
    """Both ends of a bracket, rounded outwards, so that the text is a bracket too."""
    low, high = (Context(prec=digits, rounding=rounding).create_decimal(
        Decimal(repr(float(value))) / Decimal(factor))
                 for value, rounding in ((lower, ROUND_FLOOR), (upper, ROUND_CEILING)))
    return f"{digits_of(float(low), digits)} to {digits_of(float(high), digits)}"


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
        return f"F = {digits_of(run.value('safety/factor'))}"
    if run.method == "limit load" and lower is not None and upper is not None:
        name, factor = unit_of(run.value("bounds/unit"), max(abs(lower), abs(upper)))
        return (("load " if name else "load factor ") + bracket_text(lower, upper, 4, factor)
                + f" {name}".rstrip() + certainty_of(run))
    if run.method == "shakedown":
        lower, upper = (number_in(run, f"shakedown/{side}") for side in ("lower", "upper"))
        return ("" if lower is None or upper is None else
                f"factor {digits_of(lower)} to {digits_of(upper)}")
    value = number_in(run, "limit_load/value")
    if value is not None:
        name, factor = unit_of(run.value("limit_load/unit"), abs(value))
        return (("limit load " if name else "limit load factor ") +
                f"{digits_of(value / factor)} {name}".rstrip())
    value = number_in(run, "seepage/stored")
    if value is not None:
        return f"{value:.3g} {run.value('seepage/stored_unit')} of water left"
    value = number_in(run, "seepage/discharge")
    return "" if value is None else f"discharge {value:.3g} {run.value('seepage/unit')}"


def answer_of(run):
    """The number for which the run was made, in a line; empty if there is no single one."""
    def number(key):
        return number_in(run, key)

    known = number("reference/expected")
    error = number("reference/relative_error")
    beside = ("" if known is None or error is None else
              f"; reference {known:.6g} ({100. * error:+.2f} %)")
    quantity = run.value("reference/quantity")
    if number("safety/factor") is not None:
        lower, upper = number("safety/lower"), number("safety/upper")
        between = ("" if lower is None or upper is None else
                   f" (certified: {bracket_text(lower, upper, 5)})"
                   if run.method == "strength reduction" else
                   f" (on this mesh: equilibrium at {lower:.5g}, none at {upper:.5g})")
        return (f"Factor of safety: {number('safety/factor'):.5g}{between}" +
                beside * (quantity == "safety/factor"))
    if number("bounds/lower") is not None and number("bounds/upper") is not None:
        unit = run.value("bounds/unit")
        ends = bracket_text(number("bounds/lower"), number("bounds/upper"), 6)
        return (f"Between {ends.replace(' to ', ' and ')}" +
                f" {unit}" * (unit not in (None, "-")) +
                beside * (quantity == "bounds/middle"))
    if number("limit_load/value") is not None:
        return (f"Limit load: {number('limit_load/value'):.6g} "
                f"{run.value('limit_load/unit')}".removesuffix("-").rstrip() +
                beside * (quantity == "limit_load/value"))
    if number("seepage/stored") is not None:
        return (f"Drainable water at the end: {number('seepage/stored'):.5g} "
                f"{run.value('seepage/stored_unit')}" + beside * (quantity == "seepage/stored"))
    if number("seepage/discharge") is not None:
        return (f"Discharge: {number('seepage/discharge'):.5g} {run.value('seepage/unit')}" +
                beside * (quantity == "seepage/discharge"))
    return ""


LOADS = {"velocity": "of the loaded boundary", "weight": "by which the weight may be multiplied",
         "tractions": "by which the tractions may be multiplied",
         "weight and tractions": "by which weight and tractions may be multiplied"}


def meaning_of(run):
    """Sentences that say what the answer, and what its bracket, is of."""
    associated = ([] if "non_associated" not in run.summary else [
        "The soil dilates less than its friction: only the upper end is certified for it."])
    loads = number_in(run, "bounds/lower"), number_in(run, "bounds/upper")
    proof = ("A stress field in equilibrium proves the lower end, a mechanism the upper one; "
             "neither depends on how fine the mesh is.")
    if is_strength_reduction(run):
        factor = "The factor of safety F divides c and tan φ of the soils at failure."
        if run.method == "strength reduction":
            return [factor, proof, *associated]
        lower, found = number_in(run, "safety/lower"), run.value("safety/criterion")
        if number_in(run, "safety/factor") is not None:
            found = "It was found by steps on this mesh, and is no bound."
        elif lower is not None:
            found = f"By steps on this mesh, F is {digits_of(lower)} or more: {found}."
        else:
            found = f"{found[:1].upper()}{found[1:]}."
        sentences = [factor, found]
        if None not in loads:
            sentences.append(
                f"Another factor: at full strength all loads may be multiplied by "
                f"{bracket_text(*loads, 4)}{certainty_of(run)}; this is no bracket of F.")
        return sentences
    if run.method == "limit load" and None not in loads:
        which = LOADS.get(run.value("load/factor_of"), "")
        kind = "factor" if run.value("bounds/unit") == "-" else "limit load"
        return [f"Bracket of the {kind} {which} at full strength.", proof, *associated]
    if run.method == "seepage":
        return ["Water that flows through the body per time, steadily."
                if number_in(run, "seepage/stored") is None else
                "Water in the body that can still drain."]
    if number_in(run, "limit_load/value") is None:
        return []
    sentences = ["Mean of the plateau of the load, by steps on this mesh; it is no bound."]
    if None not in loads and run.value("bounds/unit") == run.value("limit_load/unit"):
        sentences.append(f"Bounds of the same load: {bracket_text(*loads, 5)} "
                         f"{run.value('bounds/unit')}{certainty_of(run)}.")
    return sentences


def unit_of(unit, size):
    """Name and value of the unit of a number up to a size; no name of factors."""
    return ("", 1.) if unit in (None, "-", "") else unit_for(size, unit)


def heading(run, quantity=""):
    """The title of a picture of a run: its name, its answer, and the quantity shown."""
    words = [word for word in (short_answer(run), quantity) if word]
    return plain(run.name) + (": " if words else "") + ", ".join(words)


def moment(run, time):
    """When a field was written, in the quantity that the run increases: the factor of
    safety, the factor of scaled loads, or time."""
    try:
        table = run.statistics
        row = int(np.argmin(np.abs(table["time (s)"] - time)))
        for name, symbol in (("strength factor (-)", "F"), ("load factor (-)", "load factor")):
            if name in table and np.isfinite(table[name][row]):
                return f"{symbol} = {digits_of(table[name][row])}"
    except (Missing, KeyError, IndexError):
        pass
    return f"t = {time:.4g} s"
