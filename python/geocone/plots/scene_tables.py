# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the scene of a run, for its page: soils, loads, supports, water, stages."""

import math
from collections import namedtuple

import numpy as np

from geocone.plots.model import Model, color_of, value_text, words_of
from geocone.reader import ReadError, mass_unit
from geocone.style import plain

# head  names of the columns; rows  cells, each a text; swatches  a colour for each row
Table = namedtuple("Table", "title head rows swatches")

# Constants of the soils: symbol, unit in the table, and its value in SI units.
CONSTANTS = {
    "Density": ("ρ", "kg/m³", 1.), "Unit weight": ("γ", "kN/m³", 1e3),
    "Saturated unit weight": ("γsat", "kN/m³", 1e3),
    "Cohesion": ("c", "kPa", 1e3), "Cohesion formula": ("c(x, y)", "Pa", 1.),
    "Cohesion gradient": ("dc/dz", "kPa/m", 1e3), "Cohesion ratio": ("c/σv", "-", 1.),
    "Cohesion level": ("c at y", "m", 1.), "Undrained strength": ("su", "kPa", 1e3),
    "Tensile strength": ("tension", "kPa", 1e3),
    "Friction angle": ("φ", "°", 1.), "Dilatancy angle": ("ψ", "°", 1.),
    "Young modulus": ("E", "MPa", 1e6), "Young modulus formula": ("E(x, y)", "Pa", 1.),
    "Poisson ratio": ("ν", "-", 1.), "K0": ("K0", "-", 1.),
    "Pore fluid bulk modulus": ("Kw/n", "MPa", 1e6)}
# Settings of a material that describe where it is or how it is computed.
SETTINGS = ("Type", "Region polygon", "Region number", "Region below", "Points",
            "Friction memory", "Output tensors", "Stress outside", "Error tolerance",
            "Smallest substep", "Lowest pressure")
# Constants that are 1 where they have no effect.
RATIOS = "Passive strength ratio", "Simple shear strength ratio"


def number(text):
    """The number that a text is, or None."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


def constants_of(parameters, material):
    """The parameters of a material by their names, without those that are empty."""
    prefix = f"Materials/{material}/"
    return {key.removeprefix(prefix): text for key, text in parameters.items()
            if key.startswith(prefix) and text not in ("", "none")}


def soil_text(values, key, mass_unit):
    """A constant of a soil in the unit of its column. @param mass_unit of the values (kg)"""
    value = number(values.get(key))
    if key == "Saturated unit weight" and not value:  # as above the water
        return "–"
    _, unit, size = CONSTANTS[key]
    if unit not in ("-", "°", "m"):
        size /= mass_unit
    return (values.get(key, "") if value is None else f"{value / size:.6g}")


def soils_of(parameters, names, absent=()):
    """The table of the soils; a constant is a column if it is not zero in all of them, the
    tensile strength if it is given: zero is soil without tension."""
    values = [constants_of(parameters, name) for name in names]
    for of in values:
        if number(of.get("Unit weight")):  # which is used in place of the density
            of.pop("Density", None)
    kilograms = mass_unit(parameters)
    keys = [key for key in CONSTANTS if any(
        number(of.get(key, "0")) != 0. or (key == "Tensile strength" and key in of)
        for of in values)]
    if "Cohesion gradient" not in keys and "Cohesion level" in keys:
        keys.remove("Cohesion level")
    rest = [", ".join(f"{key} {text}" for key, text in of.items()
                      if key not in CONSTANTS and key not in SETTINGS and
                      number(text) not in (None, 1. if key in RATIOS else 0.))
            for of in values]
    units = {key: "kPa" if CONSTANTS[key][1] == "Pa" and kilograms != 1. else CONSTANTS[key][1]
             for key in keys}
    head = ["soil", "law", *(f"{CONSTANTS[key][0]} ({units[key]})" for key in keys),
            *(["further constants (SI units)" if kilograms == 1. else
               "further constants (t, kN, kPa)"] if any(rest) else [])]
    rows = [[name + (" (later)" if name in absent else ""), of.get("Type", ""),
             *(soil_text(of, key, kilograms) for key in keys), *([more] if any(rest) else [])]
            for name, of, more in zip(names, values, rest)]
    return Table("Soils", head, rows, [color_of(i) for i in range(len(names))])


def stated(parameters, section, keys):
    """Settings of a section in words, without those that are off."""
    texts = {key: parameters.get(f"{section}/{key}", "") for key in keys}
    return " | ".join(f"{key.lower()}: {text}" for key, text in texts.items()
                      if text not in ("", "none", "free"))


def loads_of(model):
    """The table of weight, tractions and imposed motions."""
    parameters, rows = model.parameters, []
    gravity = model.data["gravity_m_per_s2"]
    if np.any(gravity):
        is_down = gravity[1] <= 0. and not np.any(np.delete(gravity, 1))
        rows.append(["weight", (f"{-gravity[1]:.4g}" if is_down else
                                f"({', '.join(f'{g:.4g}' for g in gravity)})") + " m/s²", "body"])
    components = [f"{kind} {c}" for kind in ("Velocity", "Traction")
                  for c in ("x", "y", "z", "normal", "tangential")]
    for kind, section, unit in (("tractions", "Tractions", model.stress_unit),
                                ("supports", "Boundary conditions", "m/s")):
        for condition in model.data[kind]:
            values = np.array(condition["values"], dtype=float)
            if len(values) and np.any(values):
                at = f"{section}/{condition['name']}"
                rows.append([condition["name"], value_text(values, unit),
                             stated(parameters, at, ("Sides", "Box", "Where", *components))])
    return Table("Loads", ["load", "largest value", "where and how"], rows, None)


def supports_of(model):
    """The table of the sides that are held."""
    rows = []
    for condition in model.data["supports"]:
        if condition["faces"] and not np.any(condition["values"]):
            held = [c for c, given in zip("xyz", condition["prescribed"]) if given]
            rows.append([condition["name"], "fixed in " + (" and ".join(held) or "the normal"),
                         stated(model.parameters, f"Boundary conditions/{condition['name']}",
                                ("Sides", "Box", "Where"))])
    return Table("Supports", ["support", "motion", "where"], rows, None)


def water_of(model):
    """The table of the water."""
    table = model.parameters.get("Water/Table", "")
    file = model.parameters.get("Water/File", "")
    weight = number(model.parameters.get("Water/Unit weight"))
    rows = ([["piezometric line x, y (m)", table]] if table else []) + (
        [["pore pressures of the file", file]] if file else [])
    for name in filter(None, map(str.strip, model.parameters.get("Seepage/Names", "").split(","))):
        section = f"Seepage/{name}/"
        level, rain = model.parameters.get(section + "Level", "none"), number(
            model.parameters.get(section + "Rain"))
        rows.append([f"{name} (sides {model.parameters.get(section + 'Sides', '')})",
                     ("open to the air" if level == "none" else f"water level {level} m") +
                     (f", rain {rain:g} m/s" if rain else "")])
    if rows and weight:
        rows.append(["unit weight of water", f"{weight * model.mass_unit / 1e3:g} kN/m³"])
    return Table("Water", ["water", "value"], rows, None)


def stages_of(model):
    """The table of the stages; a single one that changes nothing is the loading itself."""
    if len(model.data["stages"]) == 1 and words_of(model.data["stages"][0]) == plain(
            model.data["stages"][0]["name"]):
        return Table("Stages", [], [], None)
    rows = [[str(i), words_of(stage), f"{stage['duration_s']:g}"]
            for i, stage in enumerate(model.data["stages"], 1)]
    return Table("Stages", ["stage", "change", "duration (s)"], rows, None)


def tables_of(run):
    """The tables of the scene of a run that are not empty: of an element test of its
    material, of a run without a model none."""
    try:
        if run.method == "point":
            return [soils_of(run.parameters, [run.summary["material"]])]
        model = Model(run.folder)
        names = [name for _, name in model.materials()]
        tables = [soils_of(model.parameters, names, model.absent()), loads_of(model),
                  supports_of(model), water_of(model), stages_of(model)]
    except (ReadError, LookupError):
        return []
    return [table for table in tables if table.rows]
