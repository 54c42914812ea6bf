"""Checks a schema of parameters against the rules of JSON Schema, and compares it with a
listing of 'geocone --help all': schema.py SCHEMA LISTING."""

import json
import sys

from pathlib import Path

TYPES = {"string": str, "number": (int, float), "integer": int, "boolean": bool, "array": list}


def parameters(section, path=()):
    """The parameters of a section, by their paths."""
    for name, entry in section["properties"].items():
        if entry["type"] == "object":
            yield from parameters(entry, (*path, name))
        else:
            yield (*path, name), entry
    if section["additionalProperties"] is not False:
        yield from parameters(section["additionalProperties"], (*path, "NAME"))


def fits(value, entry):
    """Whether a value is allowed by a part of a schema."""
    types = entry["type"] if isinstance(entry["type"], list) else [entry["type"]]
    if not any(isinstance(value, TYPES[name]) for name in types):
        return False
    if isinstance(value, list):
        return (all(fits(item, entry["items"]) for item in value)
                and entry.get("minItems", 0) <= len(value) <= entry.get("maxItems", 1e9))
    return (value in entry.get("enum", [value])
            and not (isinstance(value, (int, float))
                     and not entry.get("minimum", value) <= value <= entry.get("maximum", value)))


def listed(lines):
    """The paths in a listing."""
    path = []
    for line in lines:
        words = line.split(maxsplit=1)
        if words[:1] == ["subsection"]:
            path.append(words[1])
        elif words == ["end"]:
            path.pop()
        elif words[:1] == ["set"]:
            yield (*path, words[1].split("=")[0].strip())


schema = json.loads(Path(sys.argv[1]).read_text())
assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
found = dict(parameters(schema))
assert list(found) == list(listed(Path(sys.argv[2]).read_text().splitlines()))
assert len(found) > 200, len(found)
for path, entry in found.items():
    assert fits(entry["default"], entry), (path, entry)
    assert len(entry["description"]) > 8 and entry["x-allowed"], (path, entry)
material = "Materials", "NAME"
is_plane = ("Boundary conditions", "NAME", "Velocity z") not in found
of_plane = ["reliability", "shakedown"] if is_plane else []
assert found["Analysis", "Kind"]["enum"] == ["steps", "limit load", "strength reduction",
                                             *of_plane, "seepage"]
assert found["Time stepping", "Inertia"] == {**found["Time stepping", "Inertia"],
                                             "type": "boolean", "default": False}
assert found[*material, "Cohesion"]["x-unit"] == "Pa"
assert found[*material, "Cohesion"]["type"] == "number"
assert found["Loading", "NAME", "Strength factor"]["x-used-with"][-1] == (
    "Discretisation/Method = FEM or MPM")
assert found["Geometry", "Polygon"]["default"][1][:2] == [1, 0]
assert found["Boundary conditions", "NAME", "Velocity x"]["x-unit"] == "m/s"
assert "x-unit" not in found["Particles", "File"]
try:
    import jsonschema
except ImportError:
    sys.exit()
jsonschema.Draft202012Validator.check_schema(schema)
scene = {"Materials": {"Names": ["clay"], "clay": {"Cohesion": 12e3}}}
jsonschema.validate(scene, schema, jsonschema.Draft202012Validator)
for wrong in ({"Material": {}}, {"Materials": {"clay": {"Cohesion": "much"}}},
              {"Materials": {"clay": {"Cohesive": 1}}}, {"Analysis": {"Kind": "none"}}):
    try:
        jsonschema.validate(wrong, schema, jsonschema.Draft202012Validator)
    except jsonschema.ValidationError:
        continue
    sys.exit(f"not refused: {wrong}")
