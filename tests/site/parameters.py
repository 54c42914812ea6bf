"""Every parameter of a schema is on the page of its section, with its path, default and unit,
at a place of its name: parameters.py SCHEMA FOLDER."""

import html
import json
import re
import sys
from pathlib import Path

folder = Path(sys.argv[2])


def check(section, path, page, text):
    """The parameters of a section, and of those below it."""
    count = 0
    for name, entry in section["properties"].items():
        where = "/".join((*path, name))
        if entry["type"] == "object":
            count += check(entry, (*path, name), page, text)
            continue
        count += 1
        assert re.search(f'id="{re.sub("[^a-z0-9]+", "-", name.lower()).strip("-")}"', page), where
        facts = re.search(re.escape(where) + " · default:? ([^·]*)(?: · unit ([^·]*))? · ", text)
        assert facts, where
        assert facts.group(1).split() == (entry["x-default"] or "empty").split(), where
        assert facts.group(2) == entry.get("x-unit"), where
    if section["additionalProperties"]:
        count += check(section["additionalProperties"], (*path, "NAME"), page, text)
    return count


total = 0
index = (folder / "README.html").read_text()
for title, part in json.loads(Path(sys.argv[1]).read_text())["properties"].items():
    file = title.lower().replace(" ", "_") + ".html"
    content = (folder / file).read_text()
    assert f'href="{file}"' in index, file
    total += check(part, (title,), content,
                   html.unescape(re.sub("<[^>]*>", "", content)))
assert total > 200, total
# A parameter that a text names is a link.
assert 'href="analysis.html#kind"' in (folder / "materials.html").read_text()
assert "Only in three dimensions." in (folder / "obstacles.html").read_text()
