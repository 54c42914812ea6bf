# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter files and settings, read and written. Values are left to geocone to check, but
files that would be read without end are refused."""

import itertools
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any


LARGEST, MOST, DEEPEST = 16_000_000, 1000, 20  # bytes of a file, files, levels: geocone's


class IncludeError(ValueError):
    """A parameter file that geocone would not read, in a line."""


def text_in(path: str | os.PathLike) -> str:
    """Reads the text of a parameter file.

    Raises
    ------
    IncludeError
        If it is no file, or too large.
    OSError
        If it cannot be read.
    """
    if not os.path.isfile(path):  # a device would be read without end
        raise IncludeError(f"'{path}' is no file")
    if os.path.getsize(path) > LARGEST:
        raise IncludeError(f"'{path}' is larger than {LARGEST // 10**6} MB")
    return Path(path).read_text(encoding="utf-8-sig", errors="replace")


def lines_of(path: Path) -> Iterator[tuple[str, Path]]:
    """Lines of a parameter file and of the files that it includes.

    Yields
    ------
    tuple
        Each line, and the path of its file.

    Raises
    ------
    IncludeError, OSError
        If one of the files cannot be read, or if there are too many.
    """
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


def statements(lines: Iterable[str]) -> Iterator[str]:
    """Lines without comments and blanks around them, joined where one ends with a backslash."""
    begun = None
    for line in itertools.chain(lines, [""]):
        line = line if begun is None else begun + line.strip()
        begun = line[:-1] if line.endswith("\\") else None
        text = line.partition("#")[0].strip()
        if text and begun is None:
            yield text


def settings_in(lines: Iterable[str]) -> dict[str, str]:
    """Settings of lines, {"Section/Name": text}; later lines win."""
    values, sections = {}, []
    for line in statements(lines):
        word, _, rest = line.partition(" ")
        if word == "subsection":
            sections.append(rest.strip())
        elif word == "end" and sections:
            sections.pop()
        elif word == "set":
            name, _, value = rest.partition("=")
            values["/".join([*sections, name.strip()])] = value.strip()
    return values


def parameters_of(path: str | os.PathLike) -> dict[str, str]:
    """Reads the parameters that the file of a run's folder sets. Nothing else is read: such
    a file includes none.

    Returns
    -------
    dict
        {"Section/Name": text}.

    Raises
    ------
    IncludeError, OSError
        If the file cannot be read.
    """
    return settings_in(text_in(path).splitlines())


def file_text(parameters: Mapping[str, str]) -> str:
    """Text of a parameter file that sets all parameters {"Section/Name": text}."""
    tree: dict = {}
    for path, text in parameters.items():
        *sections, name = path.split("/")
        here = tree
        for section in sections:
            here = here.setdefault(section, {})
        here[name] = text

    def lines(section, indent):
        own = {name: part for name, part in section.items() if isinstance(part, str)}
        width = max(map(len, own), default=0)
        for name, text in own.items():
            yield f"{indent}set {name:<{width}} = {text}".rstrip()
        for name, part in section.items():
            if name not in own:
                yield f"{indent}subsection {name}"
                yield from lines(part, indent + "  ")
                yield f"{indent}end"
    return "".join(line + "\n" for line in lines(tree, ""))


def setting(name: str, value: Any) -> str:
    """'Section/Name = value' as the option --set takes it; values as text_of() has them."""
    return f"{name} = {text_of(value)}"


def text_of(value: Any) -> str:
    """A value as parameter files have it: truth values (true, false), numbers, texts, lists
    of them (a, b), and lists of lists (a, b; c, d); numpy's, too."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        nested = any(isinstance(part, (list, tuple)) for part in value)
        return ("; " if nested else ", ").join(map(text_of, value))
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)
