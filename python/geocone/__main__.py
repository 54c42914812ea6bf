# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""python3 -m geocone plot RUN-FOLDER ...     draws pictures of runs
python3 -m geocone report STUDY.toml ...   computes studies and writes their report
python3 -m geocone dxf DRAWING.dxf NEW.prm begins a parameter file from a drawing
python3 -m geocone boreholes TABLE.csv NEW.prm begins one from a table of boreholes
Each with --help."""

import os
import sys


def main(arguments, prog=None):
    """Does what the command line asks for; returns the exit code."""
    verb, *rest = arguments or [""]
    if verb == "plot":
        from geocone.plots import main as call
    elif verb == "report":
        from geocone.report.study import main as call
    elif verb == "dxf":
        from geocone.dxf import main as call
    elif verb == "boreholes":
        from geocone.boreholes import main as call
    else:
        print(__doc__, file=sys.stdout if verb in ("-h", "--help") else sys.stderr)
        return 0 if verb in ("-h", "--help") else 1
    try:
        return call(rest, prog or f"python3 -m geocone {verb}")
    except BrokenPipeError:  # as of "| head": nobody listens any more
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
