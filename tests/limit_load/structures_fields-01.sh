# Forces of a wall and a grouted length in a lower bound are those that the tractions of the soil
# beside them have, integrated from the fields without the program's rows (structures_fields.py);
# strengths and interfaces are kept.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/structures/anchored_wall.prm" --output run --quiet \
  --set 'Analysis/Kind = limit load' --set 'Analysis/Load factor of = tractions' \
  --set 'Analysis/Maximum levels = 1' --set 'Output/Pictures = false' --set 'Output/Expectations ='
/usr/bin/python3 "$root/tests/limit_load/structures_fields.py" "$root" run
