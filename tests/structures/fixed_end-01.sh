# An end of a strut that lies just outside of the body is fixed, and a warning says so; one
# in the body or well outside of it raises no question.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

said() {  # POINTS
  rm -rf run
  "$program" "$root/tests/structures/elastic-01.prm" --quiet --output run \
    --set "Output/Expectations =" --set "Output/Report for tests = none" \
    --set "Structures/bar/Points = $1" >said.txt 2>&1
}

said "0.5, -0.02; 0.5, 4"
grep -q "warning: the end (0.5, -0.02) .* 'bar' .* it is fixed" said.txt
for points in "0.5, 0; 0.5, 4" "0.5, -2; 0.5, 4"; do
  said "$points"
  if grep "it is fixed" said.txt; then exit 1; fi
done
