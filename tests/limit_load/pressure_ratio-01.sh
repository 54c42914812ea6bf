# Below level ground the pore pressure ratio acts as the factor 1 - r_u of the unit weight: brackets
# of footings in the plane and around an axis, and of a square one, are those of dry soil of 0.7
# of the weight. A factor of the weight multiplies the pore pressures, too: with its bounds times the
# density, the factor of safety of a slope is 1 within the gaps.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

run() # NAME FILE ARGUMENTS
{
  name=$1 file=$2
  shift 2
  "$program" "$root/$file" --output "$name" --set 'Output/Pictures = false' \
    --set 'Output/Fields = false' --set 'Output/Expectations =' "$@" >"$name.out" ||
    { cat "$name.out"; exit 1; }
}

pair() # NAME FILE MATERIAL DENSITY GRAVITY ARGUMENTS
{
  name=$1 file=$2 density="Materials/$3/Density" value=$4 gravity=$5
  shift 5
  run "$name" "$file" --set "Gravity/Acceleration = $gravity" --set 'Analysis/Maximum levels = 1' \
    --set "$density = $value" --set 'Water/Pore pressure ratio = 0.3' "$@"
  run "$name-dry" "$file" --set "Gravity/Acceleration = $gravity" \
    --set 'Analysis/Maximum levels = 1' --set "$density = $((7 * value / 10))" "$@"
}

pair plane prm/limit_load/n_gamma.prm sand 1000 '0, -10' --set 'Analysis/Maximum levels = 2' \
  --set 'Materials/sand/Cohesion = 500'
pair axis tests/limit_load/axisymmetric_disc_heavy.prm soil 2000 '0, -10'
pair square tests/three/bounds_sand_footing.prm soil 2000 '0, -10, 0' \
  --set 'Materials/soil/Cohesion = 500'

slope="prm/safety/slope_2to1.prm"
run weight "$slope" --set 'Water/Pore pressure ratio = 0.4' --set 'Analysis/Kind = limit load' \
  --set 'Analysis/Load factor of = weight' --set 'Materials/soil/Density = 1000'
for side in lower upper; do
  run "at_$side" "$slope" --set 'Water/Pore pressure ratio = 0.4' --set "Materials/soil/Density = $(
    /usr/bin/python3 -c 'import json, sys
print(1000 * json.load(open("weight/summary.json"))["bounds"][sys.argv[1]])' "$side")"
done

/usr/bin/python3 - <<'PYTHON'
import json

def bounds(name):
    return json.load(open(name + "/summary.json"))["bounds"]

for name in "plane", "axis", "square":
    for side in "lower", "upper":
        wet, dry = bounds(name)[side], bounds(name + "-dry")[side]
        assert abs(wet / dry - 1.) < 1e-6, (name, side, wet, dry)
for side in "lower", "upper":
    safety = json.load(open(f"at_{side}/summary.json"))["safety"]
    assert safety["lower"] <= 1.005 and safety["upper"] >= 0.995, (side, safety)
PYTHON
