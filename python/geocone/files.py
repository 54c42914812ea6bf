# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files are written whole."""


def write_whole(path, content):
    """Writes a file, of text or bytes, under a temporary name first."""
    part = path.with_name(path.name + ".part")
    (part.write_bytes if isinstance(content, bytes) else part.write_text)(content)
    part.replace(path)


def add_to_list(path):
    """Adds a file to the list of those that its run has written, if there is one."""
    record = path.with_name("files.txt")
    if record.is_file():
        names = record.read_text().splitlines()
        if path.name not in names:
            write_whole(record, "".join(name + "\n" for name in [*names, path.name]))
