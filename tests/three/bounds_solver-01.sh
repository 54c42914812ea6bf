# Both bounds of a small cut, with and without friction, are the optima that another solver
# finds for problems assembled from the mesh alone; skipped where it is not installed.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
if ! /usr/bin/python3 -c 'import cvxopt' 2>/dev/null; then
  echo "skipped: python3-cvxopt is not installed"
  exit 0
fi
for angle in 0 20; do
  "$program" "$root/tests/three/bounds_solver.prm" --quiet --output $angle \
    --set "Materials/clay/Friction angle = $angle" \
    --set "Materials/clay/Dilatancy angle = $angle"
done
PYTHONPATH=$root/python OPENBLAS_NUM_THREADS=1 \
  /usr/bin/python3 -B "$root/tests/three/conic_bounds.py" . 0 20
