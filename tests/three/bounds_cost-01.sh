# The cost that a dry run announces is that of the run within a factor of two, and a mesh that does not
# fit into the memory is announced, with one that does.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
scene=$root/prm/three/bounds_square_footing.prm
dry() { "$program" "$scene" --dry-run --set "Analysis/Maximum cells = $1" "${@:2}"; }
dry 900 | grep -o 'it takes about .* MB and .* s' >forecast
"$program" "$scene" --quiet --output run --set 'Output/Pictures = false' \
  --set 'Output/Fields = false' --set 'Analysis/Maximum cells = 900' --set 'Output/Expectations ='
/usr/bin/python3 -B - <<'PYTHON'
import csv
import re

memory, seconds = map(float, re.findall(r"about (\S+) MB and (\S+) s", open("forecast").read())[0])
last = list(csv.DictReader(open("run/bounds.csv")))[-1]
assert 0.5 < memory / float(last["peak memory (MB)"]) < 2., (memory, last)
PYTHON
[ "$(dry 1000000 --set 'Analysis/Maximum levels = 30' | grep -c "'Analysis/Maximum cells' = 1000000 needs about .* MB of memory, but .* cells be the most")" = 1 ]
