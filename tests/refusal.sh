#!/usr/bin/env bash
# refusal.sh PROGRAM FILE.prm EXPECTED CHECKED FOLDER
# Compares the error that check_all.sh has found with the expected one. What is wrong
# only when the run begins is run, by refused.sh.
set -u
if [ "$(head -1 "$4")" = right ]; then
  exec "$(dirname "$0")"/parameters/refused.sh "$1" "$2" "$3" 1 "$5"
fi
mkdir -p "$5"
"$(dirname "$0")"/error_text.sh <"$4" >"$5"/output
if ! numdiff -a 1e-6 -r 1e-8 "$3" "$5"/output; then
  cat "$4"
  exit 1
fi
