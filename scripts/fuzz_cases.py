# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cases of scripts/fuzz: scenes, and what is wrong or unusual in each case.

A case is made from a random.Random alone, so that the same seed gives the same case.
"""

import math
import re
import shutil
from collections import namedtuple
from pathlib import Path

import fuzz_files
from fuzz_files import MARKER

TESTS = Path(__file__).resolve().parent.parent / "tests"

# Scenes: the program, a file of tests/, settings that make it short, further files.
Scene = namedtuple("Scene", "program file settings files", defaults=[()])
SCENES = {
    "fem": Scene("geocone", "footing_coarse.prm", {
        "Mesh/Cell size": "0.2", "Loading/push/Duration": "0.04",
        "Output/Fields": "true"}),
    "fem_unstructured": Scene("geocone", "fem/footing-unstructured-01.prm", {
        "Mesh/Smallest size": "0.05", "Loading/push/Duration": "0.04"}),
    "fem_mesh": Scene("geocone", "fem/plate-msh-01.prm", {
        "Geometry/File": "mesh.msh"}, ("mesh.msh",)),
    "mpm": Scene("geocone", "mpm/column-collapse-01.prm", {
        "Loading/fall/Duration": "0.1", "Output/Fields": "true"}),
    "mpm_footing": Scene("geocone", "mpm/footing-segments-01.prm", {
        "Mesh/Cell size": "0.2", "Loading/push/Duration": "0.04"}),
    "mpm_file": Scene("geocone", "parameters/mpm.prm", {
        "Geometry/Box": "0, 0; 0.8, 0.6", "Particles/Layout": "file",
        "Particles/File": "points.csv", "Boundary conditions/footing/Box":
        "0.3, 0.5; 0.5, 1", "Materials/soil/Density": "2000"}, ("points.csv",)),
    "explicit": Scene("geocone", "explicit/collapse.prm", {
        "Loading/fall/Duration": "0.02", "Loading/fall/Step size": "0.01",
        "Output/Fields": "true"}),
    "explicit_cut": Scene("geocone", "explicit/cut-02.prm", {
        "Mesh/Cell size": "0.5", "Loading/settle/Duration": "0.05",
        "Loading/settle/Step size": "0.05", "Loading/cut/Duration": "0.1",
        "Loading/settle/Largest unbalanced force": "1e9",
        "Loading/settle/Largest kinetic energy": "1e9",
        "Loading/cut/Removal duration": "0.05"}),
    "clay": Scene("element_test", "element/cam_clay-01.prm", {
        "Path/consolidation/Increments": "3", "Path/compression/Increments": "3"}),
    "sand": Scene("element_test", "element/biaxial_mohr_coulomb-01.prm", {
        f"Path/{stage}/Increments": "2" for stage in ("elastic", "compression", "flow",
                                                      "extension")})}
SPEAKS = {"Output/Expectations": "", "Output/Report for tests": "none",
          "Output/Pictures": "false"}

# Files that are read: how one that is whole is made, and what reads it.
FROZEN = "frozen/mpm_spline2_half_cold.h5"
FILES = {"prm": ("scene.prm", None), "msh-2.2": ("mesh.msh", "fem_mesh"),
         "msh-2.2-binary": ("mesh.msh", "fem_mesh"), "msh-4.1": ("mesh.msh", "fem_mesh"),
         "msh-4.1-binary": ("mesh.msh", "fem_mesh"), "csv": ("points.csv", "mpm_file"),
         "h5": ("points.h5", "mpm_file"), "frozen": ("frozen.h5", None),
         "dat": ("problem.dat", None), "results": ("results", None)}

# What no parameter can mean but one that is any text.
NONSENSE = ["nonsense", "30+", "1 2 3 x", "true false", "漢字🙂", "３０", "%s%n%d", "{}",
            f"'; touch {MARKER}; '", f'"; touch {MARKER}; "', f"$(touch {MARKER})",
            f"`touch {MARKER}`", f"| touch {MARKER}", "<script>alert(1)</script>",
            "\x01\x02\x1b[31m", "=", "\\", "(" * 2000, "a" * 5000, "nan"]
HOSTILE = ["inf", "-inf", "1e308", "-1e308", "1e400", "-1", "-0", "0", "1e-300", "30+t",
           "", "1, 2", "1; 2", "1, 2, 3, 4, 5, 6, 7, 8, 9", "1, 2; 3, 4; 5", ";;;,,,",
           "2147483647", "2147483648", "4294967295", "4294967296", "9223372036854775808",
           "18446744073709551616", "65536", "1e9", "0x10", "TRUE", "yes", "sin(", "1/0",
           "sqrt(-1)", "log(0)", "x*y*t", "1e", "1.5.2", "1,5", "#", ".", "..",
           "../up", "/dev/null/x", "/dev/zero", "/dev/null", "scene.prm", "~",
           "a/b", "b" * 300, "$x_1^2$ \\frac", "x\r", "x y.z&w", "no \udcff UTF-8"]
WORDS = ["none", "automatic", "all", "left", "top", "0", "one two", "a/b", "é", "a'b",
         "n" * 3000, "<b>", "$a_b$", f"$(touch {MARKER})", "%d", "end", "subsection",
         "..", "Names", "parameters.prm"]

# nonsense: a parameter that has it; missing: sections; wrong: what must be refused; like:
# the scene and the settings of a run with the same loads; kept: what must stay as it is, by
# its path in the folder of the case; twins: the call is made twice at once, and so many of
# the two may run.
Call = namedtuple("Call", "program arguments text nonsense missing wrong like kept twins",
                  defaults=[None, (), "", None, (), 0])
# Scenes and their parameters.

def flatten(path):
    """The lines of a parameter file with those that it includes."""
    for line in path.read_text().splitlines():
        words = line.split()
        if len(words) == 2 and words[0] == "include":
            yield from flatten(path.parent / words[1])
        else:
            yield line


def setting_lines(settings):
    """Settings by their paths as lines of a parameter file."""
    for path, value in settings.items():
        *sections, name = path.split("/")
        yield from (f"subsection {section}" for section in sections)
        yield f"set {name} = {value}"
        yield from ["end"] * len(sections)


def read_parameters(path):
    """The values of a parameter file by their paths, and what is said before each."""
    values, comments, sections, said = {}, {}, [], []
    for line in path.read_text(errors="replace").splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "subsection":
            sections.append(rest)
        elif word == "end":
            sections.pop()
        elif word == "set":
            name, _, value = rest.partition("=")
            key = "/".join([*sections, name.strip()])
            values[key], comments[key] = value.split("#")[0].strip(), " ".join(said)
        said = [*said, rest] if word == "#" else []
    return values, comments


def choices(comment):
    """The choices that a comment tells as 'a (why) | b | c.'."""
    text = re.sub(r"\([^()]*\)", "", comment)
    if "|" not in text:
        return []
    first, *others = text.split("|")
    words = [first.rsplit(":", 1)[-1].rsplit(". ", 1)[-1],
             *(re.split(r"[.,:;]", other)[0] for other in others)]
    return [word.strip() for word in words if 0 < len(word.strip()) < 40]


def is_number(text):
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def last_step(path):
    """The part of a parameter's path by which its kind is told, whatever its names."""
    parts = path.split("/")
    return parts[0], parts[-1]


def write_scene(folder, name, further=None):
    """Writes scene.prm, the file of the tests that it includes, and the files that it
    names."""
    scene = SCENES[name]
    text = "\n".join(flatten(TESTS / scene.file)) + "\n"
    (folder / "given.prm").write_text(text)
    settings = {**scene.settings, **SPEAKS, **(further or {})}
    (folder / "scene.prm").write_text(
        "\n".join(["include given.prm", *setting_lines(settings)]) + "\n",
        errors="surrogateescape")
    for file in scene.files:
        write_whole_file(folder / file, "msh-2.2" if file.endswith("msh") else "csv")


def write_whole_file(path, kind):
    """Writes a file of a kind that is as it should be."""
    if kind.startswith("msh"):
        text = (TESTS / "fem/two_squares.msh").read_text()
        path.write_bytes(fuzz_files.mesh_file(text, kind[4:7], kind.endswith("binary")))
    elif kind in ("csv", "h5"):
        fuzz_files.particles(path)
    else:
        shutil.copy(TESTS / {"frozen": FROZEN,
                             "dat": "frozen/plasticity_2d_footing_10.dat"}[kind], path)


# Cases: each writes its files into a folder and returns the call.

def set_values(rng, folder, scene, values, text, **more):
    """A case of a scene with some values, given by options or in the file."""
    in_file = rng.random() < 0.5 and not any("\n" in v for v in values.values())
    write_scene(folder, scene, values if in_file else None)
    options = [] if in_file else [word for path, value in values.items()
                                  for word in ("--set", f"{path} = {value}")]
    return Call(SCENES[scene].program, ["scene.prm", *options, "--quiet"],
                f"{scene}: {text}", **more)


def values_case(rng, tools, folder):
    """A parameter, the output folder or the file's name with a hostile value."""
    scene = rng.choice(list(SCENES))
    nonsense = rng.random() < 0.4
    value = rng.choice(NONSENSE if nonsense else HOSTILE)
    what = rng.random()
    if what < 0.04:  # the call
        write_scene(folder, scene)
        arguments = rng.choice([
            ["scene.prm", "--output", value], ["scene.prm", "--set", value],
            ["scene.prm", value], [value], ["--" + value[:100], "scene.prm"],
            ["scene.prm", "--set"], ["--replay", value], ["--replay", "scene.prm"],
            ["scene.prm", "--set", "Materials/" + value + " = 1"],
            ["scene.prm", "--set", value + "/" + value + " = 1"]])
        return Call(SCENES[scene].program, [*arguments, "--quiet"], f"{scene}: the call")
    if what < 0.08:  # names that come into file names and pictures
        value = value.replace("/", "_")[:200] or "x"
        write_scene(folder, scene, {"Output/Pictures": rng.choice(("true", "false"))})
        shutil.copy(folder / "scene.prm", folder / (value + ".prm"))
        if rng.random() < 0.5:
            return Call(SCENES[scene].program,
                        ["./" + value + ".prm", "--quiet"], f"{scene}: file {value!r}")
        return Call(SCENES[scene].program, ["scene.prm", "--quiet", "--output", value],
                    f"{scene}: --output {value!r}")
    path = rng.choice(list(tools.parameters[scene]))
    old = tools.parameters[scene][path]
    if rng.random() < 0.2:
        nonsense = False
        number = float(old) if is_number(old) else 1.
        value = rng.choice([
            old + "x", old[:-1], old.upper(), old + " " + old, old + ", " + old,
            "\ufeff" + old, old + "\nset Nothing = 1", f"{-number:g}",
            f"{number * 1e6:g}", f"{number * 1e-6:g}", f"{number + 0.5:g}"])
    # A word, or a number that is none, can only be meant where any text is allowed.
    kind = is_number(old) or old in ("true", "false") or tools.choices(scene, path)
    return set_values(rng, folder, scene, {path: value}, f"{path} = {value[:60]!r}",
                      nonsense=path if nonsense and kind else None)


def pairs_case(rng, tools, folder):
    """Two parameters with legal values."""
    scene = rng.choice(list(SCENES))
    values = {}
    while len(values) < 2:
        path = rng.choice(list(tools.parameters[scene]))
        old, several = tools.parameters[scene][path], tools.choices(scene, path)
        if several:
            values[path] = rng.choice(several)
        elif old in ("true", "false"):
            values[path] = rng.choice(("true", "false"))
        elif re.fullmatch(r"\d+", old):
            values[path] = str(rng.choice((0, 1, 2, 3, int(old) + 1)))
        elif is_number(old):
            values[path] = f"{rng.choice((0., 0.5, 0.9, 1.1, 2., -1.)) * float(old):g}"
    return set_values(rng, folder, scene, values,
                      ", ".join(f"{path} = {value}" for path, value in values.items()))


def names_case(rng, tools, folder):
    """A random list of names against the sections that are there."""
    scene = rng.choice(list(SCENES))
    known = tools.parameters[scene]
    path = rng.choice([path for path in known
                       if path.count("/") == 1 and path.endswith(("/Names", "/Stages"))])
    section = path.split("/")[0]
    there = [name.strip() for name in known[path].split(",") if name.strip()]
    names = list(there)
    for _ in range(rng.choice((1, 1, 2, 3))):
        i = rng.randrange(len(names) + 1)
        word = rng.choice(there or WORDS)
        change = rng.choice(("insert", "remove", "twice", "case", "misspelt", "word"))
        if change == "remove":
            del names[i:i + 1]
            continue
        names.insert(i, {"insert": "", "twice": word, "case": word.swapcase(),
                         "misspelt": word[:-1] + "x"}.get(change, rng.choice(WORDS)))
    value = ", ".join(names)
    pictures = rng.random() < 0.03
    further = {path: value, **({"Output/Pictures": "true"} if pictures else {})}
    missing = {name for name in names if name.strip()} - set(there)
    if rng.random() < 0.3:  # with sections of their own
        title = next((key for key in known if there and
                      key.startswith(f"{section}/{there[0]}/")), None)
        if title:
            further.update({f"{section}/{name}/{title.split('/', 2)[2]}": known[title]
                            for name in missing if "/" not in name})
            missing = {name for name in missing if "/" in name}
    return set_values(rng, folder, scene, further, f"{path} = {value[:80]!r}",
                      missing=tuple(sorted(missing)))


def files_case(rng, tools, folder, kind):
    """A damaged file of a kind."""
    name, scene = FILES[kind]
    if kind == "prm":
        scene = rng.choice(list(SCENES))
        write_scene(folder, scene)
        what = fuzz_files.damage(rng, folder / rng.choice(("scene.prm", "given.prm")))
        return Call(SCENES[scene].program, ["scene.prm", "--quiet"], f"{scene}, {what}")
    if kind == "results":
        source = tools.results.with_name(rng.choice(("results-fem", "results-element")))
        shutil.copytree(source, folder / name)
        files = sorted(path for path in (folder / name).iterdir()
                       if path.suffix in (".csv", ".json", ".vtu", ".pvd", ".prm"))
        what = fuzz_files.damage(rng, rng.choice(files))
        return Call("plot", [name], f"{source.name}, {what}")
    write_whole_file(folder / name, kind)
    if scene is None:
        what = fuzz_files.damage(rng, folder / name)
        return Call("geocone-lab", [name, "--output", "results", "--quiet"], what)
    write_scene(folder, scene, {"Particles/File": name} if name == "points.h5" else None)
    write_whole_file(folder / name, kind)
    what = fuzz_files.damage(rng, folder / name)
    return Call("geocone", ["scene.prm", "--quiet"], what)


CASES = {"values": values_case, "pairs": pairs_case, "names": names_case}


