# Footings by finite elements, with associated flow and with friction that has a memory by itself.
program=$1 root=$2 folder=$3
rm -rf "$folder"
/usr/bin/python3 "$root/tests/metamorphic/variants.py" "$program" "$folder" footing memory
