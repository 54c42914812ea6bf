#!/usr/bin/env bash
# stopped.sh PROGRAM FILE.prm EXPECTED RANKS FOLDER
# Runs the program in an empty folder and checks that the run ends as expected.
set -u
rm -rf "$5"
mkdir -p "$5"
cd "$5" || exit 1
if [ "$4" -gt 1 ]; then
  timeout 60 mpirun -np "$4" "$1" "$2" >stdout 2>stderr
else
  timeout 60 "$1" "$2" >stdout 2>stderr
fi
code=$?
# What mpirun prints around the message is not ours.
sed -n -e '/^error: /,$p' stderr |
  sed -e '/^---/,$d' -e '/^Primary job/,$d' -e '/^\[[^ ]*:[0-9]*\]/d' >report
if [ $code -ne 1 ]; then
  echo "exit code $code instead of 1"
  cat stdout stderr
  exit 1
fi
if ! numdiff -a 1e-6 -r 1e-6 "$3" report; then
  exit 1
fi
if ! grep -q '"status": "failed: ' results/*/summary.json; then
  echo "the summary does not tell that the run has failed"
  exit 1
fi
