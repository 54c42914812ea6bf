# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter files: their values, and how settings are written. Errors are left to geocone,
but for files that are read without end."""

import itertools
import os
from pathlib import Path


LARGEST, MOST, DEEPEST = 16_000_000, 1000, 20  # bytes of a file, files, levels: geocone's


class IncludeError(ValueError):
    """A parameter file that geocone would not read, in a line."""


def text_in(path):
    """The text of a parameter file.
    @throw IncludeError, OSError"""
    if not os.path.isfile(path):  # a device would be read without end
        raise IncludeError(f"'{path}' is no file")
    if os.path.getsize(path) > LARGEST:
        raise IncludeError(f"'{path}' is larger than {LARGEST // 10**6} MB")
    return Path(path).read_text(encoding="utf-8", errors="replace")


def lines_of(path):
    """The lines of a parameter file and of the files that it includes, each with the
    path of its file.
    @throw IncludeError, OSError"""
    count = itertools.count(1)

    def read(path, depth):
        if depth > DEEPEST:
            raise IncludeError(f"'{path}' includes itself")
        if next(count) > MOST:
            raise IncludeError(f"more than {MOST} files are included, of which '{path}' is one")
        for line in text_in(path).splitlines():
            words = line.split("#")[0].split(maxsplit=1)
            if len(words) == 2 and words[0] == "include":
                yield from read(path.parent / words[1].strip(), depth + 1)
            else:
                yield line, path
    return read(path, 0)


def parameters_of(path):
    """The parameters that the file of a run's folder sets, {"Section/Name": text}; later
    lines win. Nothing else is read: such a file includes none.
    @throw IncludeError, OSError"""
    values, sections = {}, []
    for line in text_in(path).splitlines():
        word, _, rest = line.split("#")[0].strip().partition(" ")
        if word == "subsection":
            sections.append(rest.strip())
        elif word == "end" and sections:
            sections.pop()
        elif word == "set":
            name, _, value = rest.partition("=")
            values["/".join([*sections, name.strip()])] = value.strip()
    return values


def setting(name, value):
    """'Section/Name = value' as --set takes it: truth values, numbers, texts, lists of
    them (a, b), and lists of lists (a, b; c, d)."""
    return f"{name} = {text_of(value)}"


def text_of(value):
    """A value as parameter files write it."""
    if isinstance(value, (list, tuple)):
        nested = any(isinstance(part, (list, tuple)) for part in value)
        return ("; " if nested else ", ").join(map(text_of, value))
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)
