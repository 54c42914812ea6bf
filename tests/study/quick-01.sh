# The quick study: its table, its report, and that nothing is computed twice.
# The loads are those of the runs when their convergence was checked
# (doc/verification.md); times and ranks are not compared.
program=$1 source=$2 folder=$3 numdiff=$4
. "$source/tests/fails.sh"
rm -rf "$folder"
mkdir -p "$folder"
study="$source/scripts/study --quick --program $program --output $folder/results"
$study 2>"$folder/log"
grep -q '18/18 done, 1 failed' "$folder/log"

# Columns are found by name; a failed run is a line with its reason.
/usr/bin/python3 - "$folder/results/quick.csv" >"$folder/table" <<'END'
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1], newline="")))
wanted = ["size/dofs", "limit_load/value", "limit_load/relative_error", "newton/failures"]
for row in rows:
    axes = [value for key, value in row.items() if key.startswith("axis ") and value]
    values = [row[key] or "-" for key in wanted]
    if row["group"].startswith("FEM"):  # meshes of gmsh depend on its version
        error = float(row["limit_load/relative_error"])
        values = [f"error in bounds: {0. < error < 0.07}"]
    print(row["group"], *axes, row["status"], *values)
errors = [float(row["limit_load/relative_error"]) for row in rows[:3]]
assert errors == sorted(errors, reverse=True), errors
assert len(rows) == 18
assert "Cohesion" in rows[-1]["reason"], rows[-1]
assert all(row["command"].startswith("scripts/geocone ") for row in rows)
END
"$numdiff" -r 1e-6 -a 1e-12 "$source/tests/study/quick-01.csv" "$folder/table"

# One page with its pictures in it, and none that could not be drawn.
page=$folder/results/report.html
[ "$(grep -c 'src="data:image/png;base64' "$page")" = 5 ]
fails grep -q 'cannot be shown' "$page"
fails grep -q 'src="[^d]' "$page"
grep -q "soil without cohesion and weight carries nothing" "$page"
grep -q "<code>scripts/geocone -n 2 prm/verification/prandtl_mpm.prm" "$page"

# Again: all is there.
$study 2>"$folder/log_again"
grep -q '18/18 done, 1 failed: 18 there from before' "$folder/log_again"
[ "$(grep -c done "$folder/log_again")" = 1 ]

# A part of it, also as text; a group that is not there is refused.
$study --only 'two ranks' 2>"$folder/log_part"
grep -q '1/1 done: 1 there from before' "$folder/log_part"
grep -q '^| two ranks | .* | holds |' "$folder/results/quick.md"
fails grep -q 'conditions on nodes' "$folder/results/quick.md"
if $study --only none 2>"$folder/log_none"; then exit 1; fi
grep -qF "unknown group 'none'" "$folder/log_none"
