# The command line: version, defaults that can be read back, and wrong calls that are
# refused.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" --version | grep -q '^geocone [0-9]'
"$program" --defaults new.prm
grep -q '^ *# .*degrees' new.prm
"$program" new.prm --quiet --set 'Boundary conditions/footing/Velocity y = 0' \
  --set 'Boundary conditions/footing/Velocity x = 0' \
  --set 'Boundary conditions/footing/Sides = bottom' \
  --set 'Tractions/Names =' --set 'Output/Pictures = false'
[ -s results/new/summary.json ]
refuse() {
  if "$program" "$@" >out 2>err; then
    echo "not refused: $*"
    exit 1
  fi
  grep -q '^error: ' err
}
refuse
refuse no_such_file.prm
refuse --no-such-option
refuse new.prm --set
refuse new.prm --set 'no equals sign'
refuse new.prm --set 'Mesh/No such entry = 1'
grep -q -- "--set 'Mesh/No such entry = 1'" err

# A folder that is not there any more.
mkdir gone
code=0
(cd gone && rmdir ../gone && "$program" "$root/prm/footing.prm" --dry-run) >said 2>&1 || code=$?
[ $code = 1 ] && [ "$(head -1 said | cut -c1-17)" = 'error: the folder' ] && grep -q '^  remedy:' said

# MPI's search for hardware asks no X server, unless it is told to; what else the user says
# of it counts.
components() { # VALUE...: what hwloc looks for
  env "$@" HWLOC_COMPONENTS_VERBOSE=1 "$program" "$root/prm/element/cyclic_shear.prm" \
    --dry-run 2>&1 | grep 'Final list' || true
}
components -u HWLOC_COMPONENTS >said
fails grep -q '[:,] *gl(' said
components HWLOC_COMPONENTS=x86 >said
fails grep -q '[:,] *gl(' said
[ ! -s said ] || grep -q ': x86(' said
