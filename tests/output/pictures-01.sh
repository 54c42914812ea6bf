# Pictures of a run that failed, with a name that is no mathematics: they are drawn and
# listed among the run's files. Damaged results are one line of error, no traceback.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/footing_coarse.prm" --quiet --output a \
  --set 'Output/Report for tests = none' --set 'Loading/push/Duration = 0.04'
/usr/bin/python3 - <<'PYTHON'
import json
summary = json.load(open("a/summary.json"))
summary.update(name=r"_$x_1^2$ \frac{ <b>", status="failed: $no_reason$",
               warnings=["the first $one_", "another"])
json.dump(summary, open("a/summary.json", "w"))
open("a/files.txt", "w").write("summary.json\n")
PYTHON
"$root/scripts/plot" a
for picture in load_displacement.png load_displacement.svg newton.png energy.png; do
  [ -s "a/$picture" ] || { echo "no $picture"; exit 1; }
  [ "$(grep -cxF "$picture" a/files.txt)" = 1 ]
done
# The texts of a picture, which the .svg has as comments.
grep -qF 'failed: $no_reason$' a/load_displacement.svg
grep -qF 'first $one_ (+ 1 more, see log.txt)' a/load_displacement.svg

refuse() { # what is wrong
  if "$root/scripts/plot" a 2>error; then
    echo "drawn: $1"
    exit 1
  fi
  [ "$(grep -c . error)" = 1 ] && grep -q '^error: ' error || { cat error; exit 1; }
}
cp a/statistics.csv whole
sed '2s/[0-9]/x/' whole >a/statistics.csv
refuse 'letters in a table'
printf '\377\000,\n1,2\n' >a/statistics.csv
refuse 'no table at all'
cp whole a/statistics.csv
echo '{"name": "a", "status": ["finished"]}' >a/summary.json
refuse 'a summary that is none'
