# A block that is pressed onto a rigid floor with friction.
program=$1 root=$2 folder=$3
rm -rf "$folder"
/usr/bin/python3 "$root/tests/metamorphic/variants.py" "$program" "$folder" contact
