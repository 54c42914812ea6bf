# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the parameter files that pages of doc/tutorials hold in blocks:
    parameters.py FOLDER PAGE...     (of the repository: prm/tutorials slope footing particles)
Blocks of one name, "```prm NAME", follow each other in one file. Blocks of C++, "```cpp
NAME", must be parts of the file NAME of this folder."""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
BLOCK = re.compile(r"^```(prm|cpp) (\S+)\n(.*?)^```$", re.M | re.S)

folder = Path(sys.argv[1])
files = {}
for page in sys.argv[2:]:
    text = (HERE.parents[1] / "doc" / "tutorials" / f"{page}.md").read_text()
    for language, name, block in BLOCK.findall(text):
        if language == "prm":
            head = f"# Explained line by line in doc/tutorials/{page}.md.\n"
            files[name] = files.get(name, head) + block
        elif block not in (HERE / name).read_text():
            sys.exit(f"{page}.md has another text than {name}:\n{block}")
folder.mkdir(parents=True, exist_ok=True)
for name, text in files.items():
    (folder / name).write_text(text)
