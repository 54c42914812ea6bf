# How large a run will be is printed before it is built, near to what it then is; a run
# that is larger than the memory is refused with the parameter that drives it, unless it
# is forced; a dry run writes nothing. Friction has a memory by default in soil with little
# dilatancy, but not in soil that softens, whose peak load it would lower.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
options=(--set 'Output/Report for tests = none' --set 'Output/Pictures = false')
compare() {
  "$program" "$root/$1" --output run "${@:2}" "${options[@]}" \
    --set 'Output/Expectations =' >said 2>err
  [ "$(grep -c ': about .* cells, .* unknowns, .* points, .* steps, .* of memory, ' said)" = 1 ]
  /usr/bin/python3 - "$@" <<'PYTHON'
import json, re, sys
line = next(line for line in open("said") if ": about " in line)
def number(what):
    value, unit = re.search(r"([0-9.e+]+)( thousand| million|) " + what, line).groups()
    return float(value) * {"": 1., " thousand": 1e3, " million": 1e6}[unit]
size = json.load(open("run/summary.json"))["size"]
unknowns = size["dofs"] if "dofs" in size else 2 * size["nodes"]
for name, expected, found in (("cells", number("cells"), size["cells"]),
                              ("unknowns", number("unknowns"), unknowns),
                              ("points", number("points"), size["points"])):
    factor = 2.1 if "unstructured" in str(sys.argv) else 1.4
    assert found / factor <= expected <= found * factor, (sys.argv, name, expected, found)
PYTHON
  rm -r run
}
short=(--set 'Loading/push/Duration = 0.02')
compare tests/footing_coarse.prm "${short[@]}"
"$program" "$root/tests/footing_coarse.prm" --dry-run "${short[@]}" "${options[@]}" >dry
[ ! -e results ] && [ ! -e run ]
cmp <(grep ': about ' dry) <(grep ': about ' said)
compare tests/footing_coarse.prm "${short[@]}" --set 'Mesh/Type = unstructured' \
  --set 'Mesh/Smallest size = 0.01'
compare tests/footing_coarse.prm "${short[@]}" --set 'Mesh/Type = graded' \
  --set 'Mesh/Cells = quadrilaterals' --set 'Discretisation/Element = Q2' \
  --set 'Mesh/Smallest size = 0.01'
compare prm/footing_mpm.prm "${short[@]}" --set 'Mesh/Cell size = 0.1'
compare tests/explicit/collapse.prm --set 'Loading/fall/Duration = 0.1'
# The cells of a script are known when it has run.
compare prm/three/circular_footing.prm --run-gmsh-script --set 'Loading/push/Duration = 0.0005'

refuse() {
  if "$program" "$root/$1" --quiet "${@:3}" 2>err; then exit 1; fi
  grep -q "^error: parameter '$2' = " err || { cat err; exit 1; }
  grep -q 'remedy: ' err
  [ ! -e results ]
}
refuse prm/footing_mpm.prm Mesh/Cell\ size --set 'Mesh/Cell size = 2e-4'
refuse prm/footing_mpm.prm 'Particles/Points per direction' \
  --set 'Particles/Points per direction = 3000'
refuse tests/explicit/collapse.prm Particles/Spacing --set 'Particles/Layout = lattice' \
  --set 'Particles/Spacing = 4e-5'
refuse tests/footing_coarse.prm 'Mesh/Cell size' --set 'Mesh/Cell size = 1e-12'
hard=(--dry-run --set 'Materials/soil/Dilatancy angle = 0')
"$program" "$root/prm/footing_softening.prm" "${hard[@]}" >dry
if grep -q 'has a memory' dry; then exit 1; fi
"$program" "$root/prm/footing_softening.prm" "${hard[@]}" \
  --set 'Materials/soil/Cohesion with strain = constant' \
  --set 'Materials/soil/Friction angle with strain = constant' \
  --set 'Materials/soil/Softening length = 0' >dry
grep -q 'has a memory of 0.01 s' dry
# Friction may fall while cohesion is constant.
"$program" "$root/prm/footing_softening.prm" --dry-run \
  --set 'Materials/soil/Cohesion with strain = constant' >dry
