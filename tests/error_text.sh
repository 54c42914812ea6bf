#!/usr/bin/env bash
# What of the screen, read from stdin, is geocone's own error: not what mpirun, hwloc or
# muParser print around it. Which of the rows that contradict is named depends on rounding.
sed -n -e '/^error: /,$p' |
  sed -e '/^---/,$d' -e '/^Primary job/,$d' \
    -e 's/[^ ]* m\/s is asked where the others leave [^ ]* m\/s/one velocity is asked where the others leave another/'
