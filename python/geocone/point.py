# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Element tests in the process of Python, fast enough for the fit of a law to a test."""

import functools
import importlib.util
import os
import sysconfig
import warnings
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from geocone.modules import MissingModule
from geocone.parameter_file import lines_of, setting, settings_in, text_of
from geocone.program import find_program

COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")
SECTIONS = ("Materials/", "Element/", "Path/", "Analysis/Units")


class MaterialPoint:
    """One material point of any law, driven by strains and stresses in this process::

        point = geocone.MaterialPoint("prm/element/undrained_triaxial.prm",
                                      {"Materials/clay/Structure loss rate cb": 5})
        table = point.run()                       # the section Path, as path.csv has it
        table["q (Pa)"].max()
        point.restart()                           # to the initial state
        point.follow(strain={"yy": -0.05}, stress={"xx": -60e3, "zz": -60e3}, increments=100)

    Tension is positive; strains add up from the initial state; shear components are those of
    the tensor. Of the parameters those of ``Materials`` (the first one), ``Element``, ``Path`` and
    ``Analysis/Units`` are used. It gives the numbers of the method ``point`` of the program,
    without files.

    Parameters
    ----------
    scene
        Path of a parameter file, a Scene, or {"Section/Name": value}.
    parameters
        Changes, {"Section/Name": value}.
    program
        Of ``find_program``; the compiled module is looked for beside it.

    Raises
    ------
    ValueError
        If a parameter is refused; with its name, what is allowed, and a remedy.
    MissingModule
        If the compiled module was not built.

    Warns
    -----
    UserWarning
        If the law had to change values at the start.
    """

    def __init__(self, scene: str | os.PathLike | Mapping[str, Any],
                 parameters: Mapping[str, Any] | None = None, *,
                 program: str | os.PathLike = "geocone"):
        given = dict(parameters or {})
        if not isinstance(scene, Mapping):
            settings = settings_in(line for line, _ in lines_of(Path(scene)))
        elif hasattr(scene, "settings"):
            settings = scene.settings()
        else:
            settings, given = {}, {**scene, **given}
        for path in given:
            if not path.startswith(SECTIONS):
                raise ValueError(f"'{path}' is no parameter of a material point\n"
                                 f"  allowed: those of {', '.join(SECTIONS)}")
        settings = {**settings, **{path: text_of(value) for path, value in given.items()}}
        self._point = point_module(program).Point(
            [setting(path, text) for path, text in settings.items()
             if path.startswith(SECTIONS)])
        #: Names of the values of a state with their units, those of path.csv.
        self.columns: list[str] = self._point.columns
        if self._point.changed:
            warnings.warn(self._point.changed, stacklevel=2)

    def __repr__(self) -> str:
        return f"<geocone material point at {self.stress} Pa>"

    @property
    def stress(self) -> np.ndarray:
        """The present stress xx, yy, zz, xy, yz, zx (Pa)."""
        return np.array(self._point.stress())

    @property
    def strain(self) -> np.ndarray:
        """The strain xx, yy, zz, xy, yz, zx since the initial state (-)."""
        return np.array(self._point.strain())

    @property
    def state(self) -> dict[str, float]:
        """Values of the present state by the names in ``columns``."""
        return dict(zip(self.columns, self._point.line(0)))

    def restart(self) -> None:
        """Returns to the initial state."""
        self._point.restart()

    def follow(self, strain: Mapping[str, Any] | None = None,
               stress: Mapping[str, Any] | None = None,
               increments: int | None = None) -> dict[str, np.ndarray]:
        """Drives the point from its present state.

        Parameters
        ----------
        strain
            Strains by component, {"yy": values} (-), counted from the initial state: an array
            has the value at the end of each increment, a number is reached linearly. A
            component with neither strain nor stress keeps its strain.
        stress
            Stresses by component, alike (Pa).
        increments
            Number of increments if all values are numbers; default 1.

        Returns
        -------
        dict
            A table, {"name (unit)": array} by the names in ``columns``, a row for each increment.

        Raises
        ------
        ValueError
            If a component is unknown or given twice, or lengths differ.
        RuntimeError
            If the material cannot carry a stress, or stresses do not determine the strains.
            The point then is where it came to.
        """
        strain, stress = dict(strain or {}), dict(stress or {})
        for name in [*strain, *stress]:
            if name not in COMPONENTS or not self._point.has(COMPONENTS.index(name)):
                known = [c for i, c in enumerate(COMPONENTS) if self._point.has(i)]
                raise ValueError(f"unknown component '{name}'\n  allowed: {', '.join(known)}")
            if name in strain and name in stress:
                raise ValueError(f"component '{name}' has a strain and a stress\n"
                                 "  remedy:  take one of them out")
        values = {name: np.asarray(value, float) for name, value in (strain | stress).items()}
        lengths = {value.shape for value in values.values() if value.ndim}
        if increments is not None:
            lengths.add((increments,))
        if len(lengths) > 1 or any(len(shape) > 1 for shape in lengths):
            raise ValueError(f"arrays of the shapes {sorted(lengths)}\n  allowed: arrays of one "
                             "length, which is that of 'increments' if that is given")
        (n,) = lengths.pop() if lengths else (1,)
        part = np.arange(1, n + 1) / max(n, 1)
        rows = np.tile(self._point.strain(), (n, 1))
        present = self._point.stress()
        for name, value in values.items():
            i = COMPONENTS.index(name)
            start = present[i] if name in stress else rows[0, i] if n else 0.
            rows[:, i] = value if value.ndim else start + part * (value - start)
        return self._table(self._point.follow([c in stress for c in COMPONENTS], rows))

    def run(self) -> dict[str, np.ndarray]:
        """Follows the stages of the section ``Path`` from the initial state.

        Returns
        -------
        dict
            A table, {"name (unit)": array}: that of ``Run.path``, with a row for the start.

        Raises
        ------
        RuntimeError
            If a stage cannot be followed.
        """
        return self._table(self._point.run())

    def _table(self, lines: np.ndarray) -> dict[str, np.ndarray]:
        return {name: lines[:, i] for i, name in enumerate(self.columns)}


@functools.cache
def point_module(program: str | os.PathLike) -> ModuleType:
    """Loads the compiled module, which stands beside the program or in lib/geocone.

    Raises
    ------
    MissingModule
        If it is not there, or was built for another interpreter; with a remedy.
    """
    program = find_program(program)
    file = "geocone_point" + sysconfig.get_config_var("EXT_SUFFIX")
    places = [program.parent, program.parents[1] / "lib" / "geocone"]
    for place in places:
        if (place / file).is_file():
            spec = importlib.util.spec_from_file_location("geocone_point", place / file)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            return module
    others = [path.name for place in places for path in place.glob("geocone_point*.so")]
    raise MissingModule(
        f"there is no {file} in {' or '.join(map(str, places))}"
        + (f", but {', '.join(others)} of another interpreter" if others else "")
        + "\n  remedy:  apt-get install pybind11-dev, configure by 'cmake build/release', build by "
          "scripts/build, and call /usr/bin/python3", name="geocone_point")
