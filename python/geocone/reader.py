# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading the folders of runs: summary, tables, fields, parameters."""

import base64
import csv
import datetime
import functools
import json
import os
import re
import socket
import xml.etree.ElementTree as ElementTree
import zlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geocone.modules import require
from geocone.parameter_file import IncludeError, parameters_of

if TYPE_CHECKING:
    import matplotlib.figure
    import meshio
    import pyvista



class Table(dict[str, np.ndarray]):
    """Columns, {"name (unit)": array of a value per line}. Those of a run in kN and kPa are
    also found by the names that they have in SI units; their values are in kN and kPa all
    the same."""

    def __missing__(self, name: str) -> np.ndarray:
        inside = unit_in(name)
        if inside is None or not dict.__contains__(self, inside):
            raise KeyError(name)
        return self[inside]

    def __contains__(self, name: object) -> bool:
        return dict.__contains__(self, name) or (
            isinstance(name, str) and dict.__contains__(self, unit_in(name)))

    def get(self, name: str, default: Any = None) -> Any:
        """The column, or the default."""
        return self[name] if name in self else default


def kilo(unit: str) -> str:
    """A unit of SI in the system of kN and kPa, "kN/m" of "N/m"."""
    return re.sub(r"^(Pa|N|J)(?!\w)", r"k\1", re.sub(r"^kg(?!\w)", "t", unit))


def mass_unit(parameters: Mapping[str, str]) -> float:
    """The unit of mass of a scene (kg)."""
    return 1e3 if parameters.get("Analysis/Units") == "kN-m" else 1.


def unit_in(name: str) -> str | None:
    """The name of a column of SI units in the system of kN and kPa, if it has a unit."""
    words, bracket, unit = name.rpartition(" (")
    return f"{words} ({kilo(unit)}" if bracket else None


# meshio's name of a cell, by the dimension of the scene and the number of corners.
CELL_TYPES = {2: {1: "vertex", 2: "line", 3: "triangle", 4: "quad"},
              3: {1: "vertex", 4: "tetra", 8: "hexahedron"}}


class Field(NamedTuple):
    """Fields of a series at one time."""

    points: np.ndarray  #: (n, dimension), coordinates (m)
    cells: np.ndarray  #: (m, corners), indices of points
    data: Table  #: {name: (n, components)}
    time: float | None = None  #: (s)


class ReadError(Exception):
    """Description of the damage of a folder or a file, in a line."""


class Missing(ReadError):
    """Missing data: the run has not, or not yet, written them."""


def reason(problem: Exception) -> str:
    """A problem in a line: its kind and what it says, without the data that caused it."""
    return f"{type(problem).__name__}: {problem}"


def read(folder: str | os.PathLike) -> "Run":
    """Reads the run of a folder, as far as it has come.

    Parameters
    ----------
    folder
        Path of the folder.

    Returns
    -------
    Run
        The run.

    Raises
    ------
    ReadError
        If the folder has no summary.json of a run.
    """
    return Run(folder)


class Run:
    """A run of geocone, by the files of its folder. The summary is read at once, all else
    when it is asked for.

    Attributes
    ----------
    folder : pathlib.Path
        Path of the folder.
    summary : dict
        Content of summary.json, as dictionaries.
    name : str
        Of the parameter file, or of a resumed run.
    status : str
        "finished", "running", or how it ended: "failed: WHY", "stopped: ...", "killed: ..."
        (doc/runs.md).
    warnings : list of str
        The warnings of the program.
    """

    def __init__(self, folder: str | os.PathLike):
        self.folder = Path(folder)
        file = self.folder / "summary.json"
        try:
            if file.exists() and not file.is_file():
                raise ValueError("it is no file")
            self.summary = json.loads(file.read_text())
            self.name, self.status = self.summary["name"], status_of(self.summary)
            self.warnings = list(self.summary.get("warnings", []))
        except (OSError, ValueError, LookupError, TypeError, AttributeError,
                RecursionError) as problem:
            raise ReadError(f"'{folder}' has no summary.json of a run: {reason(problem)}")
        # The pictures of a run ask for the same states again and again.
        self.states = functools.lru_cache(maxsize=2)(self._states)
        # Those of obstacles are small, and must not drive out the others.
        self.obstacles = functools.lru_cache(maxsize=64)(self._obstacles)

    def __repr__(self) -> str:
        return f"<geocone run '{self.folder}': {self.status}>"

    def _repr_html_(self) -> str:
        """A table of the run, with its main picture, for notebooks."""
        from geocone.html import html_of
        return html_of(self)

    def value(self, key: str) -> Any:
        """A value of the summary by its path, as in "limit_load/value"; or None."""
        return leaves(self.summary).get(key)

    def per_metre(self, unit: str) -> str:
        """A unit of forces or energies: per metre of thickness, or, of an axisymmetric
        problem and in three dimensions, of all of it; e.g. "N/m" or "N" for "N"."""
        try:
            known = self.statistics
        except Missing:
            known = ()
        whole = "load (N)" in known or "kinetic energy (J)" in known
        return self.unit(unit if whole else f"{unit}/m")

    @property
    def mass_unit(self) -> float:
        """Unit of mass in kg, 1000 where the units of the run are kN-m."""
        return mass_unit(self.parameters)

    def unit(self, of_si: str) -> str:
        """The unit that the run has for one of SI, "kPa" for "Pa" where its units
        are kN-m."""
        return of_si if self.mass_unit == 1. else kilo(of_si)

    def table(self, name: str) -> Table:
        """Reads a table of the folder.

        Parameters
        ----------
        name
            As in NAME.csv.

        Returns
        -------
        dict
            The columns, {"name (unit)": array of a value per line}.

        Raises
        ------
        Missing
            If there are no lines.
        ReadError
            If there are damaged ones.
        """
        return read_table(self.folder / f"{name}.csv")

    @functools.cached_property
    def statistics(self) -> Table:
        """Columns of the steps, as table() returns them."""
        return self.table("statistics")

    @functools.cached_property
    def newton(self) -> Table:
        """Columns of the iterations of Newton's method."""
        return self.table("newton")

    @functools.cached_property
    def path(self) -> Table:
        """Columns of the steps of an element test."""
        return self.table("path")

    @functools.cached_property
    def surfaces(self) -> Table:
        """Columns of the yield surfaces of an element test."""
        return self.table("surfaces")

    @functools.cached_property
    def parameters(self) -> dict[str, str]:
        """Parameters as used by the run, by "Section/Name", as texts."""
        file = self.folder / "parameters.prm"
        if not file.is_file():
            raise Missing(f"there is no file '{file}'")
        try:
            return parameters_of(file)
        except (IncludeError, OSError) as problem:
            raise ReadError(f"'{file}' cannot be read: {problem}")

    @property
    def method(self) -> str | None:
        """FEM, MPM, explicit MPM, point, limit load or strength reduction; None if unknown."""
        method = self.value("size/method")  # a run that goes on may not have it yet
        file = self.folder / "parameters.prm"
        return (self.parameters.get("Discretisation/Method")
                if method is None and file.is_file() else method)

    def times(self, series: str = "points") -> np.ndarray:
        """Times at which fields were written (s), (n,)."""
        return np.array([time for time, _ in read_series(self._record(series))])

    def fields(self, series: str = "points", time: float | None = None) -> "meshio.Mesh":
        """Reads the fields of a series at one time.

        Parameters
        ----------
        series
            "points" (material points) or "cells" (the mesh; each cell has points of its own,
            whose values are the cell's where they jump).
        time
            The nearest one that was written is taken (s). None: the last one.

        Returns
        -------
        meshio.Mesh
            points (n, dimension) in m, point_data {name: (n,) or (n, 3)}, info {"time": s}.

        Raises
        ------
        Missing
            If there are none.
        ReadError
            If they are damaged.
        MissingModule
            If meshio, or h5py for files of HDF5, is not installed.
        """
        meshio = require("meshio")  # takes as long as all other imports together
        i = -1 if time is None else nearest(self.times(series), [time])[0]
        state, = self._states(series, (int(i),))
        kind = CELL_TYPES[state.points.shape[1]].get(state.cells.shape[1])
        if kind is None:
            raise ReadError(f"the cells of '{self._record(series)}' are neither points "
                            "nor of a kind that geocone has")
        return meshio.Mesh(
            state.points, [(kind, state.cells)], info={"time": state.time},
            point_data={name: values[:, 0] if values.shape[1] == 1 else values
                        for name, values in state.data.items()})

    def pyvista(self, series: str = "points",
                time: float | None = None) -> "pyvista.UnstructuredGrid":
        """Reads the fields of a series at one time, as fields() does, as a mesh of pyvista.

        Raises
        ------
        MissingModule
            If pyvista is not installed.
        """
        return require("pyvista").from_meshio(self.fields(series, time))

    def figure(self, name: str) -> "matplotlib.figure.Figure":
        """Draws a picture of the run as a figure, which can be changed and saved.

        Parameters
        ----------
        name
            Of a picture that ``python3 -m geocone plot`` draws, e.g. "load_displacement".

        Returns
        -------
        matplotlib.figure.Figure
            The figure. No file is written.

        Raises
        ------
        ValueError
            If runs of this method have no picture of this name.
        Missing
            If the run has no data for it.
        MissingModule
            If matplotlib is not installed.
        """
        require("matplotlib")
        from geocone.plots import model, pictures_of
        from geocone.style import Skipped, kept
        pictures = {"model.png": model.draw_run, **pictures_of(self)}
        file = name.removesuffix(".png") + ".png"
        if file not in pictures:
            raise ValueError(f"there is no picture '{name}'; allowed: " + ", ".join(
                picture.removesuffix(".png") for picture in pictures))
        try:
            with kept() as figures:
                pictures[file](self, self.folder / file)
        except Skipped as reason:
            raise Missing(str(reason)) from reason
        return figures[0]

    def _record(self, series: str) -> Path:
        """The record of a series: of VTU files, or else of HDF5 files."""
        record = self.folder / f"{series}.pvd"
        other = record.with_suffix(".vtkhdf")
        return other if other.is_file() and not record.is_file() else record

    def _states(self, series: str, indices: Sequence[int] = (-1,)) -> list[Field]:
        """The states of a series, of all pieces, by their places."""
        return read_states(self._record(series), indices)

    def _obstacles(self, time: float | None = None) -> Field:
        """The obstacles at the time nearest to one (s), or at the end."""
        place = -1 if time is None else nearest(self.times("obstacles"), [time])[0]
        return self._states("obstacles", (int(place),))[0]


def is_silent(run: Mapping[str, Any]) -> bool:
    """Whether a run that has not ended, by this topic of its summary, gives no sign of life:
    its process is gone, or its last sign is older than ten minutes."""
    pid, sign = run.get("pid"), run.get("last_sign_of_life")
    if run.get("host") == socket.gethostname() and isinstance(pid, int) and pid > 0:
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        except (OSError, OverflowError):  # another user's, or none
            pass
    if isinstance(sign, str):
        sign = datetime.datetime.fromisoformat(sign.replace("Z", "+00:00")).timestamp()
    return (isinstance(sign, (int, float)) and
            datetime.datetime.now().timestamp() - sign > 600.)


def status_of(summary: Mapping[str, Any]) -> str:
    """The status of a summary, in a line. One that says "running" of a process that is
    gone was killed."""
    status = " ".join(summary["status"].split())
    if status == "running" and is_silent(summary.get("run", {})):
        status = "killed: it has given no sign of life"
    return status


def leaves(tree: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """The values of a summary by their paths, {"topic/name": value}."""
    found = {}
    for key, value in tree.items():
        if isinstance(value, dict):
            found.update(leaves(value, f"{prefix}{key}/"))
        else:
            found[prefix + key] = value
    return found


def read_table(path: Path) -> Table:
    """Reads a CSV file as Run.table() has it; an unfinished line is left out."""
    if not path.is_file():
        raise Missing(f"there is no file '{path}'")
    try:
        with open(path, newline="", encoding="utf-8") as file:
            header, *lines = list(csv.reader(file)) or [[]]
        rows = [line for line in lines if len(line) == len(header)]
        table = np.array(rows, dtype=float)
    except (OSError, ValueError, csv.Error) as problem:
        raise ReadError(f"the table '{path}' cannot be read: {problem}")
    if not rows:
        raise Missing(f"'{path}' has no lines")
    return Table(zip(header, table.T))


def decode(array: ElementTree.Element) -> np.ndarray:
    """The numbers of a VTK DataArray, ascii or zlib's blocks in base64, (n,)."""
    dtype = np.dtype(array.get("type").lower()).newbyteorder("<")
    if array.get("format") == "ascii":
        return np.array((array.text or "").split(), dtype)
    text = "".join(array.text.split())
    # The header: number of blocks, their size, the last one's, compressed sizes.
    n_blocks = int(np.frombuffer(base64.b64decode(text[:8]), "<u4", 1)[0])
    n_chars = -(-(3 + n_blocks) * 4 // 3) * 4
    sizes = np.frombuffer(base64.b64decode(text[:n_chars]), "<u4")[3:].tolist()
    packed, ends = base64.b64decode(text[n_chars:]), np.cumsum(sizes)
    return np.frombuffer(b"".join(zlib.decompress(packed[end - size:end])
                                  for end, size in zip(ends, sizes)), dtype)


def beside(record: Path, name: str) -> Path:
    """The path of a file that a record names: only those in its own folder are read."""
    if name in ("", ".", "..") or name != os.path.basename(name):
        raise ValueError(f"it names '{name}', which is not in its folder")
    return record.parent / name


def read_vtu(path: Path) -> list[Field]:
    """The pieces of a .vtu file, or of all files of a .pvtu record, as Fields."""
    if not path.is_file():  # a device would be read without end
        raise FileNotFoundError(None, "no file", str(path))
    root = ElementTree.parse(path).getroot()
    if path.suffix == ".pvtu":
        return [field for piece in root.iter("Piece")
                for field in read_vtu(beside(path, piece.get("Source")))]
    fields = []
    for piece in root.iter("Piece"):
        if int(piece.get("NumberOfPoints")) == 0:  # a rank without cells
            continue
        points = decode(piece.find("Points/DataArray")).reshape(-1, 3)
        cells = {array.get("Name"): decode(array) for array in piece.find("Cells")}
        fields.append(Field(
            points.astype(float),
            cells["connectivity"].reshape(len(cells["offsets"]), -1),
            {array.get("Name"): decode(array).reshape(len(points), -1)
             for array in piece.find("PointData")}))
    return fields


def joined(pieces: Sequence[Field], time: float) -> Field:
    """The pieces of a state as one."""
    first = np.cumsum([0] + [len(piece.points) for piece in pieces])
    points = np.concatenate([piece.points for piece in pieces])
    return Field(
        points if np.any(points[:, 2]) else points[:, :2],  # of a scene in the plane
        np.concatenate([piece.cells + n for piece, n in zip(pieces, first)]),
        {name: np.concatenate([piece.data[name] for piece in pieces])
         for name in pieces[0].data}, time)


def read_hdf5(path: Path) -> list[Field]:
    """The state of a .h5 file, as a list of one Field."""
    h5py = require("h5py")  # takes a while, and most runs have none
    if not path.is_file():
        raise FileNotFoundError(None, "no file", str(path))
    with h5py.File(path, "r") as file:
        for name, array in file.items():
            if (array.is_virtual or array.external or
                    array.id.get_storage_size() < array.nbytes):
                raise ValueError(f"'{name}' is not in the file")
        arrays = {name: array[()] for name, array in file.items()}
    points, cells = arrays.pop("nodes"), arrays.pop("cells")
    points = np.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    return [Field(points, cells.astype(int), {
        name: values.reshape(len(points), -1) for name, values in arrays.items()})]


def damage_of_fields(reads: Callable) -> Callable:
    """A reader of a series, whose errors are one kind that names the file."""
    @functools.wraps(reads)
    def reads_or_reports(path, *arguments):
        if not path.is_file():
            raise Missing(f"there is no file '{path}'")
        try:
            return reads(path, *arguments)
        except (ElementTree.ParseError, zlib.error, LookupError, TypeError, ValueError,
                AttributeError, OSError, RuntimeError) as problem:  # some are HDF5's
            raise ReadError(f"the fields of '{path}' cannot be read: {reason(problem)}")
    return reads_or_reports


@damage_of_fields
def read_series(path: Path) -> list[tuple[float, Path]]:
    """The times (s) of a .pvd or .vtkhdf series and their files, [(time, path)]."""
    if path.suffix == ".vtkhdf":
        h5py = require("h5py")
        with h5py.File(path, "r") as file:
            times = file["VTKHDF/Steps/Values"][()].tolist()
            files = [part.file_name for part in file["VTKHDF/Points"].virtual_sources()]
        if len(times) != len(files):
            raise ValueError(f"{len(times)} times of {len(files)} files")
        return [(time, beside(path, name)) for time, name in zip(times, files)]
    return [(float(entry.get("timestep")), beside(path, entry.get("file")))
            for entry in ElementTree.parse(path).getroot().iterfind(".//DataSet")]


@damage_of_fields
def read_states(path: Path, indices: Sequence[int] = (-1,)) -> list[Field]:
    """The states of a series at some places, the last one by itself: Fields."""
    series = read_series(path)
    read_file = read_hdf5 if path.suffix == ".vtkhdf" else read_vtu
    return [joined(read_file(file), time)
            for time, file in (series[i] for i in indices)]


def nearest(times: np.ndarray, wanted: Sequence[float]) -> np.ndarray:
    """The indices of the times that are nearest to the wanted ones, each once."""
    return np.unique([np.argmin(np.abs(times - t)) for t in wanted])
