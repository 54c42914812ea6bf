# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter files: what they say, and how settings are written. What geocone would
refuse is left to it."""


def lines_of(path, depth=0):
    """The lines of a parameter file and of the files that it includes, each with the
    path of its file. A file that cannot be read is one line that says so."""
    if depth > 20 or not path.is_file():
        yield f"# {path} cannot be read", path
        return
    for line in path.read_text(errors="replace").splitlines():
        words = line.split("#")[0].split()
        if len(words) == 2 and words[0] == "include":
            yield from lines_of(path.parent / words[1], depth + 1)
        else:
            yield line, path


def parameters_of(path):
    """The parameters that a file sets, {"Section/Name": text}; later lines win."""
    values, sections = {}, []
    for line, _ in lines_of(path):
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
