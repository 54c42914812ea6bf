# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Processes of a run, for the trials that interrupt it."""

import os
from pathlib import Path


def ranks_of(child, program):
    """The processes of a call that compute: itself, or the children of mpirun. Another
    process that a rank may have is none."""
    def runs_program(pid):
        try:
            return os.path.samefile(f"/proc/{pid}/exe", program)
        except OSError:
            return False

    def parent(pid):
        try:
            return int(Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[1])
        except OSError:
            return None
    if runs_program(child.pid):
        return [child.pid]
    return [int(path.name) for path in Path("/proc").glob("[0-9]*")
            if parent(path.name) == child.pid and runs_program(path.name)]
