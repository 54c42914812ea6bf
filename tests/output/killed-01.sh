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

# A folder in which a run goes on is refused; one that tells of a process whose number
# another one has now is not.
claim() {  # PID_START
  mkdir -p claimed
  echo summary.json >claimed/files.txt
  /usr/bin/python3 - "$1" $$ <<'PYTHON'
import json, socket, sys
run = {"pid": int(sys.argv[2]), "pid_start": sys.argv[1], "host": socket.gethostname(),
       "started": "2026-01-01T00:00:00Z", "last_sign_of_life": "2026-01-01T00:00:00Z"}
json.dump({"status": "running", "run": run}, open("claimed/summary.json", "w"))
PYTHON
}
again() {
  "$program" "$root/tests/footing_coarse.prm" --quiet --output claimed \
    --set 'Output/If folder exists = overwrite' --set 'Loading/push/Duration = 0.05' 2>said
}
claim "$(cut -d ' ' -f 22 /proc/$$/stat)"
if again; then exit 1; fi
grep -q "the run of process $$ goes on in it" said
claim 1
again || { cat said; exit 1; }
