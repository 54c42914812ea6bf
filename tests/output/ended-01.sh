# How a run has ended is in its summary: by a signal, a full disk, a limit of the size
# of files, a folder that is taken away.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
ignored=()
start() {
  env --default-signal=HUP "${ignored[@]}" "$program" "$root/tests/$1" --quiet --output "$2" \
    --set 'Output/Report for tests = none' --set 'Output/Pictures = false' \
    "${@:3}" 2>"$2.err" &
  pid=$!
}
wait_for_lines() {
  until [ "$(cat "$1/statistics.csv" 2>/dev/null | wc -l)" -ge "$2" ]; do
    kill -0 $pid || { cat "$1.err"; exit 1; }
    sleep 0.02
  done
}
status() {
  /usr/bin/python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["status"])' \
    "$1/summary.json"
}
long=(--set 'Loading/push/Duration = 1000')
falls=(--set 'Loading/fall/Duration = 1000' --set 'Mesh/Box = 0, 0; 100, 2.4')
for signal in TERM INT HUP; do
  number=$((128 + $(kill -l $signal)))
  start footing_coarse.prm fem$signal "${long[@]}"
  wait_for_lines fem$signal 3
  kill -$signal $pid
  code=0
  wait $pid || code=$?
  [ $code = $number ]
  status fem$signal | grep -q "^stopped: by SIG$signal"
  ls fem$signal/checkpoint-*.h5 >/dev/null
  start explicit/collapse.prm explicit$signal "${falls[@]}"
  wait_for_lines explicit$signal 3
  kill -$signal $pid
  code=0
  wait $pid || code=$?
  [ $code = $number ]
  status explicit$signal | grep -q "^stopped: by SIG$signal"
done

# Under nohup it goes on when the terminal goes.
ignored=(env --ignore-signal=HUP)
start footing_coarse.prm nohup "${long[@]}"
ignored=()
wait_for_lines nohup 3
kill -HUP $pid
wait_for_lines nohup $(($(wc -l <nohup/statistics.csv) + 5))
kill -TERM $pid
code=0
wait $pid || code=$?
[ $code = 143 ]

# Bounds end within a mesh, Gauss-Seidel between two of a million sweeps.
stop_soon() { # FOLDER: as soon as it has begun
  until grep -qs 'results in' "$1/log.txt"; do
    kill -0 $pid || { cat "$1.err"; exit 1; }
    sleep 0.02
  done
  kill -TERM $pid
  code=0
  wait $pid || code=$?
  [ $code = 143 ]
  status "$1" | grep -q '^stopped: by SIGTERM'
}
start ../prm/limit_load/footing_rough.prm bounds --set 'Mesh/Largest size = 0.012' \
  --set 'Mesh/Smallest size = 0.012' --set 'Analysis/Maximum levels = 1'
stop_soon bounds
if grep -q '^level 1' bounds/log.txt; then exit 1; fi
start footing_coarse.prm sweeps "${long[@]}" --set 'Time stepping/Inertia = true' \
  --set 'Newton/Formulation = Gauss-Seidel' --set 'Newton/Maximum iterations = 1000000'
stop_soon sweeps

# Files of at most 20 kB, from some step on (MPI's own are larger).
start footing_coarse.prm limit "${long[@]}" --set 'Output/Fields = true' \
  --set 'Loading/push/Output every = 1'
wait_for_lines limit 2
prlimit --pid $pid --fsize=20000
code=0
wait $pid || code=$?
[ $code = 1 ]
grep -q 'cannot be written: (File too large)' limit.err
grep -q 'remedy: ' limit.err
status limit | grep -q '^failed: '

# A folder that is taken away.
start footing_coarse.prm gone "${long[@]}" --set 'Output/Fields = true' \
  --set 'Loading/push/Output every = 1'
wait_for_lines gone 2
mv gone elsewhere
code=0
wait $pid || code=$?
[ $code = 1 ]
grep -q 'the folder is not there' gone.err
