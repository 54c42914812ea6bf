# Parameters that are set and not used by the run are named in one line; those of
# another law are left out; nothing is said of what is used.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/footing_coarse.prm" --quiet \
    --set 'Output/Report for tests = none' --set 'Loading/push/Duration = 0.02' "$@" 2>err
}
run --output a --set 'Material point method/Transfer = APIC' \
  --set 'Explicit/Courant number = 0.2' --set 'Materials/soil/Type = Tresca' \
  --set 'Materials/soil/Friction angle = 30'
[ "$(wc -l <err)" = 1 ]
grep -q '^warning: set, but not used by this run: ' err
for name in 'Material point method/Transfer (needs Discretisation/Method = MPM or explicit MPM)' \
  'Explicit/Courant number (needs Discretisation/Method = explicit MPM)' \
  'Materials/soil/Friction angle (needs Type = Mohr-Coulomb or hardening Mohr-Coulomb or spatial Mohr-Coulomb or Drucker-Prager)'; do
  grep -qF "$name" err || { cat err; exit 1; }
done
/usr/bin/python3 - <<'PYTHON'
import json
warnings = json.load(open("a/summary.json"))["warnings"]
assert len(warnings) == 1 and "Explicit/Courant number" in warnings[0]
PYTHON
run --output b --set 'Mesh/Grading points ='
[ ! -s err ]
# The parameters as used say nothing that is not used.
"$program" a/parameters.prm --quiet --output c 2>err
[ "$(wc -l <err)" -le 1 ]
