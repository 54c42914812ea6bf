# A hard case whose equations are solved, but whose load is far from the known one, is not
# counted as solved; one without a known load is not, either.
program=$1 source=$2 folder=$3
. "$source/tests/fails.sh"
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
"$source/scripts/study" "$source/studies/stability.toml" --program "$program" --output results \
  --only redundant_mpm --only contradiction_mpm --only surcharge_1000_fem 2>log
page=results/stability.md
grep -q '^| redundant_mpm | .* | +120.. % | .* | converged; \*\*its load is off by +120.. %\*\* |' "$page"
grep -q '^| surcharge_1000_fem | .* | +2.6 % | .* | solved |' "$page"
grep -q '^| surcharge_1000_fem, theta = 0 | .* | converged; its load is not known |' "$page"
grep -q '^| contradiction_mpm | .* | refused, as it must be' "$page"
grep -qx '| 4 | 3 | 1 | 1 | 1 | 1 | 0 |' "$page" || { cat "$page"; exit 1; }
