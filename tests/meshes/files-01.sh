# The meshes that a script makes are those that it makes now, byte by byte; all meshes
# stand in the table of their folder, and all that examples read are there.
root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cp "$root/meshes/two_bodies.py" .
/usr/bin/python3 -B two_bodies.py
[ "$(ls ./*.msh | wc -l)" = 5 ]
for mesh in *.msh; do
  cmp "$mesh" "$root/meshes/$mesh"
done
for mesh in "$root"/meshes/*.*; do
  name=$(basename "$mesh")
  [ "$name" = README.md ] || grep -q "\`$name\`" "$root/meshes/README.md"
done
[ -z "$(find "$root/prm" -name '*.msh' -o -name '*.geo' -o -name '*.py')" ]
find "$root/prm" -name '*.prm' | while read -r scene; do
  sed -n 's/^ *set File *= *\([^ #]*\.\(msh\|geo\)\).*/\1/p' "$scene" |
    while read -r mesh; do
      [ -f "$(dirname "$scene")/$mesh" ]
    done
done
