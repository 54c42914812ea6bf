# A pressure by a formula that ends between vertices is not the same load in both bounds, which the
# run says with its size; one that is linear between them is.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run()
{
  "$program" "$root/prm/limit_load/strip_flexible.prm" --quiet --output run \
    --set 'Output/Pictures = false' --set 'Output/Expectations =' \
    --set 'Output/If folder exists = overwrite' --set 'Analysis/Maximum levels = 1' \
    --set 'Tractions/strip/Box =' --set "Tractions/strip/Traction normal = $1" 2>said
}
run 'if(x < 1.04, -1000, 0)'
grep -q "the traction 'strip' is not linear between the vertices" said
run '-1000*max(0, 1 - x)'
if grep -q 'not linear' said; then
  cat said
  exit 1
fi
