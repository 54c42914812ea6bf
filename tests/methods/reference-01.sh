# A reference case of any kind has the same topic in summary.json: the settlement of
# the column of elastic-01 by three methods, u_y(H) = -gamma H^2/(2 M) with
# M = E (1 - nu)/((1 + nu)(1 - 2 nu)) = 1.2e8 Pa.
# Explicit MPM and MPM observe the nearest particle, 26 mm below the surface, whose
# settlement is smaller by 0.07 %.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for method in FEM MPM 'explicit MPM'; do
  "$program" "$root/tests/methods/column.prm" --quiet \
    --output "${method/ /_}" --set "Discretisation/Method = $method" \
    --set 'Observation/Points = 0.125, 1' --set 'Output/Fields = false' \
    --set 'Reference/Quantity = points/displacement_1_y_m' \
    --set 'Reference/Expected = -8.3333333333e-5' \
    --set 'Output/Expectations = reference/relative_error = 0 +- 0.01'
  grep -q 'reference: points/displacement_1_y_m -8.*e-05, expected' "${method/ /_}/log.txt"
done
# A bound that does not hold, and a number that is not there.
code=0
"$program" "$root/tests/methods/column.prm" --quiet --output none \
  --set 'Output/Fields = false' --set 'Loading/rest/Duration = 0.1' \
  --set 'Reference/Quantity = no/number' --set 'Reference/Expected = 1' \
  --set 'Output/Expectations = size/points = 1 +- 1' || code=$?
[ $code = 1 ]
grep -q "reference: this run has no number 'no/number'" none/log.txt
/usr/bin/python3 - <<'PYTHON'
import json

for method, allowed in (("FEM", 1e-6), ("MPM", 3e-3), ("explicit_MPM", 3e-3)):
    with open(f"{method}/summary.json") as file:
        reference = json.load(file)["reference"]
    assert list(reference) == ["quantity", "value", "expected", "relative_error"]
    assert abs(reference["value"] / -8.3333333333e-5 - 1. -
               reference["relative_error"]) < 1e-12, reference
    assert abs(reference["relative_error"]) < allowed, (method, reference)
with open("none/summary.json") as file:
    assert json.load(file)["reference"]["value"] is None
PYTHON
