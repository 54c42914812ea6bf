# A run with bars goes on with the same bits from a checkpoint while a bar yields, before one is
# removed, and after one was slack, and one with a plate while it has hinges, beside
# finite elements and particles; statistics.csv has the
# columns of each bar.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

resumed() {  # FILE
  "$program" "$root/tests/structures/$1-01.prm" --quiet --output "$1" \
    --set 'Checkpoint/Every steps = 1' --set 'Output/Report for tests = none'
  rm "$(ls -v "$1"/checkpoint-*.h5 | tail -1)"
  cp "$1/statistics.csv" "$1.csv"
  if test -e "$1/plates.csv"; then cp "$1/plates.csv" "$1-plates.csv"; fi
  "$program" --resume "$1" --quiet
  grep -q "resumed at t" "$1/log.txt"
  cmp "$1.csv" "$1/statistics.csv"
  if test -e "$1/plates.csv"; then cmp "$1-plates.csv" "$1/plates.csv"; fi
}

resumed pull_out
resumed stages
resumed geogrid
resumed plate_hinges
resumed particles
head -1 geogrid.csv | grep -q "axial force grid 1 (N/m).*elongation grid 2 (m).*yields grid 2 (-)"
