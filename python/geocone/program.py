# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Places of the programs and of the examples that come with them."""

import contextlib
import os
import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]  # of the source, or share/geocone


def find_program(name: str | os.PathLike = "geocone") -> Path:
    """Finds a program.

    Parameters
    ----------
    name
        A path, or a name. A name is looked for in this order: in the environment variable
        GEOCONE ("geocone" only, a path), in build/release of the source that this package
        stands in, where this package was installed with the programs, and in the PATH.

    Returns
    -------
    pathlib.Path
        Path of the program.

    Raises
    ------
    FileNotFoundError
        If there is none; with the places and how to get it.
    """
    name, given = os.fspath(name), os.environ.get("GEOCONE", "")
    if os.sep in name:
        places, remedy = [Path(name)], "check the path"
    elif name == "geocone" and given:
        places, remedy = [Path(given)], "set the environment variable GEOCONE right, or unset it"
    else:
        places = [ROOT / "build" / "release" / name,
                  *(parent / "bin" / name for parent in ROOT.parents[1:2]),
                  *map(Path, filter(None, [shutil.which(name)]))]
        remedy = ("build it by scripts/build in geocone's source, or install the Debian package "
                  "that scripts/package makes; if it is elsewhere, set the environment variable "
                  "GEOCONE to its path, or give program=PATH")
    for place in places:
        if place.is_file():
            return place.resolve()
    raise FileNotFoundError(
        f"there is no program '{name}'; looked for: "
        f"{', '.join(str(place) for place in places)}{', PATH' * (len(places) > 1)}\n"
        f"  remedy:  {remedy}")


def example(name: str) -> Path:
    """Finds a parameter file that comes with geocone.

    Parameters
    ----------
    name
        Below the folder of the examples, e.g. "safety/slope_2to1.prm".

    Returns
    -------
    pathlib.Path
        Path of the file: in prm of the source, or where this package or else the program
        is installed.

    Raises
    ------
    FileNotFoundError
        If there is none.
    """
    places = [ROOT / "prm", ROOT.parent / "doc" / "geocone" / "examples"]
    with contextlib.suppress(FileNotFoundError, IndexError):  # e.g. installed by pip
        program = find_program()
        places += [program.parents[2] / "prm",
                   program.parents[1] / "share" / "doc" / "geocone" / "examples"]
    for place in places:
        if (place / name).is_file():
            return place / name
    raise FileNotFoundError(f"there is no example '{name}' in "
                            f"{' or '.join(str(place) for place in places)}")


def environment() -> dict[str, str]:
    """Environment variables of a call: one thread per rank, and root may use mpirun."""
    variables = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    if os.geteuid() == 0:
        variables.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return variables
