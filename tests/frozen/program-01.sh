# geocone-lab: what it is called with, and what it has no use for, is refused by name, as is
# the option of geocone that it was before.
program=$1 lab=$(dirname "$1")/geocone-lab root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
file=$root/tests/frozen/plasticity_2d_footing_100.dat
fails "$program" --replay "$file" 2>err
grep -q 'remedy:  geocone-lab FILE' err
for option in --dry-run --force --resume --check --defaults --run-gmsh-script; do
  fails "$lab" $option "$file" 2>err
  grep -q "unknown option '$option'" err
  grep -q 'remedy:  see geocone-lab --help' err
done
fails "$lab" 2>err
grep -q 'error: no file of a problem' err
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fails mpirun --oversubscribe -np 2 "$lab" "$file" 2>err
grep -q 'geocone-lab works on one rank' err
"$lab" --help | grep -q '^geocone-lab FILE.h5'
"$lab" --version | grep -q '^geocone-lab [0-9]'
"$lab" --quiet "$file" >log
[ ! -s log ] && [ ! -e results ]
# Several: each has its folder, an error in one does not concern the others, and two of one
# name are refused.
"$lab" --quiet "$file" "$root/tests/frozen/arch_30.dat" --output two --set 'Newton/Tolerance = 1e-8'
[ -f two/plasticity_2d_footing_100/summary.json ] && [ -f two/arch_30/summary.json ]
fails "$lab" --quiet none.h5 "$file" --output one 2>err
[ "$(head -1 err)" = none.h5: ] && grep -q '^error: ' err
[ -f one/plasticity_2d_footing_100/summary.json ] && [ ! -e one/none ]
mkdir other && cp "$file" other
fails "$lab" "$file" other/*.dat --output same 2>err
grep -q 'would have the same folder' err && [ ! -e same ]
