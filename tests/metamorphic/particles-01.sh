# A footing by implicit and by explicit material points.
program=$1 root=$2 folder=$3
rm -rf "$folder"
/usr/bin/python3 "$root/tests/metamorphic/variants.py" "$program" "$folder" mpm explicit
