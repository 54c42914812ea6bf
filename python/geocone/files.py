# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files are written whole, and only what a run has written is deleted."""

import os

LIST = "files.txt"  # of the files that a run has written
LOCK = "run.lock"  # of a run that goes on, or was killed


def write_whole(path, content):
    """Writes a file, of text or bytes, under a temporary name first. Neither name is
    followed if it is a link."""
    part = path.with_name(path.name + ".part")
    part.unlink(missing_ok=True)  # of one that was interrupted
    with open(part, "xb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())
    part.replace(path)


def files_of_run(folder):
    """The files in the folder of a run, which may be deleted; none if it is not there.
    @throw FileExistsError if anything else is in it"""
    if not os.path.lexists(folder):
        return []
    if folder.is_symlink() or not folder.is_dir():
        raise FileExistsError(f"'{folder}' is not the folder of a run")
    record = folder / LIST
    names = {LIST, LOCK, *(record.read_text(errors="replace").splitlines()
                     if record.is_file() and not record.is_symlink() else ())}
    for file in folder.iterdir():
        if file.name.removesuffix(".part") not in names or (
                file.is_dir() and not file.is_symlink()):
            raise FileExistsError(f"'{file}' is not in the list {LIST} of the files of a run")
    return list(folder.iterdir())


def remove_run(folder):
    """Deletes the folder of a run.
    @throw FileExistsError, before anything is deleted, if anything else is in it"""
    files = files_of_run(folder)
    for file in files:
        file.unlink()
    if os.path.lexists(folder):
        folder.rmdir()


def add_to_list(path):
    """Adds a file that will be written to the list of those of its run, if there is one.
    @throw FileExistsError if it is there and not in the list, or a symbolic link"""
    record = path.with_name(LIST)
    if not record.is_file() or path.name == record.name:
        return
    names = record.read_text().splitlines()
    if path.is_symlink() or (os.path.lexists(path) and path.name not in names):
        raise FileExistsError(f"'{path}' is none of the run's files (files.txt): it is "
                              "kept; move it away")
    if path.name not in names:
        write_whole(record, "".join(name + "\n" for name in [*names, path.name]))
