# Names with all signs that they may have, above all underscores, which the library
# replaces by numbers in its files: in all lists, in --set, in tables, in a parameter file
# that a run has written, after a restart, and for Python.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 - "$root" <<'PYTHON'
import json, sys
names = ["soft_clay", "wall_left", "_41", "a__20_b", "a b", "x+y (2)", "q*&|$!?@~^`%;<>[]{}", "böschung_ä",
         "x = 0", "a:b", "value", "default_value", "pattern_description", "documentation", "actions"]

def section(title, first, of_each, before="", prefix=""):
    """A list of names with a section for each."""
    return "\n".join([f"subsection {title}", f"  set {first} {', '.join(prefix + name for name in names)}", before,
                      *(f"  subsection {prefix}{name}\n    {of_each(i)}\n  end"
                        for i, name in enumerate(names)), "end\n"])

scene = [f"include {sys.argv[1]}/tests/footing_coarse.prm\n",
         section("Materials", "Names = soil,", lambda i: "set Type = Mohr-Coulomb\n    set Cohesion = 3000\n"
                 f"    set Region polygon = 0, {i / 10 - 2:.1f}; 1, {i / 10 - 2:.1f}; "
                 f"1, {i / 10 - 1.9:.1f}; 0, {i / 10 - 1.9:.1f}", prefix="M "),
         section("Boundary conditions", "Names = bottom, sides, footing,",
                 lambda i: "set Sides = right\n    set Velocity x = 0"),
         section("Tractions", "Names =",
                 lambda i: "set Sides = top\n    set Box = 0.5, -0.1; 1, 0.1\n    set Traction y = -100"),
         section("Loading", "Stages = push,", lambda i: "set Duration = 0.02\n    set Step size = 0.02",
                 "  subsection push\n    set Duration = 0.02\n  end"),
         f"subsection Observation\n  set Conditions = {', '.join(names)}\nend\n",
         "subsection Checkpoint\n  set Every steps = 2\nend\n",
         "subsection Output\n  set Report for tests = none\nend\n"]
open("scene.prm", "w").write("".join(scene))
json.dump(names, open("names.json", "w"))
# Each material has a cohesion of its own by --set.
open("set", "w").write("".join(f"--set\0Materials/M {name}/Cohesion = {4300 + i}\0"
                               for i, name in enumerate(names)))
PYTHON
xargs -0 "$program" scene.prm --quiet --output run <set
"$program" run/parameters.prm --quiet --output again
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import csv, json
import geocone
names = json.load(open("names.json"))
rows = [list(csv.reader(open(f"{run}/statistics.csv"))) for run in ("run", "again")]
assert rows[0][0] == rows[1][0] and len(rows[0]) == len(rows[1]) == 2 + len(names)
column = rows[0][0].index("load (N/m)")
assert [row[column] for row in rows[0][1:]] == [row[column] for row in rows[1][1:]]
text = open("run/parameters.prm").read()
run = geocone.Run("run")
for i, name in enumerate(names):
    for section in (name, "M " + name):
        assert f"  subsection {section}\n" in text, section
    assert run.parameters[f"Materials/M {name}/Cohesion"] == str(4300 + i), name
assert json.load(open("run/summary.json"))["status"] == "finished"
PYTHON
# Names that no section can have.
n=0
for name in a.b "a'b" 'a"b' 'a\b' a/b Names; do
  sed "s|, x_y|, $(printf '%s' "$name" | sed 's/[\\/&|]/\\&/g')|" >bad-$n.prm <<PRM
include $root/tests/footing_coarse.prm
subsection Boundary conditions
  set Names = bottom, sides, footing, x_y
end
PRM
  n=$((n + 1))
done
if "$program" --check bad-*.prm >said 2>err; then exit 1; fi
[ "$(grep -c '^error: .*' said)" = $n ] && [ "$(grep -c 'cannot be that of a section' said)" = $n ]
