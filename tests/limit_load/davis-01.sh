# Davis's estimates of the factor of safety of a homogeneous slope of soil that does not
# dilate: F_A = cos(phi) F_0, and F_B = F_C = sqrt(F_0^2 - tan^2(phi)), to what certificates
# of factors leave, a thousandth and less each.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/safety/slope_2to1.prm" --output run \
  --set 'Analysis/Maximum levels = 1' --set 'Materials/soil/Dilatancy angle = 0' \
  --set 'Output/Pictures = false' --set 'Output/Fields = false' \
  --set 'Output/Expectations =' >out
/usr/bin/python3 - <<'PYTHON'
import json
import math

run = json.load(open("run/summary.json"))
tan_phi = math.tan(math.radians(20.))
for side in "lower", "upper":
    associated = run["safety"][side]
    for name, exact in (("davis_", math.cos(math.radians(20.)) * associated),
                        ("davis_b_", math.sqrt(associated**2 - tan_phi**2)),
                        ("davis_c_", math.sqrt(associated**2 - tan_phi**2))):
        found = run["non_associated"][name + side]
        assert abs(found / exact - 1.) < 5e-3, (name, side, found, exact)
PYTHON
grep -q 'no bound (Davis 1968): A [0-9.]* to [0-9.]*, B [0-9.]* to [0-9.]*, C ' out
