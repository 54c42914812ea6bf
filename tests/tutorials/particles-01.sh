# The file of the tutorial is that of prm/tutorials; the column runs out as far as the page
# states, and its film is drawn.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B "$root/tests/tutorials/parameters.py" . particles
cmp sand_column.prm "$root/prm/tutorials/sand_column.prm"
"$program" sand_column.prm --quiet --set 'Output/Pictures = false'
"$root/scripts/plot" results/sand_column --animation > said
[ -s results/sand_column/points.gif ]
