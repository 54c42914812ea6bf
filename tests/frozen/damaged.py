#!/usr/bin/python3
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frozen problems that no step can have written are refused, with one message, exit
code 1, and nothing written:

    damaged.py PROGRAM FOLDER"""

import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ORIGINAL = HERE / "mpm_segments_assoc_cold.h5"


def replaced(file, name, values):
    """Another array in the place of one."""
    del file[name]
    file[name] = values


def text(words):
    """A text as these files have it."""
    return np.frombuffer(words.encode(), np.int8)


def changed(file, name, place, value):
    """One value of an array replaced."""
    values = file[name][:]
    values[place] = value
    replaced(file, name, values)


def grouped(file, name):
    """A group in the place of an array, which holds itself."""
    del file[name]
    group = file.create_group(name)
    group["itself"] = group


def huge(file, name, **options):
    """An array that claims more than there is."""
    del file[name]
    file.create_dataset(name, (1 << 40,), "f8", **options)


DAMAGES = {  # what is done to the file, and a part of the message
    "materials": (lambda f: replaced(f, "materials", text("end\nend")),
                  "an 'end' without a subsection"),
    "name": (lambda f: replaced(
        f, "materials", text("subsection Materials\n  set Names = a/b\n"
                             "  subsection a/b\n  end\nend\n")), "'/'"),
    "include": (lambda f: replaced(
        f, "materials", text("subsection Materials\ninclude /dev/zero\nend\n")),
        "no parameter of a material"),
    "output": (lambda f: replaced(
        f, "materials", text("subsection Output\n  set Folder = x\nend\n")),
        "Materials"),
    "node": (lambda f: changed(f, "points/nodes", 0, 2**31 - 1), "cells without nodes"),
    "kind": (lambda f: changed(f, "dofs/kind", 0, 3), "neither free nor prescribed"),
    "mass": (lambda f: changed(f, "dofs/mass", 0, np.nan), "not finite"),
    "velocity": (lambda f: changed(f, "dofs/velocity_L", 3, np.inf), "not finite"),
    "stress": (lambda f: changed(f, "points/stress", 3, 1e300), "not finite"),
    "weight": (lambda f: changed(f, "points/weight", 0, -1.), "without a volume"),
    "wide": (lambda f: replaced(f, "dofs/kind", f["dofs/kind"][:].astype(np.int64) + 2**40), "no int"),
    "floats": (lambda f: replaced(f, "dofs/kind", f["dofs/kind"][:] + 0.5),
               "does not hold integers"),
    "strings": (lambda f: replaced(f, "dofs/mass", np.array([b"one"])),
                "does not hold numbers"),
    "group": (lambda f: grouped(f, "dofs/mass"), "a group"),
    "link": (lambda f: (f.__delitem__("dofs/mass"), f.__setitem__(
        "dofs/mass", h5py.ExternalLink("other.h5", "x"))), "a link"),
    "claim": (lambda f: huge(f, "dofs/mass"), "claims"),
    "chunks": (lambda f: huge(f, "dofs/mass", chunks=(1 << 20,), compression=1),
               "claims"),
    "table": (lambda f: replaced(f, "dofs/mass", f["dofs/mass"][:].reshape(-1, 1)),
              "one dimension"),
    "filter": (lambda f: (f.__delitem__("dofs/mass"), f.create_dataset(
        "dofs/mass", data=np.ones(8), compression="lzf")), "filter")}


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    errors = []
    for name, (damage, message) in DAMAGES.items():
        path = folder / f"{name}.h5"
        shutil.copy(ORIGINAL, path)
        with h5py.File(path, "r+") as file:
            damage(file)
        result = subprocess.run(
            [program, path, "--output", folder / name, "--quiet"],
            capture_output=True, text=True, timeout=60)
        if (result.returncode != 1 or not result.stderr.startswith("error: ") or
                message not in result.stderr or (folder / name).exists()):
            errors.append(f"{name}: exit code {result.returncode}, {result.stderr}")
    print("\n".join(errors))
    return len(errors) > 0


if __name__ == "__main__":
    sys.exit(main())
