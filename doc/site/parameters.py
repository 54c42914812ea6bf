# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a page on each section of parameters, from the schemas of the program for the plane
and for three dimensions (scripts/site):
    parameters.py PLANE.json SPACE.json FOLDER
FOLDER/README.md gets the list of these pages."""

import json
import re
import sys
from pathlib import Path

# Pages with the theory and with examples of a section, below doc/.
SEE = {
    "Analysis": ["theory/limit_analysis", "cookbook/limit_load", "cookbook/safety",
                 "cookbook/reliability"],
    "Random fields": ["theory/reliability", "cookbook/reliability"],
    "Shakedown": ["theory/shakedown", "cookbook/shakedown"],
    "Discretisation": ["theory/finite_elements", "theory/locking", "theory/material_points",
                       "comparison"],
    "Geometry": ["your_own_scene", "cookbook/round_bodies", "cookbook/three_dimensions"],
    "Mesh": ["your_own_scene", "cookbook/footing"],
    "Materials": ["theory/laws", "theory/subloading", "friction_memory",
                  "cookbook/element_tests", "cookbook/softening", "cookbook/undrained"],
    "Initial stress": ["cookbook/gravity_patch", "cookbook/stages"],
    "Initial velocity": ["cookbook/two_discs", "cookbook/rotating_square"],
    "Boundary conditions": ["your_own_scene", "cookbook/footing"],
    "Gravity": ["cookbook/column", "cookbook/slope"],
    "Tractions": ["theory/stages", "cookbook/safety"],
    "Water": ["theory/stages", "cookbook/safety"],
    "Seepage": ["theory/seepage", "cookbook/seepage"],
    "Obstacles": ["theory/contact", "cookbook/contact"],
    "Contacts": ["theory/contact", "cookbook/contact"],
    "Structures": ["theory/structures", "cookbook/structures", "theory/bounds_structures",
                   "cookbook/bounds_structures"],
    "Absorbing boundaries": ["cookbook/waves"],
    "Loading": ["theory/stages", "cookbook/stages", "cookbook/raised_loads"],
    "Path": ["element_test", "cookbook/element_tests"],
    "Element": ["element_test", "cookbook/element_tests"],
    "Time stepping": ["theory/incremental_problem", "cookbook/bar"],
    "Newton": ["theory/newton", "cookbook/hard_cases"],
    "Linear solver": ["performance"],
    "Material point method": ["theory/material_points", "verification_mpm"],
    "Particles": ["theory/material_points", "cookbook/column_collapse"],
    "Explicit": ["theory/explicit", "cookbook/column_collapse"],
    "Observation": ["theory/energies", "cookbook/footing"],
    "Exact solution": ["cookbook/elastic_plate", "verification"],
    "Reference": ["validation"],
    "Checkpoint": ["runs"],
    "Output": ["runs", "cookbook/frozen_problems"]}


def entries(section, path=()):
    """The parameters of a section by their paths, in the order of the schema."""
    for name, entry in section["properties"].items():
        if entry["type"] == "object":
            yield from entries(entry, (*path, name))
        else:
            yield (*path, name), entry
    if section["additionalProperties"]:
        yield from entries(section["additionalProperties"], (*path, "NAME"))


def file_name(section):
    """The page of a section."""
    return section.lower().replace(" ", "_") + ".md"


def anchor(name):
    """The anchor of a heading, as MyST makes it."""
    return re.sub(r"[^\w -]", "", name.lower()).replace(" ", "-")


def escaped(text):
    """A text without marks of Markdown."""
    return re.sub(r"([\\`*_\[\]<>$|#{}~^])", r"\\\1", text)


def linked(text, section, sections):
    """A text in which quoted names of parameters are links."""
    def link(match):
        path = match.group(1).split("/")
        top, name = (path[0], path[-1]) if len(path) > 1 else (section, path[0])
        if name not in sections.get(top, ()):
            return escaped(match.group(0))
        page = "" if top == section else file_name(top)
        return f"[{escaped(match.group(1))}]({page}#{anchor(name)})"
    parts = re.split(r"('[^']+')", text)
    return "".join(re.sub(r"'([^']+)'", link, part) if i % 2 else escaped(part)
                   for i, part in enumerate(parts))


def used_with(conditions, sections):
    """A sentence on conditions, with links to the parameters in them."""
    words = []
    for text in conditions:
        name, _, values = text.partition(" = ")
        words.append(linked(f"'{name}'", "", sections) +
                     (f" = {escaped(values)}" if values else ""))
    return f"Used with {', and '.join(words)}."


def facts(path, entry):
    """Path, default, unit, type and allowed values of a parameter, in a line."""
    kind = entry["type"] if isinstance(entry["type"], str) else "text"
    kind = {"array": "list", "string": "choice"}.get(kind, kind)
    line = [f"`{path}`", f"default `{entry['x-default']}`" if entry["x-default"] else
            "default: empty"]
    if "x-unit" in entry:
        line.append(f"unit {escaped(entry['x-unit'])}")
    line.append(kind)
    if kind in ("choice", "list") or "minimum" in entry or "maximum" in entry:
        line[-1] += f": {escaped(entry['x-allowed'])}"
    return " · ".join(line)


def page(section, schema, plane, space, sections):
    """The page on a section."""
    text = [f"# {section}", schema["description"][0].upper() + schema["description"][1:] + "."]
    pages = [f"[{title(name)}](../{name}.md)" for name in SEE[section]]
    text.append("See also " + ", ".join(pages) + ".")
    first, *others = (entry.get("x-used-with", ()) for entry in plane.values())
    of_all = [words for words in first if all(words in other for other in others)]
    text += [used_with(of_all, sections)] if of_all else []
    for path in [*plane, *(path for path in space if path not in plane)]:
        entry = plane.get(path) or space[path]
        text += [f"### {path[-1]}", facts("/".join((section, *path)), entry),
                 linked(entry["description"], section, sections)]
        notes = ["Only in three dimensions."] if path not in plane else []
        notes += ["Only in the plane."] if space and path not in space else []
        own = [words for words in entry.get("x-used-with", ()) if words not in of_all]
        notes += [used_with(own, sections)] if own else []
        text += [" ".join(notes)] if notes else []
    return "\n\n".join(text) + "\n"


def title(name):
    """The title of a page of the documentation, without a number."""
    first = (Path(__file__).parents[1] / f"{name}.md").open().readline()
    return re.sub(r"^# (\d+\. )?", "", first).strip()


def main():
    """Writes the pages."""
    plane, space = (json.loads(Path(name).read_text()) for name in sys.argv[1:3])
    folder = Path(sys.argv[3])
    of_plane, of_space = ({name: dict(entries(section))
                           for name, section in schema["properties"].items()}
                          for schema in (plane, space))
    names = {name: {path[-1] for path in (*of_plane[name], *of_space.get(name, ()))}
             for name in of_plane}
    index = ["", "| Section | Contents |", "| --- | --- |"]
    for section, schema in plane["properties"].items():
        (folder / file_name(section)).write_text(
            page(section, schema, of_plane[section], of_space.get(section, {}), names))
        index.append(f"| [{section}]({file_name(section)}) | {schema['description']} |")
    with (folder / "README.md").open("a") as readme:
        readme.write("\n".join(index) + "\n")


main()
