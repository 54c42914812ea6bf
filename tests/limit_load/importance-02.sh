# If this failed, the limits of importance sampling would not contain the exact probability as often as
# they state: of 20 seeds each, for P = 1e-3 and 1e-5 (reliability-04.prm), all contain it with the
# confidence 0.999 (the probability of a miss is 2 % for 20 seeds).
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for cohesion in 103454.4 146052.8; do
  for seed in $(seq 20); do
    "$program" "$root/tests/limit_load/reliability-04.prm" --quiet \
      --set "Materials/soil/Cohesion = $cohesion" --set "Random fields/Seed = $seed" \
      --set 'Output/Expectations =' --set 'Output/Report for tests = none' \
      --output "$cohesion-$seed" 2> /dev/null
  done
done
/usr/bin/python3 - <<'PYTHON'
import json
for cohesion, exact in (("103454.4", 1e-3), ("146052.8", 1e-5)):
    found = [json.load(open(f"{cohesion}-{seed}/summary.json"))["reliability"]
             for seed in range(1, 21)]
    assert all(one["undecided"] <= 2 for one in found)
    inside = sum(one["limit_lower"] <= exact <= one["limit_upper"] for one in found)
    print(cohesion, inside)
    assert inside == 20, (cohesion, inside)
PYTHON
