# The files of the tutorial are those of prm/tutorials; FEM, MPM and bounds of one scene have
# the errors against Prandtl's load that the page states.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B "$root/tests/tutorials/parameters.py" . footing
for file in footing_*.prm; do
  cmp "$file" "$root/prm/tutorials/$file"
done
for method in fem mpm bounds; do
  "$program" footing_$method.prm --quiet --set 'Output/Pictures = false'
done
