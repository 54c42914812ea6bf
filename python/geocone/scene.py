# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes: parameter files as mappings that can be changed, written and run."""

import difflib
import functools
import os
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from geocone.files import write_whole
from geocone.parameter_file import (file_text, lines_of, parameters_of, setting, settings_in,
                                    text_of)
from geocone.program import environment, find_program

# Parameters by whose values the others are declared.
SHAPES = ("Names", "Stages", "Type", "Dimension", "Units")


class UnknownParameter(KeyError):
    """A name that no parameter or section of a scene has."""

    def __str__(self) -> str:  # as it is: that of KeyError has quotes around it
        return self.args[0]


class Section(Mapping):
    """A section of a scene: its parameters by their names below it, as texts.

    ``section["Friction angle"]`` is the text that is set, or else the program's default;
    ``section["clay"]`` is the section below. Iteration goes over the parameters that are set.
    """

    def __init__(self, scene: "Scene", prefix: str):
        self._scene, self._prefix = scene, prefix

    def _settings(self) -> dict[str, str]:
        """Settings of the section, {"Name" or "Section/Name": text}."""
        return {path.removeprefix(self._prefix): text
                for path, text in self._scene.settings().items()
                if path.startswith(self._prefix)}

    def __getitem__(self, name: str) -> Any:
        path = self._prefix + name
        settings = self._scene.settings()
        if path in settings:
            return settings[path]
        if not is_section(path, settings):
            known = self._scene._declared(settings)
            if path in known:
                return known[path]
            if not is_section(path, known):
                raise unknown(path, {**known, **settings})
        return Section(self._scene, path + "/")

    def __setitem__(self, name: str, value: Any) -> None:
        if isinstance(value, Mapping):
            for below, part in value.items():
                self[f"{name}/{below}"] = part
        else:
            self._scene.change(self._prefix + name, value)

    def update(self, values: Mapping[str, Any]) -> None:
        """Sets parameters of the section, {"Name": value}."""
        for name, value in values.items():
            self[name] = value

    def __iter__(self) -> Iterator[str]:
        return iter(self._settings())

    def __len__(self) -> int:
        return len(self._settings())

    def __contains__(self, name: object) -> bool:
        return name in self._settings()

    def __repr__(self) -> str:
        return f"<{self._prefix[:-1]} of {self._scene!r}>"


class Scene(Section):
    """A parameter file, with the files that it includes, as a mapping::

        scene = geocone.Scene("prm/footing_fem.prm")
        scene["Materials"]["soil"]["Cohesion"] = 12e3       # or in one, "Materials/soil/Cohesion"
        scene["Geometry/Box"] = [[-1, -2], [1, 0]]
        run = scene.run()
        scene.write("mine.prm")

    Values are set as numbers, texts, truth values and lists, and read as texts of the file.
    A name that the program does not declare for the materials, conditions and stages of the
    scene is refused, as far as there is a program to ask.

    Parameters
    ----------
    file
        Path of a parameter file, which is not changed.
    parameters
        First changes, {"Section/Name": value}.
    program
        Of `find_program`; asked for names and defaults, and run.

    Attributes
    ----------
    file : pathlib.Path
        Path of the parameter file.
    changes : dict
        The parameters that are set here, {"Section/Name": text}.

    Raises
    ------
    ValueError, OSError
        If a file cannot be read.
    """

    def __init__(self, file: str | os.PathLike, parameters: Mapping[str, Any] | None = None, *,
                 program: str | os.PathLike = "geocone"):
        super().__init__(self, "")
        self.file, self.program = Path(file), program
        self._of_file = settings_in(line for line, _ in lines_of(self.file))
        self.changes: dict[str, str] = {}
        self.update(parameters or {})

    def __repr__(self) -> str:
        return f"<geocone scene '{self.file}', {len(self.changes)} changes>"

    def settings(self) -> dict[str, str]:
        """All that is set, by the file or here, {"Section/Name": text}."""
        return {**self._of_file, **self.changes}

    def change(self, path: str, value: Any) -> None:
        """Sets a parameter, as ``scene[path] = value`` does.

        Raises
        ------
        UnknownParameter
            If the program has no such parameter; with the one that may be meant.
        ValueError
            If no parameter file can have the value.
        """
        text = text_of(value).strip()
        if not text.isprintable() or "#" in text or text.endswith("\\"):
            raise ValueError(f"'{path}' = {text!r} cannot stand in a parameter file\n"
                             "  allowed: a line without #, and no \\ at its end")
        settings = {**self.settings(), path: text}
        known = self._declared(settings)
        if known and path not in known and path not in self._of_file:
            raise unknown(path, known)
        self.changes[path] = text

    def _declared(self, settings: Mapping[str, str]) -> dict[str, str]:
        """Defaults of all parameters that the program declares where these are set; empty
        without a program."""
        shape = tuple(item for item in settings.items()
                      if item[0].rpartition("/")[2] in SHAPES)
        try:
            return declared(shape, find_program(self.program))
        except OSError:
            return {}

    def write(self, path: str | os.PathLike) -> Path:
        """Writes the scene as one parameter file, without includes and comments.

        Parameters
        ----------
        path
            Of the file, which is replaced if it is there. Files that the scene names
            relative to its own folder are named relative to that of the new file.

        Returns
        -------
        pathlib.Path
            The path.
        """
        path = Path(path)
        values = {name: self._moved(name, text, path.parent)
                  for name, text in self.settings().items()}
        write_whole(path, f"# {self.file.name}, as geocone.Scene has written it\n"
                    + file_text(values))
        return path

    def _moved(self, name: str, text: str, folder: Path) -> str:
        """A value that may name a file, in a parameter file of another folder."""
        word = "record " if text.startswith("record ") else ""
        place = self.file.parent / text.removeprefix(word).strip()
        if not text or not (word or name.endswith("/File")) or not place.is_file():
            return text
        return word + os.path.relpath(place.resolve(), folder.resolve())

    def run(self, parameters: Mapping[str, Any] | None = None, **options: Any):
        """Runs the scene, as `geocone.run` does with the same options."""
        from geocone.runner import run  # which takes scenes
        return run(self, parameters, **{"program": self.program, **options})

    def run_many(self, variants: Mapping, **options: Any):
        """Runs variants of the scene, as `geocone.run_many` does with the same options."""
        from geocone.side_by_side import run_many
        return run_many(self, variants, **{"program": self.program, **options})


def is_section(path: str, settings: Mapping[str, str]) -> bool:
    """Whether settings are below a path."""
    return any(other.startswith(path + "/") for other in settings)


@functools.lru_cache(maxsize=64)
def declared(shape: tuple[tuple[str, str], ...], program: Path) -> dict[str, str]:
    """Asks a program for the parameters that it declares.

    Parameters
    ----------
    shape
        Settings by which the others are declared, (("Section/Name", text), ...).
    program
        Path of the program.

    Returns
    -------
    dict
        The defaults, {"Section/Name": text}.

    Raises
    ------
    ValueError
        If the program refuses the settings; with its words.
    OSError
        If the program cannot be called.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "defaults.prm"
        words = [word for item in shape for word in ("--set", setting(*item))]
        ended = subprocess.run(
            [program, "--defaults", file, *words], check=False, text=True, errors="replace",
            capture_output=True, env=environment(), stdin=subprocess.DEVNULL)
        if ended.returncode != 0:
            raise ValueError(ended.stderr.strip().removeprefix("error: ")
                             or f"'{program} --defaults' has failed")
        return parameters_of(file)


def unknown(path: str, known: Mapping[str, str]) -> UnknownParameter:
    """The error of an unknown name: with the known one of the same last word in another
    section, or the most similar one."""
    last = path.rpartition("/")[2]
    elsewhere = [other for other in known if other.endswith("/" + last)]
    sections = {other[:i] for other in known for i, c in enumerate(other) if c == "/"}
    similar = difflib.get_close_matches(path, [*known, *sections], 1, 0.7)
    meant = elsewhere if len(elsewhere) == 1 else similar
    remedies = [f"did you mean '{meant[0]}'?" if meant else
                "'geocone --help' lists all parameters"]
    remedies += [f"a new name is first added to '{path.partition('/')[0]}/{names}'"
                 for names in ("Names", "Stages")
                 if "/" in path and path.partition("/")[0] + "/" + names in known]
    return UnknownParameter(f"unknown parameter '{path}'\n  remedy:  " + "; ".join(remedies))
