# How a run has ended is in its summary: by a signal, a full disk, a limit of the size
# of files, a folder that is taken away.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
start() {
  "$program" "$root/tests/$1" --quiet --output "$2" \
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
for signal in TERM INT; do
  number=$([ $signal = TERM ] && echo 143 || echo 130)
  start footing_coarse.prm fem$signal "${long[@]}"
  wait_for_lines fem$signal 3
  kill -$signal $pid
  code=0
  wait $pid || code=$?
  [ $code = $number ]
  status fem$signal | grep -q "^stopped: by SIG$signal"
  start explicit/collapse.prm explicit$signal "${falls[@]}"
  wait_for_lines explicit$signal 3
  kill -$signal $pid
  code=0
  wait $pid || code=$?
  [ $code = $number ]
  status explicit$signal | grep -q "^stopped: by SIG$signal"
done

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
