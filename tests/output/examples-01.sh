# The examples set nothing that their own run does not use.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" --check --load-library --run-gmsh-script $(find "$root/prm" -name '*.prm') >said 2>&1 || true
[ "$(grep -c ': right$' said)" -gt 150 ]
if grep 'not used by this run' said; then exit 1; fi
