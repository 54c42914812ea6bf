# Warnings of seepage: levels that jump within one soil, with the growth of the discharge per
# halving of the cells, k h ln(2)/pi = 1e-5 * 2 * 0.2206 = 4.4e-6 m^2/s, and a discharge that
# changes much; none where they meet at or in the wall, nor of equal levels.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/seepage/cut_off-01.prm" --set 'Output/Report for tests = none' \
    --set 'Output/Expectations =' --set 'Reference/Quantity =' --output run "$@" >log 2>&1
}
meet() {
  run --set "Geometry/Polygon = -30, -10; 30, -10; 30, 0; $1, 0; -30, 0" "${@:2}"
}
meet 3 --set 'Seepage/Cells = 300'
grep -q "the heads of 'Seepage/upstream' and 'Seepage/downstream' differ by 2 m where they meet, at (3, 0)" log
grep -q 'grows by 4.4e-06 m^3/s/m' log
grep -q 'the discharge changed by +.* % on the last mesh' log
grep -q '"warnings": \[$' run/summary.json
meet 3 --set 'Seepage/upstream/Level = 1' --set 'Seepage/downstream/Level = 1'
fails grep -q warning log
for x in 0.05 0.1; do
  meet $x
  fails grep -q warning log
done

# A flow that was not found has no discharge: the water cannot pass a core of 1e-300 m/s.
fails "$program" "$root/prm/safety/dam_seepage.prm" --set 'Analysis/Kind = seepage' \
  --set 'Output/Expectations =' --set 'Output/Pictures = false' --output failed \
  --set 'Materials/core/Permeability = 1e-300' --set 'Seepage/Cells = 1000' >log 2>&1
grep -q 'the flow of water was not found' log
for name in discharge reservoir imbalance natural_map_error; do
  grep -q "\"$name\": null" failed/summary.json
done
