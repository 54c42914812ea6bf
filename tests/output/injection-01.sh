# Texts from outside are never executed: neither as a shell's commands nor by what is
# done with names of folders.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/footing_coarse.prm" --quiet \
    --set 'Output/Report for tests = none' --set 'Loading/push/Duration = 0.02' "$@"
}
name="out/inj'; echo PWNED > marker; echo '"
run --set "Output/Folder = $name" --set 'Output/Pictures = true'
[ -s "$name/summary.json" ] && [ -s "$name/load_displacement.png" ]
run --set 'Output/Folder = out/$(touch marker)`touch marker`' --set 'Output/Pictures = true'
[ ! -e marker ] && [ -z "$(find . -name marker)" ]
# A folder that looks like an option of the program that draws.
run --output -dash --set 'Output/Pictures = true'
[ -s ./-dash/load_displacement.png ]

# The help writes no file, above all not through a link that somebody has laid.
mkdir tmp
for pid in $(seq $$ $(($$ + 300))); do ln -s "$PWD/victim" "tmp/geocone-$pid.prm"; done
TMPDIR=$PWD/tmp "$program" --help all >help
TMPDIR=$PWD/tmp "$program" --defaults all.prm
[ ! -e victim ] && [ -z "$(find tmp -type f -name '*geocone*')" ]

# One line of --set sets one parameter.
if run --output lines --set 'Materials/soil/Cohesion = 1
end
end
subsection Output
set Folder = elsewhere' 2>err; then exit 1; fi
grep -q 'cannot be understood' err && [ ! -e elsewhere ] && [ ! -e lines ]
