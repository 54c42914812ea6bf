# exit-01.sh PROGRAM SOURCE FOLDER NUMDIFF
# The free surface of the rectangular dam ends at the exit point of Polubarinova-Kochina's solution,
# 12.7059 m (doc/cookbook/seepage_exact.py), to 1 %.
rm -rf "$3"
mkdir -p "$3"
cd "$3"
"$1" "$2/prm/seepage/rectangular_dam.prm" --output dam --quiet --set 'Output/Pictures = false' >/dev/null
/usr/bin/python3 -B - <<'PYTHON'
import json

segments = json.load(open("dam/model.json"))["free_surfaces"][-1]["segments"]
found = max(y for segment in segments for x, y in segment if x > 16. - 1e-6)
assert abs(found / 12.705914 - 1.) < 0.01, found
PYTHON
