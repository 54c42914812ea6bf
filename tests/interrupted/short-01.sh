# A run of each method is interrupted, each in another way.
program=$1 root=$2 folder=$3
/usr/bin/python3 "$root/tests/interrupted/trial.py" "$program" --output "$folder" \
  --seed 1 --cases fem:kill:1 mpm:terminate:1 explicit:interrupt:1 fem:memory:1
