# The files of a run are there and can be read; an expectation that does not hold
# gives exit code 1; a used folder is numbered, refused or overwritten.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/footing_coarse.prm" --quiet \
    --set 'Output/Report for tests = none' \
    --set 'Loading/push/Duration = 0.06' "$@"
}
run --output a --set 'Output/Fields = true' --set 'Output/Pictures = true'
for file in parameters.prm statistics.csv newton.csv summary.json log.txt \
  cells.pvd points.pvd cells-0000.vtu points-0000.vtu load_displacement.png \
  load_displacement.svg newton.png plastic_strain_rate.png; do
  [ -s "a/$file" ] || { echo "no $file"; exit 1; }
done
[ "$(wc -l <a/statistics.csv)" = 4 ]
fails ls a/*.part 2>/dev/null
/usr/bin/python3 - <<'PYTHON'
import csv, json
summary = json.load(open("a/summary.json"))
assert summary["status"] == "finished"
for topic, names in {
    "limit_load": ["value", "reference", "relative_error", "band_low",
                   "band_high", "peak"],
    "newton": ["steps", "substeps", "iterations_mean", "iterations_max",
               "failures"],
    "quality": ["natural_map_error_max", "complementarity_max",
                "cone_violation_max"],
    "size": ["dofs", "points", "ranks"],
    "cost": ["total_s", "assembly_s", "factorise_s", "solve_s",
             "factorisations", "ratio_to_factorise_and_solve",
             "peak_memory_MB"]}.items():
    for name in names:
        assert name in summary[topic], (topic, name)
rows = list(csv.DictReader(open("a/statistics.csv")))
assert abs(float(rows[-1]["load (N/m)"]) - summary["limit_load"]["last"]) < 1e-6
works = [float(row["external work (J/m)"]) for row in rows]
assert all(a < b for a, b in zip(works, works[1:]))
PYTHON

# Alone it needs no folder of Open MPI, which runs that go on at once would share.
OMPI_MCA_orte_tmpdir_base=/dev/null run --output alone --set 'Output/Pictures = false'

# The parameters as used repeat the run.
"$program" a/parameters.prm --quiet --output again --set 'Output/Pictures = false'
cmp <(cut -d, -f1-4 a/statistics.csv) <(cut -d, -f1-4 again/statistics.csv)

run --output a --set 'Output/If folder exists = number'
[ -s a-2/summary.json ]
# A folder that was named is not exchanged for another one by itself.
for how in refuse automatic; do
  if run --output a --set "Output/If folder exists = $how" 2>refused; then exit 1; fi
  grep -q 'exists and is not empty' refused
done
[ ! -e a-3 ]

# Only what the list of the run before names is deleted, and never anything outside
# of its folder.
touch a/mine a/mine.png a/mine.vtu a/points-9.h5 outside
printf '%s\n' ../outside "$PWD/outside" . .. '' >>a/files.txt
run --output a --set 'Output/If folder exists = overwrite'
for file in a/mine a/mine.png a/mine.vtu a/points-9.h5 outside; do
  [ -e $file ] || { echo "$file was deleted"; exit 1; }
done
[ ! -e a/cells-0000.vtu ]
[ -z "$(sort a/files.txt | uniq -d)" ]
while read -r file; do [ -e "a/$file" ]; done <a/files.txt
rm a/files.txt
if run --output a --set 'Output/If folder exists = overwrite' 2>refused; then exit 1; fi
grep -q 'has no files.txt of a run before' refused

# Two runs that want the same folder at once do not both get it.
new=(--output both --set 'Output/If folder exists = refuse')
run "${new[@]}" 2>both1 & one=$!
run "${new[@]}" 2>both2 & two=$!
codes=0
wait $one || codes=$((codes + 1))
wait $two || codes=$((codes + 1))
[ $codes = 1 ]
cat both1 both2 | grep -q "parameter 'Output/Folder' = 'both'"

if run --output b --set 'Output/Expectations = newton/steps >= 4' 2>failed; then
  exit 1
fi
grep -q 'NO (3)' failed

# A run that cannot go on says so, with exit code 1, and keeps its last step.
if run --output c --set 'Newton/Maximum iterations = 3' \
  --set 'Newton/Globalisation = none' --set 'Time stepping/Maximum halvings = 0' \
  2>stopped; then exit 1; fi
grep -q 'the step . failed at t = ' stopped
grep -q '"status": "failed' c/summary.json
