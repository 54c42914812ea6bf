# The former name of the program goes on with a path, too, and ends with the same table.
program=$(dirname "$1")/element_test root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/element/cyclic_shear.prm" --quiet --output path \
  --set 'Output/Pictures = false' --set 'Checkpoint/Every steps = 7'
cp path/path.csv whole.csv
cp path/surfaces.csv surfaces.csv
"$program" --resume path --quiet
cmp whole.csv path/path.csv
cmp surfaces.csv path/surfaces.csv
grep -q '"status": "finished"' path/summary.json
