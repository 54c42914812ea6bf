# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of scripts/fuzz of which it is known how they must end: formulas, names, one scene
described in two ways, study files, foreign files in the folder of a run, and two runs that
want one folder.

As those of fuzz_cases, each is made from a random.Random alone.
"""

import csv
import shutil

import fuzz_files
from fuzz_cases import (Call, SCENES, TESTS, is_number, last_step, set_values, write_scene)
from fuzz_files import MARKER

ROOT = TESTS.parent

# Formulas.

# Places of formulas where the value is known: scene, settings beside it, parameter, value.
KNOWN = [
    ("fem", {}, "Boundary conditions/footing/Velocity y", -0.02),
    ("fem", {}, "Boundary conditions/footing/Velocity x", 0.),
    ("fem", {"Tractions/Names": "load", "Tractions/load/Sides": "top",
             "Tractions/load/Box": "0.2, -0.1; 1, 0.1"}, "Tractions/load/Traction y", -100.),
    ("mpm_footing", {}, "Boundary conditions/footing/Velocity y", -0.02),
    ("mpm", {}, "Boundary conditions/bottom/Velocity y", 0.),
    ("mpm", {}, "Geometry/Where", 1.),
    ("explicit", {}, "Boundary conditions/floor/Velocity y", 0.),
    ("explicit", {"Initial velocity/Velocity y": "0"}, "Initial velocity/Velocity x", 0.1)]
# What has the value V, and what has the value zero, of coordinates and t.
EQUAL = ["V", "(V)", "V + 0*x", "V*(1 + 0*y)", "if(x > 1e9, 1, V)", "if(t < 1e9, V, 7*t)",
         "V/2 + V/2", "2*V - V", "V*cos(0)^2", "V*exp(0)", "V*max(0, 1)", "V*min(1, 2, 3)",
         "V*(sin(x)^2 + cos(x)^2)", "V*abs(-1)", "V*sqrt(4)/2", "V + x - x", "V*(t + 1)/(t + 1)",
         "V*(pi/pi)", "(x > -1e9) * V", "V*(1 == 1)", "V*int(1.2)", "V*log(exp(1))"]
# Not formulas, or of no single finite value, wherever they stand.
SYNTAX = ["-0,02", "0,02 * t", "1,5", "-0,02 + 0*x", "0,0626 - x^2", "1.234,5", "x, y", "-0.02, 1",
          "x = 3", "t = 1", "a = -0.02", "V + (x = 1)", "x = y = 0", "pi = 3", "x += 1",
          "rand()", "rand_seed(1)", "V*(1 + 0*rand())", "V + 0*rand_seed(2)", "V*u", "sinn(x)",
          "V*pie", "T*0 + V", "z + V", "xx", "V*velocity", "f(x)", "x(1)", "t1", "V*X",
          "(V", "V)", "((V)", "V*", "*V", "V + * 2", "V V", "2 x", "V; 1", "V y", "'V'", '"V"',
          "V*()", "sin()", "sin(x, y)", "if(x, 1)", "−0.02", "1·5", "１", "V°", "V m/s", "V$", "V@",
          "[V]", "{V}", "V ? 1 :", "0x", "1e", "V..2", "1.2.3", "V!", "~V", "V\\2", "none free"]
INFINITE = ["sqrt(-1)", "0/0", "1/0", "-1/0", "log(-1)", "log(0)", "V/(x - x)", "V/(1 - 1)",
            "sqrt(-1 - x^2)", "asin(2)", "acos(-2)", "exp(1000)", "1e300*1e300", "acosh(0)",
            "V + 0*sqrt(-2)", "V*(0/0)", "V/(t - t)", "(-8)^0.5", "tan(pi/2)*1e300*1e300", "nan",
            "inf", "-inf", "1e400"]
LATER = ["if(t > 0.015, 0/0, V)", "if(t < 0.015, V, log(-t))", "V*sqrt(0.015 - t)"]


def formulas_case(rng, tools, folder):
    """A formula that has the value of a number, or one that means nothing."""
    what = rng.random()
    if what < 0.35:
        scene, beside, path, value = rng.choice(KNOWN)
        knows_time = path not in ("Geometry/Where", "Initial velocity/Velocity x")
        equal = [text for text in EQUAL if knows_time or "t" not in
                 text.replace("int", "").replace("sqrt", "")]
        text = rng.choice(equal)
        if rng.random() < 0.3:
            text = rng.choice(equal).replace("V", f"({text})", 1)
        text = text.replace("V", f"({value!r})")
        return set_values(rng, folder, scene, {**beside, path: text}, f"{path} = {text}",
                          like=(scene, {**beside, path: f"{value!r}"}))
    # Any parameter that is a formula by its documentation, whether the run uses it or not.
    places = [(scene, {}, path, parameters[path]) for scene, parameters in
              tools.parameters.items() for path in parameters if is_formula(tools, scene, path)]
    scene, beside, path, value = (rng.choice(KNOWN) if rng.random() < 0.7 else
                                  rng.choice(places))
    text = rng.choice(SYNTAX if rng.random() < 0.7 else INFINITE)
    if path.endswith(("footing/Velocity y", "Traction y")) and rng.random() < 0.1:
        text = rng.choice(LATER)  # the run fails, which is said
    if rng.random() < 0.2 and "," not in text and "=" not in text:
        text = rng.choice(["1*({})", "({}) + 0*x", "0*y + {}", "  {}  ", "-({})"]).format(text)
    text = text.replace("V", f"({value if is_number(str(value)) else 1})")
    return set_values(rng, folder, scene, {**beside, path: text}, f"{path} = {text}",
                      nonsense=path)


def is_formula(tools, scene, path):
    """Whether a parameter is a formula by what is said of it."""
    return "ormula in" in tools.comments[SCENES[scene].program].get(last_step(path), "")


# Names.

LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
RENAMED = {"fem": ("Boundary conditions/footing", "Materials/soil", "Loading/push"),
           "mpm_footing": ("Boundary conditions/footing", "Materials/soil", "Loading/push"),
           "explicit": ("Boundary conditions/floor", "Materials/sand", "Loading/fall"),
           "clay": ("Path/compression",)}


def titles_case(rng, tools, folder):
    """A section with another name, of signs that are allowed or not."""
    scene = rng.choice(list(RENAMED))
    path = rng.choice(RENAMED[scene])
    section, old = path.split("/")
    right = rng.random() < 0.6
    n = rng.choice((1, 2, 3, 5, 12, 30, 60))
    name = "".join(rng.choice(LETTERS + "__- ") for _ in range(n)).strip()
    name = rng.choice(LETTERS[:52]) + name[1:-1] + rng.choice(LETTERS) if n > 1 else "q"
    if not right:
        i = rng.randrange(len(name))
        sign = rng.choice([".", "/", "'", '"', "\\", "\x01", "\x7f", ",", "\x1b[31m"])
        name = rng.choice([name[:i] + sign + "zz" + name[i:], name + "z" * 100])
    write_scene(folder, scene)
    text = rename(folder, section, old, name)
    call = Call(SCENES[scene].program, ["scene.prm", "--quiet"],
                f"{scene}: {path} is named {name!r}: {text}")
    return call._replace(like=(scene, {})) if right else call._replace(wrong=name)


def rename(folder, section, old, name):
    """Gives a section of a scene another name, wherever that stands."""
    count = 0
    for file in (folder / "given.prm", folder / "scene.prm"):
        out, depth, inside = [], 0, False
        for line in file.read_text().splitlines():
            words = line.strip().split(None, 1)
            head, rest = (words + ["", ""])[:2]
            if head == "subsection":
                inside = rest == section if depth == 0 else inside
                if depth == 1 and inside and rest == old:
                    line, count = f"subsection {name}", count + 1
                depth += 1
            elif head == "end":
                depth -= 1
            elif head == "set":
                key, _, value = rest.partition("=")
                is_list = depth == 1 and inside and key.strip() in ("Names", "Stages")
                if is_list or key.strip() == "Conditions":
                    names = [name if part.strip() == old else part.strip()
                             for part in value.split(",")]
                    line = f"set {key.strip()} = {', '.join(names)}"
            out.append(line)
        file.write_text("\n".join(out) + "\n")
    return f"{count} sections"


# One scene, described in two ways.

def box_mesh(folder, nx, ny, width, depth):
    """Writes a mesh of quadrilaterals of the box 0, -depth; width, 0 as mesh.msh, whose
    curves are called bottom, right, top, left, in any order of its nodes."""
    nodes = [(width * i / nx, -depth + depth * j / ny) for j in range(ny + 1)
             for i in range(nx + 1)]

    def node(i, j):
        return j * (nx + 1) + i + 1
    curves = {1: [(node(i, 0), node(i + 1, 0)) for i in range(nx)],
              2: [(node(nx, j), node(nx, j + 1)) for j in range(ny)],
              3: [(node(i, ny), node(i + 1, ny)) for i in range(nx)],
              4: [(node(0, j), node(0, j + 1)) for j in range(ny)]}
    elements = [(1, 2, tag, tag, *line) for tag, lines in curves.items() for line in lines]
    elements += [(3, 2, 5, 1, node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1))
                 for j in range(ny) for i in range(nx)]
    names = ["bottom", "right", "top", "left"]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "5",
             *(f'1 {i + 1} "{name}"' for i, name in enumerate(names)), '2 5 "body"',
             "$EndPhysicalNames", "$Nodes", len(nodes),
             *(f"{i + 1} {x:.17g} {y:.17g} 0" for i, (x, y) in enumerate(nodes)), "$EndNodes",
             "$Elements", len(elements),
             *(" ".join(map(str, (i + 1, *element))) for i, element in enumerate(elements)),
             "$EndElements"]
    (folder / "mesh.msh").write_text("\n".join(map(str, lines)) + "\n")


def descriptions_case(rng, tools, folder):
    """A scene, described in two ways that mean the same."""
    scene = rng.choice(("fem", "fem", "mpm", "mpm_footing"))
    phi = rng.choice((20, 25, 30))
    theta = rng.choice((phi, phi / 2, 8, 5, 2, 0))
    soil = {"Materials/soil/Friction angle": f"{phi}", "Materials/soil/Dilatancy angle": f"{theta}"}
    if scene == "fem":
        soil |= {"Discretisation/Element": rng.choice(("Q1", "Q2")), "Mesh/Type": "uniform",
                 "Mesh/Cells": "quadrilaterals", "Mesh/Cell size": "0.1",
                 "Geometry/Box": "0, -0.4; 0.8, 0", "Observation/Reference": "none"}
        box_mesh(folder, 8, 4, 0.8, 0.4)
        footing, sides = "Boundary conditions/footing", "Boundary conditions/sides"
        one, other = rng.choice([
            ({}, {"Geometry/Shape": "file", "Geometry/File": "mesh.msh"}),
            ({f"{footing}/Box": "0, -0.1; 0.2, 0.1"},
             {f"{footing}/Box": "", f"{footing}/Where": "0.2000000001 - x"}),
            ({f"{footing}/Box": "0, -0.1; 0.2, 0.1"},
             {f"{footing}/Box": "", f"{footing}/Where": "(x < 0.2000000001) - 0.5"}),
            ({f"{footing}/Velocity y": "-0.02"}, {f"{footing}/Velocity y": "-0.02 + 0*x"}),
            ({f"{footing}/Velocity y": "-0.02"}, {f"{footing}/Velocity y": "record v.csv"}),
            ({}, {f"{sides}/Where": "1"}),
            ({f"{sides}/Sides": "left, right"}, {f"{sides}/Sides": "right, left"}),
            ({}, {"Boundary conditions/Names": "footing, sides, bottom"})])
        if "record v.csv" in other.values():
            (folder / "v.csv").write_text("t,v\n0,-0.02\n10,-0.02\n")
    elif scene == "mpm":
        one, other = rng.choice([
            ({}, {"Geometry/Where": "1"}), ({}, {"Geometry/Where": "3 - x"}),
            ({"Geometry/Shape": "box"}, {"Geometry/Shape": "polygon",
                                         "Geometry/Polygon": "0, 0; 1, 0; 1, 2; 0, 2"}),
            ({}, {"Boundary conditions/Names": "sides, bottom"})])
    else:
        one, other = rng.choice([
            ({}, {"Boundary conditions/footing/Velocity y": "-0.02*(1 + 0*t)"}),
            ({}, {"Geometry/Where": "1 + x^2"})])
    if rng.random() < 0.5:
        one, other = other, one
    return set_values(rng, folder, scene, {**soil, **one},
                      f"theta = {theta}, {one} as {other}", like=(scene, {**soil, **other}))


# Studies.

BASE = """title = "x"
text = "y"
[defaults]
set = ["Output/Fields = false"]
time_limit = 900
[[group]]
name = "cells"
file = "scene.prm"
set = ["Output/Pictures = false"]
ranks = 1
repeat = 2
alone = false
[group.vary]
"Mesh/Cell size" = [0.25, 0.5]
kind = {"a" = ["Mesh/Type = uniform"], "b" = []}
size = {values = [1, 2], set = ["Mesh/Cell size = {}"]}
[group.check]
value = "limit_load/value"
reference = 2.0
low = -0.1
high = 0.1
[[section]]
title = "s"
text = "t"
[[section.table]]
kind = "validation.table"
groups = ["cells"]
[[section.figure]]
kind = "speed.work_precision"
x = "error"
"""
TOML = ["1e20", "99999999999999999999", "-1", "0", "nan", "inf", "true", "''", "'..'", "'a/../../b'",
        "[]", "{}", "[[1]]", "{a = 1}", "1979-05-27", "'scene.prm'", "'/dev/zero'", "'.'",
        "'x' * 3", '"\\u0000"', '"a\\nb"', "[1, 'a']", "{values = [], set = []}", "'{phi/0}'",
        "['{x/0} = 1']", "0.5", "'漢'", f"'$(touch {MARKER})'", "'<script>alert(1)</script>'"]


def studies_case(rng, tools, folder):
    """A study file that is damaged, or has a value of another kind."""
    write_scene(folder, "fem")
    text, name = BASE, "study.toml"
    if rng.random() < 0.4:
        source = rng.choice(sorted((ROOT / "studies").glob("*.toml")))
        text = source.read_text().replace('"../prm', f'"{ROOT}/prm')
    what = rng.random()
    if what < 0.5:
        lines = text.splitlines()
        i = rng.choice([i for i, line in enumerate(lines) if " = " in line])
        key, value = lines[i].split(" = ", 1)[0], rng.choice(TOML)
        lines[i] = f"{key} = {value}"
        text, said = "\n".join(lines) + "\n", f"line {i + 1}: {lines[i]}"
    elif what < 0.6:
        name = rng.choice(["...toml", ".toml", "a b.toml", "漢.toml", "x", "-x.toml", "a\nb.toml",
                           "'; touch " + MARKER + "; '.toml", "a" * 240 + ".toml", "..a.toml"])
        said = f"named {name!r}"
    elif what < 0.7:
        said = "its parameter file is damaged"
        said += ", " + fuzz_files.damage(rng, folder / rng.choice(("scene.prm", "given.prm")))
        text = BASE
    else:
        (folder / name).write_text(text)
        said = fuzz_files.damage(rng, folder / name)
        text = None
    if text is not None:
        (folder / name).write_text(text)
    options = (["--list"] if rng.random() < 0.9 else
               ["--output", "results", "--program", "/bin/true"])
    return Call("study", [f"./{name}", *options], said)


# Foreign files, links.

NAMES = ["notes.txt", "report.html", "points.pvd", "cells.pvd", "points-0000.vtu", "points-9.h5",
         "newton.png", "files.txt", "files.txt.part", "parameters.prm", "parameters.prm.part",
         "summary.json", "summary.json.part", "log.txt", "log.txt.part", "statistics.csv",
         "statistics.csv.part", "newton.csv", "points-0000.vtu.part", "points.pvd.part",
         "report.html.part", "load_displacement.png", "load_displacement.png.part",
         "checkpoint-000001.h5", "checkpoint-9.h5", "checkpoint-999999.h5",
         "checkpoint-000001.h5.part", "paraview_state.py", "paraview_state.py.part", "lock", ".lock"]


def foreign_case(rng, tools, folder):
    """Files of somebody else, or links to them, in the folder of a run; each stays as it is."""
    out = folder / "results/out"
    elsewhere = folder.parent / "elsewhere"
    (elsewhere / "sub").mkdir(parents=True)
    for name in ("data", "sub/data"):
        (elsewhere / name).write_text("foreign\n")
    source = rng.choice(("none", "results-fem", "results-stopped"))
    listed = set()
    if source != "none":
        shutil.copytree(tools.results.with_name(source), out, symlinks=True)
        listed = set((out / "files.txt").read_text().splitlines()) | {"files.txt"}
    else:
        out.mkdir(parents=True)
    said = []
    for _ in range(rng.choice((1, 1, 2, 3))):
        name = rng.choice(NAMES + sorted(listed))
        path, how = out / name, rng.choice(("file", "link", "link", "dangling", "folder"))
        if (name, how) == ("files.txt", "file"):  # is what says that a run has been there
            continue
        if path.is_symlink() or path.exists():
            if how != "link" or path.is_dir() or path.is_symlink():
                continue
            path.unlink()
        if how == "file":
            path.write_text("foreign\n")
        elif how == "folder":
            path.mkdir()
            (path / "data").write_text("foreign\n")
        else:
            path.symlink_to(elsewhere / ("new" if how == "dangling" else "data"))
        said.append(f"{name}: {how}")
    if rng.random() < 0.2:  # the folder itself by a link
        shutil.move(out, elsewhere / "out")
        out.symlink_to(elsewhere / "out")
        said.append("the folder is a link")
    if rng.random() < 0.2 and (out / "files.txt").is_file():
        with open(out / "files.txt", "a") as file:
            file.write("../../../elsewhere/data\n" + f"{elsewhere}/data\n..\n.\n\n")
        said.append("its list names files elsewhere")
    write_scene(folder, "fem", {"Output/Fields": "true", "Loading/push/Output every": "1",
                                "Checkpoint/Every steps": rng.choice(("0", "1"))})
    how = rng.choice(("overwrite", "overwrite", "overwrite", "number", "refuse", "resume", "plot",
                      "defaults"))
    # What a run before has written is its own, if it is a file, and so is what has the name
    # of its temporary file; pictures have other names than those of the run's list.
    kept = tuple(str(path.relative_to(folder.parent.parent)) for path in
                 sorted([*elsewhere.rglob("*"), *out.rglob("*")])
                 if "elsewhere/out" not in str(path) and
                 (path.name.removesuffix(".part") not in listed or path.parent == elsewhere or
                  how in ("number", "refuse")) and not path.is_dir() and
                 not (how == "plot" and path.suffix == ".part"))
    said = f"{how}, {source}, {', '.join(said)}"
    if how == "resume":
        return Call("geocone", ["--resume", "results/out", "--quiet"], said, kept=kept)
    if how == "plot":
        return Call("plot", ["results/out"], said, kept=kept)
    if how == "defaults":
        name = rng.choice(["results/out/notes.txt", "results/out/parameters.prm", "scene.prm",
                           "../elsewhere/data"])
        there = (folder / name).exists() or (folder / name).is_symlink()
        path = str((folder / name).relative_to(folder.parent.parent))
        return Call("geocone", ["--defaults", name], f"{said}, {name}",
                    kept=(*kept, *([path] if there else ())), wrong=name if there else "")
    return Call("geocone", ["scene.prm", "--quiet", "--output", "results/out", "--set",
                            f"Output/If folder exists = {how}"], said, kept=kept)


# Two runs and one folder.

def twins_case(rng, tools, folder):
    """Two runs without end that want one folder at once."""
    how = rng.choice(("overwrite", "overwrite", "refuse", "number", "automatic", "resume"))
    endless = {"Loading/push/Duration": "1e6"}
    write_scene(folder, "fem", endless)
    if how == "resume":
        shutil.copytree(tools.results.with_name("results-stopped"), folder / "results/out")
        return Call("geocone", ["--resume", "results/out", "--quiet"], how, twins=1)
    if rng.random() < 0.5 and how in ("overwrite", "number"):
        shutil.copytree(tools.results, folder / "results/out")
    return Call("geocone", ["scene.prm", "--quiet", "--output", "results/out", "--set",
                            f"Output/If folder exists = {how}"], how,
                twins=2 if how == "number" else 1)


# What must be the same.

def loads(path):
    """The loads of all steps of a run, a list for each of their columns."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]
            if name.startswith(("load", "external work", "kinetic energy", "mean stress",
                                "p (", "q ("))}


def difference(one, other):
    """In what the loads of two runs differ, in words; nothing if they do not."""
    for name, values in one.items():
        if len(values) != len(other[name]):
            return f"{len(values)} and {len(other[name])} steps"
        size = max(map(abs, values + other[name]), default=0.)
        worst = max(abs(a - b) for a, b in zip(values, other[name]))
        if worst > 1e-6 * size + 1e-9:
            return f"{name} = {values[-1]:.8g} and {other[name][-1]:.8g}"
    return ""


KNOWN_CASES = {"formulas": formulas_case, "titles": titles_case,
               "descriptions": descriptions_case, "studies": studies_case,
               "foreign": foreign_case, "twins": twins_case}
