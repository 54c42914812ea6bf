# A run that is killed leaves complete files up to its last step, and a summary that
# does not say that it is still running.
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
for _ in $(seq 100); do
  grep -q '"status": "running"' a/summary.json || break
  sleep 0.05
done
/usr/bin/python3 - <<'PYTHON'
import glob, json, xml.etree.ElementTree as tree
for name in ("statistics.csv", "newton.csv"):
    lines = open("a/" + name).read().split("\n")
    assert lines[-1] == "", "the last line is not complete"
    assert len({line.count(",") for line in lines[:-1]}) == 1
summary = json.load(open("a/summary.json"))
assert summary["status"].startswith("killed: "), summary["status"]
assert summary["run"]["pid"] > 0 and summary["run"]["host"]
files = glob.glob("a/*.vtu") + glob.glob("a/*.pvd")
assert len(files) >= 4
for name in files:
    tree.parse(name)
PYTHON

# Its lock, which it could not give back, is in nobody's way.
[ -e a/run.lock ]
"$program" "$root/tests/footing_coarse.prm" --quiet --output a \
  --set 'Output/If folder exists = overwrite' --set 'Loading/push/Duration = 0.05'
[ ! -e a/run.lock ]
