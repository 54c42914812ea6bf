# A book of brackets: each is verified from its fields, a missing field is found, and a published
# value that contradicts a bracket is an error, not a line of the page. Rounded values and those of
# other problems are not overstated, nor is half a bracket compared.
program=$1 source=$2 folder=$3
. "$source/tests/fails.sh"
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cat >book.toml <<END
[[group]]
name = "N_c"
file = "$source/prm/limit_load/footing_rough.prm"
set = ["Output/Certificates = true", "Output/Fields = false", "Output/Pictures = false", "Output/Expectations =", "Analysis/Maximum levels = 1"]
[group.vary]
phi = {values = [25], set = ["Materials/soil/Friction angle = {}"]}
[group.check]
divisor = 400
by = "phi"
published = {25 = [[20.7205, "exact", "Prandtl"], [40, "estimate", "nobody"], ["40", "estimate", "rounded"], [40, "other problem", "x"]]}
[[section]]
title = "N_c"
[[section.figure]]
kind = "book.chart"
[[section.figure]]
kind = "book.curves"
x = "phi"
xlabel = "phi"
ylabel = "N_c"
[[section.figure]]
kind = "book.mechanisms"
[[section.table]]
kind = "book.brackets"
END
study() {
  "$source/scripts/study" book.toml --program "$program" --output results "$@" >log 2>&1
}
study
grep -q "20.7205, exact: inside (Prandtl); 40, estimate: +32.9 % or more (nobody); 40, estimate: +31.3 % or more (rounded); 40, other problem (x) |" results/book.md
grep -q "| proved (.e-1[56]) |" results/book.md

sed -i 's/20.7205, "exact"/10, "upper bound"/' book.toml
fails study --report-only
grep -q "10 (upper bound, Prandtl) contradicts 12.6" log
rm results/runs/book/*/certificate_upper.json
sed -i 's/10, "upper bound"/10, "lower bound"/' book.toml
fails study --report-only # the mechanism cannot be drawn
grep -q "NOT PROVED: \[Errno 2\] No such file" results/book.md

PYTHONPATH=$source/python /usr/bin/python3 -B - <<END
from math import nan
from geocone.report.book import compared

for kind in "exact", "upper bound", "lower bound", "estimate":
    assert compared(nan, nan, 1.4, kind, "x") == f"1.4, {kind}: - (x)"
assert compared(nan, 1., 1.4, "estimate", "x") == "1.4, estimate: +40.0 % or more (x)"
assert compared(nan, 1., 0.9, "estimate", "x") == "0.9, estimate: - (x)"
assert compared(1.36, 1.39, 1.4, "estimate", "x") == "1.4, estimate: +0.7 % or more (x)"
assert compared(1.36, 1.39, "1.4", "estimate", "x") == "1.4, estimate: inside (x)"
assert compared(0.98, 0.99, "1.00", "estimate", "x") == "1.00, estimate: +0.5 % or more (x)"
assert compared(2., 2.5, "1", "estimate", "x") == "1, estimate: -25.0 % or more (x)"
END
