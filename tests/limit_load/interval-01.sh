# The bounds for a whole box of parameters contain those of its corners and of points within,
# of the load of a footing and of the factor of safety of a slope, and are as sharp
# (interval.py).
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 "$root/tests/limit_load/interval.py" "$program" "$root"

# Bounds that are not certified are warnings: a bar without cohesion carries nothing.
"$program" "$root/tests/limit_load/interval_bar-01.prm" --output zero --set 'Output/Expectations =' \
  --set 'Analysis/Parameter intervals = soil/Cohesion: 0 .. 5000' >log
grep -q '^warning: the lower bound of load for all parameters of the intervals is not certified' log
grep -q '"lower": null' zero/summary.json
