# Wrong plates are refused by the name of the parameter, before anything is written.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

refused() {  # PARAMETER VALUE
  if "$program" "$root/tests/structures/plate-01.prm" --quiet --output run \
       --set "Structures/wall/$1 = $2" 2> message.txt; then
    echo "'$1 = $2' is accepted"
    exit 1
  fi
  grep -q "Structures/wall/${3:-$1}" message.txt
  test ! -e run
}

refused "Bending stiffness" 0
refused "Moment capacity" 0
refused "Spacing" -1
refused "Pre-stress" 10
refused "Points" "0, 0; 0, 5"
refused "Points" "0, 0; 0, 4; 1, 2; 0, 0" "Clamped ends"
refused "Interaction" parabolic
refused "Interaction" linear
