# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads study files: which runs there are, and what is shown of them."""

import dataclasses
import hashlib
import itertools
import math
import os
import re
import tomllib
from pathlib import Path

from geocone.parameter_file import IncludeError, lines_of, text_of
from geocone.report.schema import (AXIS, CHECK, DEFAULTS, GROUP, LINE, MOST_RUNS, NAME, SECTION,
                                   STUDY, TEMPLATE, check_shown, check_table, refuse,
                                   require, shown)

LARGEST = 1 << 20  # bytes of a study file


@dataclasses.dataclass
class Run:
    """One call of geocone."""
    group: str
    axes: dict       # name of the axis: value or label
    file: Path       # parameter file
    settings: list   # 'PARAMETER = VALUE', in the order in which they count
    ranks: int
    alone: bool      # nothing else is computed meanwhile, so that times are true
    time_limit: float  # s
    check: dict      # of the group

    @property
    def label(self):
        """The values of the axes, in words."""
        return ", ".join(f"{name.rsplit('/', 1)[-1]} = {value}"
                         if re.fullmatch(r"[-+.\de]+", str(value)) else value
                         for name, value in self.axes.items())

    @property
    def name(self):
        """A file name: the group and the values of the axes."""
        words = [self.group]
        for axis, value in self.axes.items():
            words.append(f"{axis.rsplit('/', 1)[-1]} {value}"
                         if isinstance(value, (int, float)) else value)
        return re.sub(r"[^a-z0-9.]+", "_", "-".join(words).lower()).strip("._")

    def options(self):
        """The options of the call that the study asks for."""
        return [word for setting in self.settings for word in ("--set", setting)]

    def inputs(self):
        """Input that the result depends on, without the program, as one text."""
        return "\n".join([content_of(self.file), *self.settings, str(self.ranks)])


@dataclasses.dataclass
class Study:
    """A study file."""
    path: Path
    title: str
    text: str
    runs: list
    sections: list

    @property
    def name(self):
        """The name of its results."""
        return self.path.stem

    def only(self, groups):
        """Leaves some groups of runs, and what shows some of them."""
        known = {run.group for run in self.runs}
        for name in groups:
            require(name in known, self.path, f"unknown group '{name}'",
                    ", ".join(sorted(known)), "name one of these with --only")
        self.runs = [run for run in self.runs if run.group in groups]
        for section in self.sections:
            for kind in "figure", "table":
                section[kind] = [shown for shown in section.get(kind, [])
                                 if set(groups) & set(shown.get("groups", groups))]
        self.sections = [section for section in self.sections
                         if section["figure"] or section["table"]]


def content_of(path):
    """A parameter file's text, with that of the files it includes or names.
    @throw IncludeError, OSError"""
    lines = []
    for line, file in lines_of(path):
        lines.append(line)
        named = re.match(r"\s*set\s+File\s*=\s*(\S+)", line)
        if named and os.path.isfile(file.parent / named[1]):
            with open(file.parent / named[1], "rb") as data:
                lines.append(hashlib.file_digest(data, "sha256").hexdigest())
    return "\n".join(lines)


def axis_choices(name, axis):
    """The choices of an axis: (value or label, settings) of each."""
    if isinstance(axis, list):
        return [(text_of(value) if isinstance(value, bool) else value,
                 [f"{name} = {text_of(value)}"]) for value in axis]
    if TEMPLATE.holds(axis):
        return [(value, [text.replace("{}", str(value)) for text in axis["set"]])
                for value in axis["values"]]
    return list(axis.items())


def resolve(path, where, text, axes):
    """A setting whose {axis} or {axis/2} are the values of other axes."""
    def value(found):
        name, divisor = found.groups()
        good = isinstance(axes.get(name), (int, float)) and re.fullmatch(
            r"(/(\d+\.?\d*|\.\d+))?", divisor or "") and float((divisor or "/1")[1:]) > 0.
        require(good, path, f"{where}: {shown(found[0])} in the setting {shown(text)}",
                "{} of an axis with values, or {axis}, {axis/2} of another one")
        return (f"{axes[name] / float(divisor[1:]):.12g}" if divisor else str(axes[name]))
    return re.sub(r"\{(\w+)(/[0-9.]+)?\}", value, text) if "{" in text else text


def check_check(path, where, check, axes):
    """Refuses a check that cannot be made."""
    check_table(path, where, check, CHECK,
                () if {"status", "published"} & check.keys() else ("value",))
    tables = [check[key] for key in ("reference", "published") if isinstance(check.get(key), dict)]
    by_axis = bool(tables)
    if by_axis or "by" in check:
        require(by_axis and check.get("by") in axes, path,
                f"{where}: by = {shown(check.get('by', ''))}",
                "with references of a table, the name of the group's axis")
        known = [str(value) for value, _ in axes[check["by"]]]
        for key in itertools.chain(*tables):
            require(key in known, path, f"{where}: {shown(key)} is no value of the axis "
                    f"{shown(check['by'])}", ", ".join(known))
    require(check.get("low", -math.inf) <= check.get("high", math.inf), path,
            f"{where}: low = {check.get('low')}, high = {check.get('high')}", "low <= high")


def parameter_file(path, where, name):
    """The path of a group's parameter file, which can be read with all that it includes."""
    file = path.parent / name
    require(os.path.isfile(file), path, f"{where}: file = {shown(name)}",
            "an existing parameter file, relative to the study file")
    try:
        content_of(file)
    except (IncludeError, OSError) as problem:
        refuse(path, f"{where}: file = {shown(name)}: {problem}", "a parameter file whose "
               "included files can be read")
    return file.resolve()


def group_runs(path, group, defaults, most):
    """All runs of a group: the product of its axes, each as often as repeated.
    @param most there may be"""
    where = f"the group {shown(group.get('name', ''))}"
    check_table(path, where, group, GROUP, ("name",))
    vary = {**defaults.get("vary", {}), **group.get("vary", {})}
    settings = [*defaults.get("set", []), *group.get("set", [])]
    group = {**defaults, **group}
    check_table(path, where, group, GROUP, ("file",))
    for name in vary:
        require(name and LINE.holds(name) and name != "repetition", path,
                f"{where}: vary: the axis {shown(name)}", "a name of one line, not 'repetition'")
    check_table(path, f"{where}: vary", vary, dict.fromkeys(vary, AXIS))
    file = parameter_file(path, where, group["file"])
    axes = {name: axis_choices(name, axis) for name, axis in vary.items()}
    repeat = group.get("repeat", 1)
    count = math.prod(map(len, axes.values())) * repeat
    require(count <= most, path, f"{where}: {count} runs, by 'vary' and 'repeat' = {repeat}",
            f"up to {MOST_RUNS} runs of a study", "vary fewer values, or repeat less often")
    if repeat > 1:
        axes["repetition"] = [(i + 1, []) for i in range(repeat)]
    check = group.get("check", {})
    if check:
        check_check(path, f"{where}: check", check, axes)
    runs = []
    for chosen in itertools.product(*axes.values()):
        values = {name: value for name, (value, _) in zip(axes, chosen)}
        run = Run(group["name"], values, file,
                  [resolve(path, where, text, values) for text in
                   (*settings, *(text for _, more in chosen for text in more))],
                  group.get("ranks", 1), group.get("alone", False),
                  group.get("time_limit", 900.), check)
        # The record of a run is beside its folder, NAME.json.
        require(0 < len(run.name) <= 200 and not run.name.endswith((".json", ".part")), path,
                f"{where}: a run named {shown(run.name)}", "names (of the group and of the "
                "values of its axes) that give a folder's of up to 200 characters, without "
                "the ending .json or .part")
        runs.append(run)
    return runs


def read_table(path):
    """Content of a study file."""
    remedy = "check the name; studies/quick.toml is an example"
    require(os.path.isfile(path), path, "is no file", "a study file", remedy)
    require(NAME.holds(path.stem), path, f"its results would be named {shown(path.stem)}",
            NAME.allowed, "rename the file")
    try:
        require(path.stat().st_size <= LARGEST, path, "is too large",
                f"up to {LARGEST >> 20} MB", remedy)
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as problem:
        refuse(path, problem.strerror, "a file that you may read", remedy)
    except (ValueError, RecursionError) as problem:  # also if it is no text
        refuse(path, f"is no TOML file: {problem}", "TOML 1.0, UTF-8")


def read_study(path):
    """The study of a file."""
    path = Path(os.path.realpath(path))
    table = read_table(path)
    check_table(path, "the study", table, STUDY)
    require(table.get("group"), path, "there is no [[group]] of runs", "one or more",
            "add one, as in studies/quick.toml")
    defaults = table.get("defaults", {})
    check_table(path, "defaults", defaults, DEFAULTS)
    runs = []
    for group in table["group"]:
        runs += group_runs(path, group, defaults, MOST_RUNS - len(runs))
    seen = set()
    for run in runs:
        require(run.name not in seen, path, f"two runs are named '{run.name}'",
                "groups and values that differ in more than signs and capitals",
                "name the groups or labels differently")
        seen.add(run.name)
    groups = {run.group for run in runs}
    sections = table.get("section", [])
    for section in sections:
        where = f"the section {shown(section.get('title', ''))}"
        check_table(path, where, section, SECTION)
        for picture in (*section.get("figure", []), *section.get("table", [])):
            check_shown(path, where, picture)
            for name in picture.get("groups", []):
                require(name in groups, path, f"{where}: unknown group '{name}'",
                        ", ".join(sorted(groups)))
    return Study(path, table.get("title", path.stem), table.get("text", ""), runs,
                 sections)
