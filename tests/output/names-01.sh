# Names with all signs that they may have, above all underscores, which the library
# replaces by numbers in its files: in all lists, in --set, in tables, in a parameter file
# that a run has written, after a restart, and for Python.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for name in soft_clay wall_left _41 a__20_b 'a b' 'x+y (2)' 'q*&|$!?@~^`%;<>[]{}' 'böschung_ä' \
  'x = 0' a:b value default_value pattern_description documentation actions; do
  echo "$name"
  cat >scene.prm <<PRM
include $root/tests/footing_coarse.prm
subsection Materials
  set Names = soil, M $name
  subsection M $name
    set Type           = Mohr-Coulomb
    set Cohesion       = 3000
    set Region polygon = 0, -2; 1, -2; 1, -1; 0, -1
  end
end
subsection Boundary conditions
  set Names = bottom, sides, footing, $name
  subsection $name
    set Sides      = right
    set Velocity x = 0
  end
end
subsection Tractions
  set Names = $name
  subsection $name
    set Sides      = top
    set Box        = 0.5, -0.1; 1, 0.1
    set Traction y = -100
  end
end
subsection Loading
  set Stages = push, $name
  subsection push
    set Duration = 0.02
  end
  subsection $name
    set Duration  = 0.04
    set Step size = 0.02
  end
end
subsection Observation
  set Conditions = $name
end
subsection Checkpoint
  set Every steps = 2
end
subsection Output
  set Report for tests = none
end
PRM
  "$program" scene.prm --quiet --output run --set "Materials/M $name/Cohesion = 4321"
  "$program" run/parameters.prm --quiet --output again
  /usr/bin/python3 - "$name" <<'PYTHON'
import csv, json, sys
name = sys.argv[1]
rows = [list(csv.reader(open(f"{run}/statistics.csv"))) for run in ("run", "again")]
assert rows[0][0] == rows[1][0] and len(rows[0]) == len(rows[1]) == 4
column = rows[0][0].index("load (N/m)")
assert [row[column] for row in rows[0][1:]] == [row[column] for row in rows[1][1:]]
text = open("run/parameters.prm").read()
for section in (name, "M " + name):
    assert f"  subsection {section}\n" in text, section
assert "4321" in text
assert json.load(open("run/summary.json"))["status"] == "finished"
PYTHON
  PYTHONPATH=$root/python /usr/bin/python3 -B - "$name" <<'PYTHON'
import sys
import geocone
run = geocone.Run("run")
assert run.parameters[f"Materials/M {sys.argv[1]}/Cohesion"] == "4321"
PYTHON
  rm -r run again
done
for name in a.b "a'b" 'a"b' 'a\b' a/b Names; do
  sed "s|, x_y|, $(printf '%s' "$name" | sed 's/[\\/&|]/\\&/g')|" >bad.prm <<PRM
include $root/tests/footing_coarse.prm
subsection Boundary conditions
  set Names = bottom, sides, footing, x_y
end
PRM
  if "$program" bad.prm --dry-run 2>err; then exit 1; fi
  grep -q 'cannot be that of a section' err
done
