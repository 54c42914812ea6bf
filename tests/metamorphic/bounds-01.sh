# Strict bounds of a limit load, also below an inclined velocity, and of a factor of safety.
program=$1 root=$2 folder=$3
rm -rf "$folder"
/usr/bin/python3 "$root/tests/metamorphic/variants.py" "$program" "$folder" bounds inclined slope
