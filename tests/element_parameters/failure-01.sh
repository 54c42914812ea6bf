# A path that the material cannot follow, and wrong calls.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
# Mohr-Coulomb carries 334.6 kPa at most: 400 kPa end at 0.78 of the way from 100.
if "$program" "$root/prm/element/biaxial_mohr_coulomb.prm" --quiet \
  --set 'Path/Names = load' --set 'Path/load/Stress yy = -400e3' \
  --set 'Path/load/Stress xx = constant' --set 'Output/Expectations =' \
  --set 'Output/Pictures = false' --output run 2>err; then
  echo "a stress beyond the strength was reached"
  exit 1
fi
grep -q "error: the stage 'load' cannot be followed beyond f = 0.78" err
grep -q 'remedy' err
grep -q '"status": "failed: the stage' run/summary.json
grep -q 'p (Pa)' run/path.csv
# The states up to there are kept: the start and 78 of 100 increments.
[ "$(wc -l <run/path.csv)" -eq 80 ]
# Expectations decide the exit code.
if "$program" "$root/prm/element/undrained_triaxial.prm" --quiet --output no \
  --set 'Output/Pictures = false' --set 'Path/compression/Increments = 20' \
  --set 'Output/Expectations = final/q_Pa <= 1' 2>err; then
  echo "an expectation that does not hold was passed over"
  exit 1
fi
grep -q 'expected final/q_Pa <= 1: NO' err
# The command line.
"$program" --version | grep -q '^geocone [0-9]'
"$program" --help all >help
for word in 'Swelling index kappa' 'Stop when' 'Initial specific volume'; do
  grep -q "$word" help || { echo "no $word in --help all"; exit 1; }
done
"$program" --defaults new.prm
grep -q '^ *# .*Pa' new.prm
"$program" new.prm --quiet --output new --set 'Path/loading/Kind = oedometric' \
  --set 'Path/loading/Amount = -0.01'
[ -s new/summary.json ] && [ -s new/stress_strain.png ] && [ -s new/stress_path.png ]
[ -s new/compression.png ] && [ -s new/ratios.png ]
for call in '' no_such_file.prm --no-such-option --set; do
  if "$program" $call >out 2>err; then
    echo "not refused: $call"
    exit 1
  fi
  grep -q '^error: ' err
done
