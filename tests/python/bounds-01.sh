# cvxopt finds the bounds of a footing on a small mesh by programmes of its own.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/limit_load/footing_rough.prm" --quiet --output run \
  --set 'Analysis/Maximum levels = 1' --set 'Analysis/Gap tolerance = 9' \
  --set 'Analysis/Solver tolerance = 1e-8' --set 'Mesh/Largest size = 0.2' \
  --set 'Output/Pictures = false' --set 'Output/Expectations ='
PYTHONPATH=$root/python /usr/bin/python3 -B "$root/tests/python/bounds.py" run
