# A support that ends in explicit steps: until then it carries about the weight along the base, 2 kN/m,
# afterwards nothing, and the momentum grows by exactly m g_x = 2000 N/m per second; on the fast path
# and on others, and a run that goes on in the second stage ends with the same bits.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for fast in true false; do
  "$program" "$root/tests/stages/sliding.prm" --quiet --output run-$fast \
    --set 'Output/Report for tests = none' --set 'Checkpoint/Every steps = 1' \
    --set "Explicit/Fast path = $fast"
  awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) n[$i] = i; next }
    { p[NR] = $n["momentum x (N s/m)"]; f[NR] = $n["force grip x (N/m)"] }
    function off(a, b) { return a > b ? a - b : b - a }
    END { if (off(f[3], -2000) > 600 || f[4] != 0 || f[5] != 0 || off(p[4], 100) > 1e-9 ||
              off(p[5], 200) > 1e-9) { print f[3], f[4], f[5], p[4], p[5]; exit 1 } }' \
    run-$fast/statistics.csv
  cut -d, --complement -f4 run-$fast/statistics.csv > whole.csv # without the CPU time
  rm "$(ls -v run-$fast/checkpoint-*.h5 | tail -1)"
  "$program" --resume run-$fast --quiet
  cut -d, --complement -f4 run-$fast/statistics.csv | cmp whole.csv -
done
