# Bounds and samples of random soil that were stopped within a step, or whose last checkpoint is
# lost, go on to those of a run that was left alone: the mesh of a level must not be refined again,
# by parts of the gap that are those of the mesh before, and samples know the mechanisms of earlier
# ones and their design point.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

numbers() { cut -d, -f"$columns" "$1/$table"; } # without times

resumed() { # NAME TABLE COLUMNS FILE OPTIONS...
  name=$1 table=$2 columns=$3 file=$4
  shift 4
  set -- "$root/$file" --quiet --set 'Checkpoint/Every steps = 1' --set 'Output/Pictures = false' \
    --set 'Output/Report for tests = none' --set 'Output/Expectations =' "$@"
  "$program" "$@" --output "$name"
  numbers "$name" > "$name.csv"
  rm "$(ls -v "$name"/checkpoint-*.h5 | tail -1)"
  "$program" --resume "$name" --quiet
  numbers "$name" | cmp - "$name.csv"

  "$program" "$@" --output "$name-stopped" &
  while [ "$(cat "$name-stopped/$table" 2> /dev/null | wc -l)" -lt 2 ]; do
    kill -0 $! || exit 1
    sleep 0.02
  done
  kill -TERM $! 2> /dev/null || true
  wait $! || "$program" --resume "$name-stopped" --quiet # a fast machine may have ended it
  numbers "$name-stopped" | cmp - "$name.csv"
}

resumed plane bounds.csv 1-10 prm/limit_load/footing_rough.prm --set 'Analysis/Maximum levels = 5'
resumed solid bounds.csv 1-10 tests/three/bounds_adaptive-01.prm \
  --set 'Analysis/Growth of meshes = 3' --set 'Analysis/Maximum cells = 3000'
for sampling in 'Monte Carlo' importance; do
  resumed "samples-$sampling" samples.csv 1-7 prm/reliability/slope.prm \
    --set 'Analysis/Samples = 64' --set "Analysis/Sampling = $sampling" \
    --set 'Analysis/Maximum levels = 1' --set 'Mesh/Cell size = 4' \
    --set 'Materials/clay/Cohesion = 40000'
done
resumed shakedown shakedown.csv 1-11 prm/shakedown/cylinder.prm --set 'Mesh/Smallest size = 0.1' \
  --set 'Analysis/Gap tolerance = 1e-3' --set 'Analysis/Maximum levels = 4'
