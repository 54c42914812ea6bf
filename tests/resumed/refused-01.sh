# What cannot be resumed is refused with a remedy: no such folder, one of nobody's, one
# without checkpoints, other parameters on the line of the call, a checkpoint of another
# run; a damaged one is left out and named, wherever it is damaged.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

refused() {  # TEXT ARGUMENTS...
  text=$1 && shift
  if "$program" "$@" >out.txt 2>&1; then
    echo "accepted: $*" && exit 1
  fi
  grep -q "$text" out.txt && grep -q "remedy:" out.txt || { cat out.txt && exit 1; }
}

run() {  # FOLDER COHESION
  "$program" "$root/tests/fem/footing-associated-01.prm" --quiet --output "$1" \
    --set 'Output/Expectations =' --set 'Output/Report for tests = none' \
    --set 'Mesh/Grading points =' --set "Materials/soil/Cohesion = $2" \
    --set 'Checkpoint/Every steps = 2' 2>&1
}

refused "no parameters.prm" --resume nowhere
mkdir foreign && echo "set x = 1" >foreign/parameters.prm
refused "no such\|unknown\|it has no" --resume foreign
run one 5000
run other 4000
refused "takes no parameter file" --resume one "$root/prm/footing_fem.prm"
refused "takes no parameter file" --resume one --set 'Materials/soil/Cohesion = 1'
refused "takes no parameter file" --resume one --output two

# A finished run without checkpoints: nothing is left to do, and nothing is written.
mkdir -p done && cp other/* done/ && rm done/checkpoint-*.h5
cp -r done before
refused "nothing is left to do" --resume done
diff -r before done
sed -i 's/"status": "finished"/"status": "killed"/' done/summary.json before/summary.json
refused "there is none" --resume done
diff -r before done

# A finished run is finished again from its last checkpoint, with the same table.
last=$(ls one/checkpoint-*.h5 | tail -1)
first=$(ls one/checkpoint-*.h5 | head -1)
[ "$first" != "$last" ]
cp one/statistics.csv all.csv
"$program" --resume one --quiet
cmp all.csv one/statistics.csv

# A table that is a link: refused before any other file is written.
mkdir linked && cp one/* linked/
mv linked/newton.csv real.csv && ln -s ../real.csv linked/newton.csv
cp -rP linked before_link
refused "'newton.csv' is a symbolic link" --resume linked
diff -r --no-dereference before_link linked

# Damaged anywhere: the one before is taken, and the table is the same in the end.
cp "$last" good.h5
size=$(stat -c %s good.h5)
for place in 0 8 100 800 2000 $((size / 3)) $((size / 2)) $((size - 9)); do
  cp good.h5 "$last"
  printf '\377\000\377\125' | dd of="$last" bs=1 seek="$place" conv=notrunc status=none
  cmp -s good.h5 "$last" && continue
  "$program" --resume one --quiet >out.txt 2>&1 || { cat out.txt && exit 1; }
  cmp all.csv one/statistics.csv
done
: >"$last"
"$program" --resume one --quiet >out.txt 2>&1
grep -q "is left out" out.txt

# A table without its last lines: the run goes back to the checkpoint before, and ends with
# the same table; without a line of any it is refused.
cp one/$(basename "$last") good.h5
for table in statistics newton; do
  cp "one/$table.csv" whole.csv
  lines=$(wc -l <whole.csv)
  lines=$((lines - 1))
  head -n $lines whole.csv >"one/$table.csv"
  "$program" --resume one --quiet >out.txt 2>&1 || { cat out.txt && exit 1; }
  grep -q "is left out: the table 'one/$table.csv' is shorter" out.txt
  cmp all.csv one/statistics.csv
done
head -n 1 one/statistics.csv >cut.csv
cp one/statistics.csv whole.csv
cp cut.csv one/statistics.csv
refused "bring back a copy" --resume one
cp whole.csv one/statistics.csv

# Of another run, by its parameters.
cp "other/$(basename "$last")" "$last"
"$program" --resume one --quiet >out.txt 2>&1
grep -q "other parameters" out.txt
rm -f one/checkpoint-*.h5
refused "nothing is left to do" --resume one
