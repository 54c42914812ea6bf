"""Verdicts of scripts/check_certificate, the argument of the program, for tests of it."""

import contextlib
import io
import runpy
import sys

CHECKER = runpy.run_path(sys.argv[1])


def verdict(function, path):
    """Result of a function of the checker, and its words."""
    words = io.StringIO()
    with contextlib.redirect_stdout(words):
        found = CHECKER[function](path)
    print(words.getvalue(), end="")
    return found, words.getvalue()
