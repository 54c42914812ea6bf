# A study replaces and deletes only what studies and their runs have written: no file that
# somebody else has put into its folders, nothing behind a link, nothing outside.
program=$1 source=$2 folder=$3
. "$source/tests/fails.sh"
rm -rf "$folder"
mkdir -p "$folder/foreign/sub" "$folder/work"
cd "$folder/work"
cp "$source/prm/footing.prm" .
echo mine | tee ../foreign/{data,a.json,files.txt,report.html,one.csv} ../foreign/sub/data >/dev/null
cat >one.toml <<'END'
title = "One"
[[group]]
name = "a"
file = "footing.prm"
set = ["Mesh/Type = uniform", "Mesh/Cell size = 0.2", "Output/Fields = false", "Output/Pictures = false", "Loading/push/Duration = 0.02"]
[[section]]
title = "Loads"
[[section.figure]]
kind = "figures.load_displacement"
END
state() { # of all that is not the study's
  (cd "$folder" && find foreign work/*.toml work/*.prm -exec stat -c '%n %F' {} + | sort
    find foreign work/*.toml work/*.prm -type f -exec sha256sum {} +)
}
before=$(state)
untouched() {
  [ "$(state)" = "$before" ] || { diff <(echo "$before") <(state); exit 1; }
}
study() {
  "$source/scripts/study" "$@" --program "$program" --cores 1 >out 2>log
}
refused() { # text of the message, arguments
  fails study "${@:2}"
  grep -qF -- "$1" log && grep -q '  remedy:  ' log || { cat log; exit 1; }
  untouched
}

# Names that lead out of the folder.
sed 's/"a"/".."/' one.toml >up.toml
cp one.toml ...toml
before=$(state)
refused "name = '..'" up.toml --output results
refused "named '..'" ...toml --output results
[ ! -e results ]

# An output folder that no study has made, itself or by a link.
refused "no study has made it" one.toml --output ../foreign
ln -s ../foreign link
refused "no study has made it" one.toml --output link

study one.toml --output results
grep -q '1/1 done: a' log
[ -e results/.study ] && [ -e results/runs/one/a/files.txt ]
study one.toml --output results
grep -q '1/1 done: 1 there from before' log

# Links in the place of its folders, and of files while they are written.
again() { # a study whose run has changed
  sed -i "s/Duration = 0.0./Duration = 0.0$1/" one.toml
  before=$(state)
}
again 3
mv results/runs/one/a kept
ln -s ../../../../foreign results/runs/one/a
refused "not the folder of a run" one.toml --output results
rm results/runs/one/a
mv results/runs/one kept-one
ln -s ../../../foreign results/runs/one
refused "is a link" one.toml --output results
rm results/runs/one
mv kept-one results/runs/one
mv kept results/runs/one/a
rm -r results/figures
ln -s ../../foreign results/figures
refused "is a link" one.toml --output results
rm results/figures
again 4
for file in one.csv report.html one.md runs/one/a.json; do
  ln -s "$folder/foreign/data" "results/$file.part"
done
rm results/one.csv
ln -s "$folder/foreign/one.csv" results/one.csv
study one.toml --output results
untouched
[ ! -L results/one.csv ] && grep -q finished results/one.csv

# What somebody has put into the folder of a run, or in the place of its list.
again 5
for file in notes points-9.vtu summary.json.part.part; do
  touch "results/runs/one/a/$file"
  refused "is not in the list files.txt" one.toml --output results
  [ -e "results/runs/one/a/$file" ] && [ -e results/runs/one/a/summary.json ]
  rm "results/runs/one/a/$file"
done
mkdir results/runs/one/a/log.txt.part
refused "is not in the list files.txt" one.toml --output results
rmdir results/runs/one/a/log.txt.part
mv results/runs/one/a/files.txt list
printf '%s\n' .. ../../../../../foreign/data "$folder/foreign/data" . '' >>list
ln -s "$folder/work/list" results/runs/one/a/files.txt
refused "is not in the list files.txt" one.toml --output results
rm results/runs/one/a/files.txt
mv list results/runs/one/a/files.txt
# What a list names elsewhere is not deleted.
touch results/runs/one/a/log.txt.part
study one.toml --output results
untouched
grep -q '1/1 done: a' log

# Two studies, and a run that goes on, in one folder.
again 6
sed 's/Duration = 0.0./Duration = 1e6/' one.toml >endless.toml
cp endless.toml one.toml
"$source/scripts/study" one.toml --program "$program" --cores 1 --output results 2>first &
pid=$!
for _ in $(seq 600); do
  grep -qs '"status": "running"' results/runs/one/a/summary.json && break
  sleep 0.1
done
before=$(state)
refused "another study is being computed" one.toml --output results
kill -KILL $pid
wait $pid || true
refused "the run 'a' goes on" one.toml --output results
run=$(/usr/bin/python3 -c 'import json; print(json.load(open("results/runs/one/a/summary.json"))["run"]["pid"])')
kill -TERM "$run"
