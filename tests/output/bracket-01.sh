# A footing whose soil dilates less than its friction: a run by steps on a mesh from the
# bounds tells what is certified, what is an estimate, and its own load beside both; a
# limit analysis tells the first two; where flow is associated both bounds are certified.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
steps() {
  "$program" "$root/prm/limit_load/footing_half_dilatancy.prm" \
    --set 'Mesh/Number of cells = 200' --set 'Output/Pictures = false' \
    --set 'Output/Fields = false' --set 'Output/Expectations =' "$@"
}
steps --output steps >out
grep -q 'certified for any dilatancy (Radenkovic 1961): load <= [0-9.]* N/m; estimate, which is no bound (Davis 1968): [0-9.]* to [0-9.]* N/m' out
grep -q 'incremental load [0-9.]* N/m, [-+][0-9.]* % against the certified upper bound, [-+][0-9.]* % against Davis' out
steps --output bounds --set 'Analysis/Kind = limit load' \
  --set 'Analysis/Maximum levels = 2' >out
grep -q 'certified for any dilatancy (Radenkovic 1961): load <= ' out
grep -q 'for the incremental load beside both' out
steps --output associated --set 'Materials/soil/Dilatancy angle = 25' >out
grep -q '^ *[0-9.]* <= load <= [0-9.]* N/m, certified' out
if grep -q Davis out; then exit 1; fi
/usr/bin/python3 - <<'PYTHON'
import json
steps, bounds, associated = (json.load(open(f"{name}/summary.json"))
                             for name in ("steps", "bounds", "associated"))
exact, davis = 8288.21, 7752.79
told = steps["non_associated"]
assert told["incremental"] == steps["limit_load"]["value"] < steps["bounds"]["upper"]
assert told["davis_lower"] <= davis <= told["davis_upper"]
assert told["upper_is_certified"] and not told["lower_is_certified"]
assert steps["bounds"]["upper"] >= exact
# The same meshes, whatever dilates: the same bounds.
assert steps["bounds"]["upper"] == associated["bounds"]["upper"]
assert associated["bounds"]["lower"] <= exact and "non_associated" not in associated
assert "incremental" not in bounds["non_associated"]
assert bounds["bounds"]["upper"] >= exact
PYTHON
