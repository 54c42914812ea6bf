# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Schema of study files: the kinds of values, the keys of all tables with their kinds,
and the check of a table. Kinds of options stand at the functions that take them."""

import difflib
import importlib
import re
from collections import namedtuple

MOST_RUNS = 10000  # of a study
MOST_RANKS = 1024

# holds: whether a value is of the kind; allowed: the values, in words.
Kind = namedtuple("Kind", "holds allowed")


class StudyError(Exception):
    """Wrong input: file, place, key, value; what is allowed; the remedy."""


def refuse(path, what, allowed, remedy="correct it in the study file; doc/studies.md "
           "explains the keys, studies/quick.toml is an example"):
    """Throws the error of wrong input."""
    raise StudyError(f"{path}: {what}\n  allowed: {allowed}\n  remedy:  {remedy}")


def require(good, path, what, *words):
    """Throws StudyError unless good."""
    if not good:
        refuse(path, what, *words)


def shown(value):
    """A value as errors show it."""
    text = repr(value)
    return text if len(text) <= 80 else text[:77] + "..."


# Kinds.

def text(most, forbidden, where=""):
    """Texts of up to so many characters, without forbidden ones."""
    return Kind(lambda value: isinstance(value, str) and len(value) <= most and
                not re.search(forbidden, value),
                f"a text of up to {most} characters{where}, without control characters")


def between(least, most, whole=False):
    """Numbers in a range."""
    return Kind(lambda value: isinstance(value, int if whole else (int, float)) and
                not isinstance(value, bool) and least <= value <= most,
                f"a {'whole ' * whole}number from {least:g} to {most:g}")


def words(*choices):
    """Some words."""
    return Kind(lambda value: isinstance(value, str) and value in choices,
                " | ".join(choices))


def list_of(kind, least=0, most=1000):
    """Lists whose entries are of a kind."""
    return Kind(lambda value: isinstance(value, list) and least <= len(value) <= most and
                all(map(kind.holds, value)),
                f"a list of {least} to {most}, each {kind.allowed}")


def table_of(kind):
    """Tables whose values are of a kind."""
    return Kind(lambda value: isinstance(value, dict) and
                all(LINE.holds(key) and kind.holds(part) for key, part in value.items()),
                f"a table, each value {kind.allowed}")


def any_of(*kinds):
    """A value of one of several kinds."""
    return Kind(lambda value: any(kind.holds(value) for kind in kinds),
                "; or ".join(kind.allowed for kind in kinds))


def is_name(value):
    """Whether the names of folders and files can be made of the text."""
    return (LINE.holds(value) and len(value) <= 100 and not value.startswith(".") and
            re.search("[A-Za-z0-9]", value) is not None)


TEXT = text(100000, r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
LINE = text(1000, r"[\x00-\x1f\x7f-\x9f]", " in one line")
NAME = Kind(is_name, "a text of up to 100 characters in one line, with a letter of a to z or a "
            "digit, that does not begin with a dot")
FLAG = Kind(lambda value: isinstance(value, bool), "true | false")
NUMBER, POSITIVE = between(-1e100, 1e100), between(1e-100, 1e100)
VALUE = any_of(LINE, NUMBER, FLAG)
VIEW = list_of(NUMBER, 4, 4)
SETTING = Kind(lambda value: LINE.holds(value) and "=" in value[1:],
               "'PARAMETER = VALUE', a text in one line")
SETTINGS = list_of(SETTING, most=100)
VALUES = list_of(VALUE, 1, MOST_RUNS)
LABELS = Kind(lambda value: table_of(SETTINGS).holds(value) and value != {},
              "a table {LABEL = [settings], ...}")
TEMPLATE = Kind(lambda value: isinstance(value, dict) and value.keys() == {"values", "set"} and
                list_of(any_of(LINE, NUMBER), 1, MOST_RUNS).holds(value["values"]) and
                SETTINGS.holds(value["set"]) and all("{" in part for part in value["set"]),
                "{values = [numbers or texts], set = [settings with {} for the value]}")
# Published values of a quantity that is bounded: exact, bounds of others, estimates, values of a
# problem that differs. A number as a text has been rounded to its digits.
STANDINGS = "exact", "upper bound", "lower bound", "estimate", "other problem"
DIGITS = Kind(lambda value: isinstance(value, str) and
              re.fullmatch(r"-?\d{1,15}(\.\d{1,15})?", value, re.ASCII) is not None,
              "digits as a text")
PUBLISHED = list_of(Kind(
    lambda value: isinstance(value, list) and len(value) == 3 and
    any_of(NUMBER, DIGITS).holds(value[0]) and words(*STANDINGS).holds(value[1]) and
    LINE.holds(value[2]),
    f"[number or \"digits as printed\", {' | '.join(STANDINGS)}, source]"))
AXIS = any_of(Kind(VALUES.holds, "a list of the values of a parameter, one or more: numbers, "
                   "texts, true, false"), TEMPLATE, LABELS)
TABLE = Kind(lambda value: isinstance(value, dict), "a table")
TABLES = Kind(lambda value: isinstance(value, list) and all(map(TABLE.holds, value)),
              "tables, each [[in two brackets]]")

# The keys of the tables of a study file.
STUDY = {"title": LINE, "text": TEXT, "defaults": TABLE, "group": TABLES, "section": TABLES}
DEFAULTS = {"file": LINE, "set": SETTINGS, "vary": TABLE, "ranks": between(1, MOST_RANKS, True),
            "alone": FLAG, "repeat": between(1, MOST_RUNS, True), "time_limit": between(1, 1e8)}
GROUP = {"name": NAME, **DEFAULTS, "check": TABLE}
CHECK = {"value": LINE, "reference": any_of(NUMBER, LINE, table_of(NUMBER)), "by": LINE,
         "low": NUMBER, "high": NUMBER, "unit": LINE, "source": LINE,
         "published": any_of(PUBLISHED, table_of(PUBLISHED)), "divisor": POSITIVE,
         "status": words("finished", "failed")}
SECTION = {"title": LINE, "text": TEXT, "figure": TABLES, "table": TABLES}
SHOWN = {"kind": LINE, "groups": list_of(LINE), "caption": TEXT}


def check_table(path, where, table, keys, required=()):
    """Refuses unknown keys, values that are not of their kind, and what is missing."""
    for key, value in table.items():
        if key not in keys:
            near = difflib.get_close_matches(key, keys, 1)
            refuse(path, f"{where}: unknown key {shown(key)}", ", ".join(keys),
                   f"write '{near[0]}' instead" if near else "take it out")
        require(keys[key].holds(value), path, f"{where}: {key} = {shown(value)}",
                keys[key].allowed)
    for key in required:
        require(key in table, path, f"{where}: there is no '{key}'",
                f"{key} = {keys[key].allowed}", f"add '{key} = ...' there")


# Functions that make figures and tables.

def takes(*required, **options):
    """Declares the required and optional arguments of a function that study files may name, by
    their kinds. Functions without this declaration cannot be named."""
    def mark(function):
        function.required, function.options = required, options
        return function
    return mark


def find(kind):
    """The function of a kind of figure or table; None if there is none."""
    module, _, name = kind.rpartition(".")
    if not re.fullmatch("[a-z_]+", module):
        return None
    try:
        function = getattr(importlib.import_module(f"geocone.report.{module}"), name, None)
    except ModuleNotFoundError as problem:
        if problem.name != f"geocone.report.{module}":
            raise
        return None
    return function if hasattr(function, "options") else None


def check_shown(path, where, table):
    """Refuses a figure or a table that nobody can make."""
    known = {key: value for key, value in table.items() if key in SHOWN}
    check_table(path, where, known, SHOWN, ("kind",))
    function = find(table["kind"])
    require(function, path, f"{where}: unknown figure or table {shown(table['kind'])}",
            "MODULE.FUNCTION of the list in doc/studies.md, e.g. figures.load_displacement")
    check_table(path, f"{where}, {table['kind']}", table, {**SHOWN, **function.options},
                function.required)
