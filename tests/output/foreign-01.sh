# What is not the run's is neither replaced nor deleted nor written through: files of names
# that runs use, links, checkpoints of other numbers; --defaults writes a new file only.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/footing_coarse.prm" --quiet --output a \
    --set 'Output/Report for tests = none' --set 'Output/Pictures = false' \
    --set 'Loading/push/Duration = 0.06' "$@"
}
over=(--set 'Output/If folder exists = overwrite')
refused() { # TEXT CALL...
  if "${@:2}" 2>said; then exit 1; fi
  grep -q "$1" said && grep -q '^  remedy:' said || { cat said; exit 1; }
}

echo mine >new.prm
refused "'--defaults' = 'new.prm'" "$program" --defaults new.prm
[ "$(cat new.prm)" = mine ]
ln -s nowhere.prm link.prm
refused "'--defaults' = 'link.prm'" "$program" --defaults link.prm
[ ! -e nowhere.prm ]
"$program" --defaults newer.prm
grep -q "subsection Geometry" newer.prm

# Before anything of the run before is deleted.
run
cp -r a before
for name in report.html cells.pvd points-0003.vtu checkpoint-000100.h5 surfaces.csv; do
  echo mine >"a/$name"
  refused "its file '$name' is not in the files.txt" run "${over[@]}"
  [ "$(cat "a/$name")" = mine ]
  rm "a/$name"
  diff -r a before
done
mkdir a/parameters.prm.part
refused "its folder 'parameters.prm.part' is not in the files.txt" run "${over[@]}"
rmdir a/parameters.prm.part
diff -r a before
# Other names stay, as do foreign files that a run meets only later.
echo mine >a/checkpoint-9.h5
echo mine >a/notes.pvd
run "${over[@]}" --set 'Checkpoint/Every steps = 1' --set 'Checkpoint/Keep = 1'
[ "$(cat a/checkpoint-9.h5 a/notes.pvd)" = "$(printf 'mine\nmine')" ]
[ "$(ls a/checkpoint-0*.h5 | wc -l)" = 1 ]
rm a/checkpoint-9.h5

# A foreign checkpoint of a later step does not make a run delete its own.
last=$(ls a/checkpoint-0*.h5)
echo mine >a/checkpoint-999999.h5
"$program" --resume a --quiet
[ "$(cat a/checkpoint-999999.h5)" = mine ] && [ -s "$last" ]
rm a/checkpoint-999999.h5

# Links: of what is listed, of a table that goes on, of a part.
echo mine >outside
for name in statistics.csv log.txt summary.json; do
  mv "a/$name" kept
  ln -s "$PWD/outside" "a/$name"
  refused "$name" "$program" --resume a --quiet
  [ "$(cat outside)" = mine ]
  rm "a/$name"
  mv kept "a/$name"
done
ln -s "$PWD/outside" a/summary.json.part
"$program" --resume a --quiet
[ "$(cat outside)" = mine ] && [ ! -L a/summary.json ] && [ ! -e a/summary.json.part ]
# A folder in the place of a file is met before a table is cut.
mkdir a/newton.csv.part
cp -r a before_part
refused "'newton.csv.part' is a folder" "$program" --resume a --quiet
diff -r a before_part
