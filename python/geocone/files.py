# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files are written whole, and only what a run has written is deleted."""

import os
from pathlib import Path

LIST = "files.txt"  # of the files that a run has written
LOCK = "run.lock"  # of a run that goes on, or was killed


def write_whole(path: Path, content: str | bytes) -> None:
    """Writes a file under a temporary name first. Neither name is followed if it is a link.

    Raises
    ------
    OSError
        If it cannot be written.
    """
    part = path.with_name(path.name + ".part")
    part.unlink(missing_ok=True)  # of one that was interrupted
    with open(part, "xb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())
    part.replace(path)


def files_of_run(folder: Path) -> list[Path]:
    """The files in the folder of a run, which may be deleted; none if it is not there.

    Raises
    ------
    FileExistsError
        If anything else is in it.
    """
    if not os.path.lexists(folder):
        return []
    if folder.is_symlink() or not folder.is_dir():
        raise FileExistsError(f"'{folder}' is not the folder of a run")
    names = {LIST, LOCK, *(names_of(folder) or ())}
    for file in folder.iterdir():
        if file.name.removesuffix(".part") not in names or (
                file.is_dir() and not file.is_symlink()):
            raise FileExistsError(f"'{file}' is not in the list {LIST} of the files of a run")
    return list(folder.iterdir())


def remove_run(folder: Path) -> None:
    """Deletes the folder of a run.

    Raises
    ------
    FileExistsError
        If anything else is in it, before anything is deleted.
    """
    files = files_of_run(folder)
    for file in files:
        file.unlink()
    if os.path.lexists(folder):
        folder.rmdir()


def names_of(folder: Path) -> list[str] | None:
    """The files that the list of a run names; None without a list."""
    record = folder / LIST
    return (record.read_text(errors="replace").splitlines()
            if record.is_file() and not record.is_symlink() else None)


def claim(path: Path) -> None:
    """Refuses to replace a file in the folder of a run that its list does not name.

    Raises
    ------
    FileExistsError
        If the file is there, and is not the run's.
    """
    names = names_of(path.parent)
    if names is not None and os.path.lexists(path) and path.name not in names:
        raise FileExistsError(f"'{path}' is there, and is none of the run's files ({LIST}): "
                              "move it elsewhere, or draw into another folder with --output")


def write_listed(path: Path, content: str | bytes) -> None:
    """Writes a file and adds it to the list of those that its run has written, if there is
    one.

    Raises
    ------
    FileExistsError
        If that would replace a file that is not the run's.
    """
    claim(path)
    write_whole(path, content)
    add_to_list(path)


def add_to_list(path: Path) -> None:
    """Adds a file to the list of those that its run has written, if there is one."""
    names = names_of(path.parent)
    if names is not None and path.name not in names:
        write_whole(path.with_name(LIST), "".join(name + "\n" for name in [*names, path.name]))
