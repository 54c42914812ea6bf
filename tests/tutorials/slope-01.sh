# The file of the tutorial is that of prm/tutorials, and its factor of safety is the one that
# the page states; the model is drawn without a run.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B "$root/tests/tutorials/parameters.py" . slope
cmp my_slope.prm "$root/prm/tutorials/my_slope.prm"
"$program" my_slope.prm --dry-run --picture --quiet
[ -s results/my_slope-model/model.png ]
"$program" my_slope.prm --quiet --set 'Output/Pictures = false'
