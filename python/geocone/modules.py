# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Modules of others, and a remedy where one is missing."""

import importlib
import sys
from types import ModuleType

# Names that Debian and pip do not build by the same rule.
DEBIAN, PIP = {"PIL": "python3-pil"}, {"PIL": "pillow"}


class MissingModule(ImportError):
    """A module of others that the interpreter does not have, with the remedy."""


def require(name: str) -> ModuleType:
    """Imports a module of others.

    Parameters
    ----------
    name
        As in an import, e.g. "numpy".

    Returns
    -------
    ModuleType
        The module.

    Raises
    ------
    MissingModule
        If this interpreter does not have it; with its packages of Debian and pip.
    """
    try:
        return importlib.import_module(name)
    except ImportError as problem:
        missing = (problem.name or name).partition(".")[0]
        raise MissingModule(
            f"geocone needs the Python module '{missing}', which {sys.executable} "
            f"does not have ({problem})\n"
            f"  remedy:  apt-get install {DEBIAN.get(missing, f'python3-{missing}')} and call "
            f"/usr/bin/python3, or {sys.executable} -m pip install {PIP.get(missing, missing)}",
            name=missing) from problem
