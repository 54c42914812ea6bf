"""The checker proves the bounds of four runs, and finds changes of their files."""

import contextlib
import io
import json
import runpy
import sys
from pathlib import Path

CHECKER = runpy.run_path(sys.argv[1])


def verdict(function, path):
    """Result of a function of the checker, and its words."""
    words = io.StringIO()
    with contextlib.redirect_stdout(words):
        found = CHECKER[function](path)
    print(words.getvalue(), end="")
    return found, words.getvalue()


for folder in "reaction", "weight", "factor", "obstacles":
    good, text = verdict("check_folder", folder)
    assert good and text.count(" proved for ") == 2

# Changed values: folder, side, place in the file, factor, reason.
CHANGES = (
    ("reaction", "lower", ("stress", 3, 1, 0), 1.0001, "tractions"),
    ("reaction", "lower", ("materials", 0, "cohesion"), 0.9, "only"),
    ("reaction", "upper", ("value",), 0.999, "only"),
    ("weight", "lower", ("body_force", "live", 5, 1), 1.0001, "div s + b"),
    ("weight", "upper", ("materials", 0, "tensile_strength"), 2., "only"),
    ("factor", "lower", ("strength_factor",), 1.1, "load factor"),
    ("factor", "upper", ("strength_factor",), 0.9, "flow rule"),
    ("obstacles", "lower", ("obstacles", 0, "friction"), 0.5, "strength"),
    ("obstacles", "lower", ("interfaces", "traction", 0, 0, 1), 1.0001, "tractions"),
    ("obstacles", "upper", ("obstacles", 0, "friction"), 4., "flow of interfaces"),
)
for folder, side, place, factor, reason in CHANGES:
    content = json.loads(Path(folder, f"certificate_{side}.json").read_text())
    data = content
    for key in place[:-1]:
        data = data[key]
    data[place[-1]] *= factor
    changed = Path("changed.json")
    changed.write_text(json.dumps(content))
    body, text = verdict("check", changed)
    assert body is None and reason in text.partition("NOT PROVED")[2], (place, text)

# A lower and an upper bound of different problems.
other = Path("other")
other.mkdir()
for side, folder in ("lower", "reaction"), ("upper", "weight"):
    name = f"certificate_{side}.json"
    (other / name).write_text(Path(folder, name).read_text())
good, text = verdict("check_folder", other)
assert not good and "different problems" in text
