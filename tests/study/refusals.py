# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each wrong study file is a StudyError that names the place, the key and its value."""

import os
from pathlib import Path

from geocone.report.schema import StudyError
from geocone.report.study_file import read_study

GROUP = '[[group]]\nname = "a"\nfile = "footing.prm"\n'
SECTION = '[[section]]\ntitle = "x"\n'
FIGURE = GROUP + SECTION + "[[section.figure]]\n"
PHI = "[group.vary]\nphi = {values = [20], set = ['Materials/soil/%s angle = {phi/%s}']}\n"


def refused(what, text, name="study.toml"):
    """Looks for a text in the message about a study file."""
    Path(name).write_text(text)
    try:
        read_study(name)
    except StudyError as problem:
        message = str(problem)
        assert what in message, (what, message)
        lines = message.splitlines()
        assert len(lines) == 3 and name in lines[0], message
        assert lines[1].startswith("  allowed: ") and lines[2].startswith("  remedy:  "), message
    else:
        raise AssertionError(f"accepted: {text}")


def accepted(text, name="study.toml"):
    """The study of a text."""
    Path(name).write_text(text)
    return read_study(name)


# What is missing, or not known.
refused("there is no [[group]] of runs", "title = 'none'\n")
refused("write 'title' instead", "titel = 'x'\n" + GROUP)
refused("the group 'a': unknown key 'fiel'", GROUP + "fiel = 'x'\n")
refused("the group 'a': there is no 'file'", "[[group]]\nname = 'a'\n")
refused("there is no 'name'", "[[group]]\nfile = 'footing.prm'\n")
refused("the group 'a': file = 'none.prm'", GROUP.replace("footing", "none"))
refused("two runs are named 'a'", GROUP + GROUP)
refused("unknown group 'b'", FIGURE + "kind = 'speed.orders'\ngroups = ['b']\n")
refused("is no TOML file", GROUP + "name =\n")
refused("is no TOML file", "x = " + "[" * 5000)

# Values of the wrong kind, of all keys.
for key, value in {
        "title": "1", "text": "[]", "defaults": "1", "group": "{}", "section": "'x'"}.items():
    refused(f"the study: {key} = ", f"{key} = {value}\n" + ("" if key == "group" else GROUP))
for key, values in {
        "name": ["1", "''", "'..'", "'.a'", r'"a\nb"', f"'{'a' * 101}'", "'漢字'", "'_'"],
        "file": ["1", "''", "'.'", r'"\u0000"', "'/dev/zero'", f"'{'a' * 999}'"],
        "set": ["'a = b'", "[1]", "['Mesh/Cell size']", r'["a = \u0000"]', "['= 1']",
                f"['a = {'b' * 1000}']"],
        "vary": ["[]", "{'Mesh/Cell size' = []}", "{'' = [1]}", "{x = [[1]]}", "{x = {}}",
                 "{x = {a = 1}}", "{x = {values = [1], set = ['a = b']}}", "{x = [nan]}",
                 "{x = [1979-05-27]}", "{repetition = [1]}"],
        "ranks": ["0", "'1'", "true", "1.5", "1000000"],
        "alone": ["1", "'true'"],
        "repeat": ["0", "1e20", "99999999999999999999", "true", "inf"],
        "time_limit": ["nan", "inf", "1e20", "0", "'1'"],
        "check": ["1", "{value = 1}", "{low = 0.1}", "{status = 'x'}", "{valu = 'x'}",
                  "{value = 'x', low = 1, high = 0}", "{value = 'x', low = nan}",
                  "{value = 'x', reference = {20 = 'x'}}", "{value = 'x', reference = {20 = 1}}",
                  "{value = 'x', reference = {20 = 1}, by = 'x'}", "{published = {20 = []}}",
                  "{published = [[1, 'guess', 'x']]}", "{published = [['1,4', 'exact', 'x']]}",
                  "{published = [], divisor = 0}"]}.items():
    for value in values:
        base = "".join(line + "\n" for line in GROUP.splitlines() if not line.startswith(key))
        refused("the group 'a': " * (key != "name") + ("check" if key == "check" else key),
                base + f"{key} = {value}\n")
refused("defaults: unknown key 'check'", "[defaults]\ncheck = {}\n" + GROUP)
refused("the section 'x': figure = 1", GROUP + SECTION + "figure = 1\n")
refused("there is no 'kind'", FIGURE + "groups = ['a']\n")
for options in ("kind = 1", "kind = 'bounds.gaps'\ntolerance = 'x'",
                "kind = 'bounds.gaps'\ntoleranc = 0.1", "kind = 'figures.columns'",
                "kind = 'figures.columns'\ncolumns = ['size/dofs']",
                "kind = 'verification.table'\ncolumns = ['none']",
                "kind = 'paper.rates'\nview = [0, 1]", "kind = 'figures.columns'\ngroups = 'a'"):
    refused("the section 'x'", FIGURE + options + "\n")
# Only what makes figures and tables can be named.
for kind in ("speed.none", "none.table", "figures.np", "study.os", "runs.write_csv", "page.find",
             "schema.takes", "figures.", ".columns", "", "..figures.columns", "figures.math.exp"):
    refused("unknown figure or table", FIGURE + f"kind = '{kind}'\n")

# Keys of tables are values of the axis.
VARIED = GROUP + "[group.vary]\nx = [1, 2.5]\n"
refused("'2,5' is no value of the axis 'x'", VARIED + "[group.check]\nby = 'x'\n"
        "published = {1 = [], '2,5' = []}\n")
refused("'3' is no value of the axis 'x'", VARIED + "[group.check]\nby = 'x'\nvalue = 'y'\n"
        "reference = {1 = 0, 3 = 0}\n")
accepted(VARIED + "[group.check]\nby = 'x'\n"
         "published = {1 = [['1.40', 'estimate', 'z']], '2.5' = []}\n")

# Settings with the values of axes.
refused("'{psi/2}' in the setting", GROUP + "set = ['Materials/soil/Dilatancy angle = {psi/2}']\n")
for divisor in ("0", ".", "1.2.3"):
    refused("in the setting", GROUP + PHI % ("Dilatancy", divisor))
settings = accepted(GROUP + PHI % ("Dilatancy", "2")).runs[0].settings
assert settings == ["Materials/soil/Dilatancy angle = 10"], settings
settings = accepted(GROUP + "[group.vary]\n'Output/Fields' = [true, false]\n").runs[1].settings
assert settings == ["Output/Fields = false"], settings

# How many runs there are is known before any is made.
refused("1000000 runs", GROUP + "repeat = 10000\nvary = {x = [%s]}\n" % ", ".join(
    map(str, range(100))))
refused("10000 runs", GROUP.replace("'a'", "'b'").replace('"a"', '"b"') + GROUP + "repeat = 10000\n")
refused("'vary' and 'repeat'", GROUP + "[group.vary]\n" + "".join(
    f"x{i} = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n" for i in range(300)))
assert len(accepted(GROUP + "repeat = 10000\n").runs) == 10000

# Names that no folder may have, and those that make one.
for name in ("a.json", "a.part"):
    refused("a run named", GROUP.replace('"a"', f'"{name}"'))
refused("a run named", GROUP + "[group.vary]\nx = ['" + "a" * 200 + "']\n")
for group, name in (("../x", None), ("a/../../b", "a_.._.._b"), ("theta < phi, H/20", "theta_phi_h_20"),
                    ("a..", "a"), ("~ x", "x"), ("wall_left", "wall_left")):
    text = GROUP.replace('"a"', f'"{group}"')
    if name is None:
        refused("name = '../x'", text)
    else:
        assert accepted(text).runs[0].name == name, accepted(text).runs[0].name
for name in ("...toml", ".toml", "漢.toml"):
    refused("its results would be named", GROUP, name)

# Files: study files and what they name.
for name, make in (("folder.toml", os.mkdir), ("pipe.toml", os.mkfifo),
                   ("loop.toml", lambda name: os.symlink(name, name))):
    make(name)
    try:
        read_study(name)
        raise AssertionError(name)
    except StudyError as problem:
        assert "is no file" in str(problem), problem
refused("is too large", "#" * (1 << 20) + "\n" + GROUP)
Path("itself.prm").write_text("include itself.prm\n")
Path("branches.prm").write_text("include branches.prm\n" * 2)
Path("wide.prm").write_text("include footing.prm\n" * 1001)
Path("device.prm").write_text("include /dev/zero\n")
Path("missing.prm").write_text("include none.prm\n")
for name, what in (("itself", "includes itself"), ("branches", "includes itself"),
                   ("wide", "more than 1000 files"), ("device", "is no file"),
                   ("missing", "is no file")):
    refused(what, GROUP.replace("footing", name))
