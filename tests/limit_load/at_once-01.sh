# Bounds that are computed at the same time, on two processors, are those of one processor.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for scene in limit_load/footing_rough safety/embankment; do
  for processors in one all; do
    command=("$program")
    [ $processors = all ] || command=(taskset -c "$(taskset -pc $$ | sed 's/.*: //; s/[-,].*//')" "$program")
    "${command[@]}" "$root/prm/$scene.prm" --quiet --output $processors \
      --set 'Analysis/Maximum levels = 3' --set 'Output/Pictures = false' \
      --set 'Output/Fields = false' --set 'Output/Expectations =' \
      --set 'Output/If folder exists = overwrite'
  done
  /usr/bin/python3 - <<'PYTHON'
import json
one, all = (json.load(open(f"{name}/summary.json"))["bounds"] for name in ("one", "all"))
for key in ("lower", "upper", "iterations", "cells", "violation_lower", "error_upper"):
    assert one[key] == all[key], (key, one[key], all[key])
PYTHON
done
