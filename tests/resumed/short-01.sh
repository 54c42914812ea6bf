# A run of each method is killed, or stopped, and resumed: on the same ranks, on others,
# from the checkpoint before a damaged one.
program=$1 root=$2 folder=$3
rm -rf "$folder" # runs without a break are kept there
/usr/bin/python3 "$root/tests/resumed/trial.py" "$program" --output "$folder" --seed 1 \
  --cases fem:kill:1 mpm:truncate:1 mpm:terminate:1 explicit:ranks:1 obstacle:kill:1 point:kill:1 \
  three:kill:1 'three explicit:ranks:1' slide:ranks:2 two-phase:kill:1
