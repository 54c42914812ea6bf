#!/usr/bin/env bash
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# compare.sh PROGRAM ARGUMENT EXPECTED RANKS FOLDER
# Runs the program in an empty folder and compares with EXPECTED what it writes to a file
# "output", or else to the screen.
set -u
rm -rf "$5"
mkdir -p "$5"
cd "$5" || exit 1
export OMP_NUM_THREADS=2 OMPI_MCA_rmaps_base_oversubscribe=1
if [ "$4" -gt 1 ]; then
  mpirun -np "$4" "$1" "$2" >stdout 2>&1
else
  "$1" "$2" >stdout 2>&1
fi
code=$?
[ -f output ] || mv stdout output
show() {
  echo "--- $1"
  cat "$2"
}
if [ $code -ne 0 ]; then
  echo "exit code $code"
  show "written" output
  [ ! -f stdout ] || show "on the screen" stdout
  exit 1
fi
# Below 1e-6 all is zero. The signs and blanks stand between numbers.
if ! numdiff -a 1e-6 -r 1e-8 -s ' \t\r\n=,:;<>[](){}^' "$3" output >differences; then
  show "differences, of which these are the first lines" <(head -n 20 differences)
  show "expected" "$3"
  show "written" output
  exit 1
fi
