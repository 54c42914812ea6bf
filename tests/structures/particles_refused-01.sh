# Beside particles, what structures do not go with is refused by name, before anything is written.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

refused() {  # PARAMETER OPTIONS...
  parameter=$1
  shift
  if "$@" "$root/prm/structures/wall_fails_mpm.prm" --quiet --output run 2> message.txt; then
    echo "'$parameter' is accepted"
    exit 1
  fi
  grep -q "$parameter" message.txt
  test ! -e run
}

refused "Material point method/Integration" "$program" \
  --set 'Material point method/Integration = theta-scheme'
refused "Material point method/Grid follows" "$program" \
  --set 'Material point method/Grid follows = load'
refused "Structures/Names" mpirun -n 2 "$program"

# A plate that leaves its place in the grid is warned of, with the size.
"$program" "$root/tests/structures/particles-01.prm" --quiet --output moved \
  --set 'Output/Report for tests = none' --set 'Output/Expectations =' \
  --set 'Materials/clay/Cohesion = 1e9' --set 'Materials/clay/Young modulus = 1e6' \
  --set 'Structures/wall/Bending stiffness = 1e4' \
  --set 'Boundary conditions/load/Velocity y = -0.22' \
  --set 'Loading/press/First step size = 0.25'
grep -q "the plate 'wall' has moved by 0.[0-9]* m, [0-9.]* cells" moved/log.txt
