# The gradients of both bounds are those of differences, of the load of a footing and of the
# factor of safety of a slope, and their sums are those of homogeneity (gradients.py).
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 "$root/tests/limit_load/gradients.py" "$program" "$root"
