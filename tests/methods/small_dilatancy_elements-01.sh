# Soil with little dilatancy and the exact law: elements that follow localised solutions are named
# before the run; those that were not seen to, and friction with memory, are not.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
warned()
{
  "$program" "$root/prm/verification/unloaded_hole.prm" --dry-run "$@" 2>&1 |
    grep -q 'the exact law of soil with little dilatancy'
}
not_warned()
{
  if warned "$@"; then
    echo "a warning with $*"
    exit 1
  fi
}
element=Discretisation/Element cells='Mesh/Cells = quadrilaterals'
warned --set "$element = P3"
warned --set "$element = Q2" --set "$cells"
warned --set "$element = Q3" --set "$cells"
not_warned --set "$element = P2"
not_warned --set "$element = P3" --set 'Materials/rock/Dilatancy angle = 20'
not_warned --set "$element = P3" --set 'Materials/rock/Friction memory = 0.01'
