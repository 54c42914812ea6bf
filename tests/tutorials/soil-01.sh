# The law of the tutorial has its strengths in an element test, and a footing on it the exact
# load; where its strengths are equal, that of Tresca's law. The page shows the code that is
# compiled here.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B "$root/tests/tutorials/parameters.py" . soil footing
own() {
  "$(dirname "$program")/geocone_tests" tutorials/soil-01 "$@" --quiet --set 'Output/Pictures = false'
}
own clay_element.prm
own clay_footing.prm
own clay_footing.prm --output equal --set 'Materials/soil/Active strength = 24e3' \
  --set 'Materials/soil/Passive strength = 24e3' --set 'Output/Expectations ='
own clay_footing.prm --output tresca --set 'Materials/soil/Type = Tresca' \
  --set 'Materials/soil/Cohesion = 24e3' --set 'Output/Expectations ='
/usr/bin/python3 -B - <<'PYTHON'
import json
loads = [json.load(open(f"{run}/summary.json"))["limit_load"]["value"] for run in ("equal", "tresca")]
assert abs(loads[0] / loads[1] - 1) < 1e-9, loads
PYTHON
