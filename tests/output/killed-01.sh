# A run that is killed leaves complete files up to its last step.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/footing_coarse.prm" --quiet --output a \
  --set 'Output/Fields = true' --set 'Loading/push/Duration = 1000' \
  --set 'Loading/push/Output every = 1' &
pid=$!
while [ "$(cat a/statistics.csv 2>/dev/null | wc -l)" -lt 5 ]; do
  kill -0 $pid
  sleep 0.05
done
kill -9 $pid
wait $pid || true
/usr/bin/python3 - <<'PYTHON'
import glob, json, xml.etree.ElementTree as tree
for name in ("statistics.csv", "newton.csv"):
    lines = open("a/" + name).read().split("\n")
    assert lines[-1] == "", "the last line is not complete"
    assert len({line.count(",") for line in lines[:-1]}) == 1
assert json.load(open("a/summary.json"))["status"] == "running"
files = glob.glob("a/*.vtu") + glob.glob("a/*.pvd")
assert len(files) >= 4
for name in files:
    tree.parse(name)
PYTHON
