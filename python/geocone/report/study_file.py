# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads study files: which runs there are, and what is shown of them."""

import dataclasses
import hashlib
import itertools
import re
import tomllib
from pathlib import Path

from geocone.parameter_file import lines_of


class StudyError(Exception):
    """Wrong input, with the remedy."""


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
        return re.sub(r"[^a-z0-9.]+", "_", "-".join(words).lower()).strip("_")

    def options(self):
        """The options of the call that the study asks for."""
        return [word for setting in self.settings for word in ("--set", setting)]

    def inputs(self):
        """What the result depends on but the program, as one text."""
        return "\n".join([text_of(self.file), *self.settings, str(self.ranks)])


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
                    ", ".join(sorted(known)))
        self.runs = [run for run in self.runs if run.group in groups]
        for section in self.sections:
            for kind in "figure", "table":
                section[kind] = [shown for shown in section.get(kind, [])
                                 if set(groups) & set(shown.get("groups", groups))]
        self.sections = [section for section in self.sections
                         if section["figure"] or section["table"]]


def text_of(path):
    """A parameter file's text, with that of the files it includes or names."""
    lines = []
    for line, file in lines_of(path):
        lines.append(line)
        named = re.match(r"\s*set\s+File\s*=\s*(\S+)", line)
        if named and (file.parent / named[1]).is_file():
            data = (file.parent / named[1]).read_bytes()
            lines.append(hashlib.sha256(data).hexdigest())
    return "\n".join(lines)


def require(good, path, what, allowed):
    """Raises StudyError unless good."""
    if not good:
        raise StudyError(f"{path}: {what}\n  allowed: {allowed}")


def known_keys(path, where, table, *allowed):
    """Refuses misspelt keys."""
    for key in table:
        require(key in allowed, path, f"unknown key '{key}' in {where}",
                ", ".join(allowed))


def settings_of(path, where, value):
    """A list of 'PARAMETER = VALUE'."""
    good = isinstance(value, list) and all(
        isinstance(text, str) and "=" in text for text in value)
    require(good, path, f"{where} = {value!r}", "a list of 'PARAMETER = VALUE'")
    return value


def axis_choices(path, name, axis):
    """The choices of an axis: (value or label, settings) of each."""
    where = f"the axis '{name}'"
    if isinstance(axis, list):
        require(axis, path, f"{where} is empty", "one value or more")
        return [(value, [f"{name} = {value}"]) for value in axis]
    require(isinstance(axis, dict) and axis, path, f"{where} = {axis!r}",
            "a list of the values of a parameter; {values = [...], set = [...]}, in "
            "whose settings {} is the value; or a list of settings for each label")
    if set(axis) == {"values", "set"}:
        templates = settings_of(path, where, axis["set"])
        require(all("{" in text for text in templates) or not templates, path,
                f"{where}: set = {templates!r}", "settings with {} for the value")
        return [(value, [text.replace("{}", str(value)) for text in templates])
                for value in axis["values"]]
    return [(label, settings_of(path, f"{where}, '{label}'", settings))
            for label, settings in axis.items()]


def resolve(path, text, axes):
    """A setting whose {axis} or {axis/2} are the values of other axes."""
    def value(found):
        name, divisor = found.groups()
        require(isinstance(axes.get(name), (int, float)), path,
                f"'{found[0]}' in the setting '{text}'",
                "{} of an axis with values, or {axis}, {axis/2} of another one")
        return f"{axes[name] / float(divisor):.12g}" if divisor else str(axes[name])
    return re.sub(r"\{(\w+)(?:/([0-9.]+))?\}", value, text)


def group_runs(path, group, defaults):
    """All runs of a group: the product of its axes, each as often as repeated."""
    known_keys(path, f"the group '{group.get('name')}'", group, "name", "file", "set",
               "vary", "ranks", "alone", "repeat", "time_limit", "check")
    group = {**defaults, **group,
             "set": [*defaults.get("set", []), *group.get("set", [])],
             "vary": {**defaults.get("vary", {}), **group.get("vary", {})}}
    require("name" in group, path, "a group without name", "a name for each group")
    where = f"the group '{group['name']}'"
    require("file" in group, path, f"{where} has no file",
            "file = a parameter file, relative to the study file")
    file = (path.parent / group["file"]).resolve()
    require(file.is_file(), path, f"{where}: file = '{group['file']}'",
            "an existing parameter file, relative to the study file")
    for key, least in (("ranks", 1), ("repeat", 1), ("time_limit", 1)):
        require(group.get(key, least) >= least, path,
                f"{where}: {key} = {group.get(key)}", f">= {least}")
    axes = {name: axis_choices(path, name, axis)
            for name, axis in group["vary"].items()}
    if group.get("repeat", 1) > 1:
        axes["repetition"] = [(i + 1, []) for i in range(group["repeat"])]
    common = settings_of(path, where, group["set"])
    runs = []
    for chosen in itertools.product(*axes.values()):
        values = {name: value for name, (value, _) in zip(axes, chosen)}
        settings = common + [text for _, settings in chosen for text in settings]
        runs.append(Run(group["name"], values, file,
                        [resolve(path, text, values) for text in settings],
                        group.get("ranks", 1), group.get("alone", False),
                        group.get("time_limit", 900.), group.get("check", {})))
    return runs


def read_study(path):
    """The study of a file."""
    path = Path(path).resolve()
    try:
        table = tomllib.loads(path.read_text())
    except OSError as problem:
        raise StudyError(f"{path}: {problem.strerror}")
    except ValueError as problem:  # also if it is no text
        raise StudyError(f"{path} is no TOML file: {problem}")
    known_keys(path, "the study", table, "title", "text", "defaults", "group", "section")
    defaults = table.get("defaults", {})
    known_keys(path, "defaults", defaults, "file", "set", "vary", "ranks", "alone",
               "repeat", "time_limit")
    require(table.get("group"), path, "there is no [[group]] of runs", "one or more")
    runs = [run for group in table["group"]
            for run in group_runs(path, group, defaults)]
    seen = set()
    for run in runs:
        require(run.name not in seen, path, f"two runs are named '{run.name}'",
                "groups and values that differ")
        seen.add(run.name)
    groups = {run.group for run in runs}
    sections = table.get("section", [])
    for section in sections:
        known_keys(path, "a section", section, "title", "text", "figure", "table")
        for shown in (*section.get("figure", []), *section.get("table", [])):
            where = f"the section '{section.get('title')}'"
            require("kind" in shown, path, f"{where} shows something without kind",
                    "kind = MODULE.FUNCTION of python/geocone/report")
            for name in shown.get("groups", []):
                require(name in groups, path, f"{where}: unknown group '{name}'",
                        ", ".join(sorted(groups)))
    return Study(path, table.get("title", path.stem), table.get("text", ""), runs,
                 sections)
