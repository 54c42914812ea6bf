# A parameter with a new name is read by its former name, with a warning that gives both;
# the parameters as used have the present one.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/element/centre-02.prm" --quiet --output former \
  --set 'Output/Report for tests = none' --set 'Materials/clay/Output tensors = false' \
  --set 'Materials/clay/Show tensors = true' 2>err
[ "$(wc -l <err)" = 1 ]
grep -q "^warning: .*'Show tensors' (now 'Materials/clay/Output tensors')" err
head -1 former/path.csv | grep -q 'a_xx\|a xx'
grep -q 'set Output tensors *= true' former/parameters.prm
"$program" former/parameters.prm --quiet --output present 2>err
[ ! -s err ]
# Only in the sections of the parameter.
if "$program" "$root/tests/element/centre-02.prm" --set 'Element/Show tensors = true' 2>err
then exit 1; fi
grep -q "unknown parameter 'Element/Show tensors'" err
# Two names of a stage of loads.
"$program" "$root/prm/raised/footing_inclined.prm" --dry-run \
  --set 'Loading/raise/Raised loads = footing' --set 'Loading/raise/Raising velocity = 0.02' \
  >log 2>&1
grep -q "'Raised loads' (now 'Loading/raise/Scaled loads')" log
grep -q "'Raising velocity' (now 'Loading/raise/Control velocity')" log
