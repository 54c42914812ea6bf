# One process has a folder, however it asks for it: of two runs that begin at once exactly
# one goes on, twenty times: in a new folder, by overwriting, by going on, on two
# ranks, and of each kind of run. A lock that was left over is taken over; one of another
# host if that has been silent for long.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
quiet=(--quiet --set 'Output/Report for tests = none' --set 'Output/Pictures = false'
  --set 'Output/Expectations =')
long=("$root/tests/footing_coarse.prm" "${quiet[@]}" --set 'Loading/push/Duration = 1000'
  --set 'Output/If folder exists = overwrite' --set 'Checkpoint/Every steps = 1')

# CALL...: starts a call twice. One ends and names the other, which lives then.
pair() {
  "$@" >said1 2>&1 & one=$!
  "$@" >said2 2>&1 & two=$!
  code=0
  wait -n "$one" "$two" || code=$?
  [ $code = 1 ] || { echo "$*: exit code $code"; cat said1 said2; exit 1; }
  if kill -0 $one 2>/dev/null; then living=$one said=said2; else living=$two said=said1; fi
  kill -0 $living || { echo "$*: both ended"; cat said1 said2; exit 1; }
  grep -q "goes on in it\|it exists and is not empty" $said || { cat $said; exit 1; }
  grep -q '^  remedy:' $said
}
end() { # SIGNAL
  kill -"$1" $living
  wait $living || true
}
for i in 1 2 3; do # each is killed, so that the next one finds its lock
  pair "$program" "${long[@]}" --output "new-$i" --set 'Output/If folder exists = refuse'
  end KILL
  pair "$program" "${long[@]}" --output over
  end KILL
done
[ -e over/run.lock ]
rm -r new-*
until_checkpoint() { # FOLDER
  until ls "$1"/checkpoint-*.h5 >/dev/null 2>&1; do kill -0 $living; sleep 0.05; done
}
pair "$program" "${long[@]}" --output over
until_checkpoint over
grep -q "the run of process $living on $(hostname) goes on in it" $said
end KILL
for i in 1 2 3 4; do
  pair "$program" --resume over --quiet
  end KILL
done
# The other ways are closed to it, too, while one goes on, and beside them.
pair "$program" --resume over --quiet
if "$program" "${long[@]}" --output over 2>said; then exit 1; fi
grep -q "the run of process $living on" said
end TERM
[ ! -e over/run.lock ] || { echo "the lock was left"; exit 1; }

export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
pair mpirun --oversubscribe -np 2 "$program" "${long[@]}" --output ranks
end TERM
# Steps so small that the other one ends first on any machine.
pair "$program" "$root/tests/explicit/collapse.prm" "${quiet[@]}" --output explicit \
  --set 'Loading/fall/Duration = 10' --set 'Explicit/Time step = 1e-7'
end TERM
# Of one path, and of bounds, which end soon.
short() { # FOLDER CALL...: one of two, or the second after the first
  "${@:2}" --output "$1" >said1 2>&1 & one=$!
  "${@:2}" --output "$1" >said2 2>&1 & two=$!
  codes=0
  wait $one || codes=$((codes + 1))
  wait $two || codes=$((codes + 1))
  [ $codes = 1 ] || { echo "$1: $codes failed"; cat said1 said2; exit 1; }
  [ ! -e "$1/run.lock" ]
  ls "$1"/run.lock.* 2>/dev/null && exit 1
  rm -r "$1"
}
for i in 1 2 3; do
  short "point-$i" "$program" "$root/prm/element/cyclic_shear.prm" "${quiet[@]}"
done
for i in 1 2; do
  short "bounds-$i" "$program" "$root/prm/limit_load/footing_rough.prm" "${quiet[@]}" \
    --set 'Analysis/Maximum levels = 1'
done

# Left over from another host, whose processes nobody here can see.
foreign() { # AGE IN SECONDS
  rm -rf over/run.lock
  echo '{"host": "elsewhere", "machine": "another start", "pid": 4711}' >over/run.lock
  touch -d "$1 seconds ago" over/run.lock
}
finish=("$root/tests/footing_coarse.prm" "${quiet[@]}" --output over
  --set 'Loading/push/Duration = 0.02' --set 'Output/If folder exists = overwrite')
for call in "${finish[*]@Q}" "--resume over --quiet"; do
  foreign 60
  if eval "\"\$program\" $call" 2>said; then exit 1; fi
  grep -q 'the run of process 4711 on elsewhere goes on in it, seen [6-9]. s ago' said
  grep -q 'delete run.lock' said
  grep -q elsewhere over/run.lock
done
foreign 300
"$program" "${finish[@]}"
[ ! -e over/run.lock ]
# Who takes it over at once with another one, has it alone.
foreign 300
pair "$program" "${long[@]}" --output over
end TERM
# A lock that tells nothing is one by its age; nothing is written through one that is a link.
: >over/run.lock
if "$program" "${finish[@]}" 2>said; then exit 1; fi
grep -q 'goes on in it, seen' said
rm over/run.lock
echo mine >mine
ln -s "$PWD/mine" over/run.lock
if "$program" "${finish[@]}" 2>said; then exit 1; fi
grep -q 'its run.lock cannot be opened' said
[ "$(cat mine)" = mine ]
rm over/run.lock

# A run whose folder was given to another one ends, and leaves that one's files alone.
"$program" "${long[@]}" --output given >said 2>&1 & living=$!
until_checkpoint given
rm given/run.lock
echo '{"host": "elsewhere", "pid": 4711}' >given/run.lock
code=0
wait $living || code=$?
[ $code = 1 ] && grep -q 'another run has taken the folder over' said || { cat said; exit 1; }
grep -q elsewhere given/run.lock
