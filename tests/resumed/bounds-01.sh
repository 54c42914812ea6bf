# Bounds that were stopped within a level, or whose last checkpoint is lost, go on to those of a
# run that was left alone: the mesh of the level must not be refined again, by parts of the gap
# that are those of the mesh before.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

levels() { cut -d, -f1-10 "$1/bounds.csv"; } # without times

resumed() { # NAME FILE OPTIONS...
  name=$1 file=$2
  shift 2
  set -- "$root/$file" --quiet --set 'Checkpoint/Every steps = 1' --set 'Output/Pictures = false' \
    --set 'Output/Report for tests = none' --set 'Output/Expectations =' "$@"
  "$program" "$@" --output "$name"
  levels "$name" > "$name.csv"
  rm "$(ls -v "$name"/checkpoint-*.h5 | tail -1)"
  "$program" --resume "$name" --quiet
  levels "$name" | cmp - "$name.csv"

  "$program" "$@" --output "$name-stopped" &
  while [ "$(cat "$name-stopped/bounds.csv" 2> /dev/null | wc -l)" -lt 2 ]; do
    kill -0 $! || exit 1
    sleep 0.02
  done
  kill -TERM $! 2> /dev/null || true
  wait $! || "$program" --resume "$name-stopped" --quiet # a fast machine may have ended it
  levels "$name-stopped" | cmp - "$name.csv"
}

resumed plane prm/limit_load/footing_rough.prm --set 'Analysis/Maximum levels = 5'
resumed solid tests/three/bounds_adaptive-01.prm --set 'Analysis/Growth of meshes = 3' \
  --set 'Analysis/Maximum cells = 3000'
