# Strict bounds of a limit load and of a factor of safety.
program=$1 root=$2 folder=$3
rm -rf "$folder"
/usr/bin/python3 "$root/tests/metamorphic/variants.py" "$program" "$folder" bounds slope
