#!/usr/bin/env bash
# check_all.sh PROGRAM FOLDER WORK
# Has all parameter files of a folder checked by one call of the program, and parts what
# it says into a file for each, NAME.checked: 'right', or the error.
set -u
rm -rf "$3"
mkdir -p "$3"
cp "$2"/*.msh "$3" 2>/dev/null
cd "$3" || exit 1
"$1" --check "$2"/*.prm >all 2>stderr
code=$?
if [ $code -gt 1 ]; then
  echo "exit code $code"
  cat stderr
  exit 1
fi
awk -v folder="$2/" '
  index($0, folder) == 1 {
    name = substr($0, length(folder) + 1)
    verdict = name
    sub(/\.prm: .*/, "", name)
    sub(/.*\.prm: /, "", verdict)
    file = name ".checked"
    if (verdict == "right")
      print verdict > file
    next
  }
  { print > file }' all
n_files=$(find "$2" -maxdepth 1 -name '*.prm' | wc -l)
n_checked=$(find . -name '*.checked' | wc -l)
if [ "$n_files" != "$n_checked" ] || [ -e results ]; then
  echo "$n_checked of $n_files files were checked"
  ls
  tail -n 5 all stderr
  exit 1
fi
