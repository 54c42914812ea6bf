#!/usr/bin/env bash
# refused.sh PROGRAM FILE.prm EXPECTED RANKS FOLDER
# Runs the program in an empty folder and checks that it refuses the file.
set -u
rm -rf "$5"
mkdir -p "$5"
cp "$(dirname "$2")"/*.msh "$5"
cd "$5" || exit 1
# A line '# Options: ...' of the file goes with the call.
options=$(sed -n 's/^# Options: //p' "$2")
if [ "$4" -gt 1 ]; then
  mpirun -np "$4" "$1" "$2" $options >stdout 2>stderr
else
  "$1" "$2" $options >stdout 2>stderr
fi
code=$?
"$(dirname "$0")"/../error_text.sh <stderr >output
if [ $code -ne 1 ]; then
  echo "exit code $code instead of 1"
  cat stdout stderr
  exit 1
fi
if ! numdiff -a 1e-6 -r 1e-8 "$3" output; then
  cat stderr
  exit 1
fi
if [ -e results ]; then
  echo "results were written"
  exit 1
fi
