# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files are written whole."""

import os


def write_whole(path, content):
    """Writes a file, of text or bytes, under a temporary name first, never through a
    symbolic link."""
    part = path.with_name(path.name + ".part")
    part.unlink(missing_ok=True)
    data = content if isinstance(content, bytes) else content.encode()
    with open(part, "xb") as file:
        file.write(data)
    part.replace(path)


def add_to_list(path):
    """Adds a file that will be written to the list of those of its run, if there is one.
    @throw FileExistsError if it is there and not in the list, or a symbolic link"""
    record = path.with_name("files.txt")
    if not record.is_file() or path.name == record.name:
        return
    names = record.read_text().splitlines()
    if path.is_symlink() or (os.path.lexists(path) and path.name not in names):
        raise FileExistsError(f"'{path}' is none of the run's files (files.txt): it is "
                              "kept; move it away")
    if path.name not in names:
        write_whole(record, "".join(name + "\n" for name in [*names, path.name]))
