# Help on sections and parameters, and the schema: a parameter that is missing from them, or
# whose default does not fit its own schema, could not be found or set.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
sections() { grep -o '^subsection .*' "$1" | sed 's/subsection //'; }
"$program" --help >help
grep -q -- '--schema' help
fails grep -q 'subsection' help
"$program" --help all >all
for word in 'Friction angle' 'Cell size' 'Growth factor' 'Expectations' 'Swelling index kappa' \
  'Globalisation' 'Velocity x' 'Traction y' 'Incoming velocity x' 'Restitution' '1\. return map'; do
  grep -q "$word" all || { echo "no $word in --help all"; exit 1; }
done
# Every section is described by --help, in the same order.
sections all >order
sed -n '/^Sections/,$s/^  \([A-Z][A-Za-z ]*[a-z]\)   *.*/\1/p' help | cmp - order
[ "$(head -1 order)" = Analysis ] && [ "$(tail -1 order)" = Output ]
fails grep -q '^# [A-Z][a-z ]*: \.' all

"$program" --help Materials >said
[ "$(sections said)" = Materials ]
grep -q 'set Cohesion ' said
grep -q 'Used with Materials/NAME/Type = subloading' said
for topic in 'Time stepping/Friction' 'time stepping/friction'; do
  "$program" --help "$topic" >said
  [ "$(grep -c '^ *set ' said)" = 1 ]
  grep -q '^  set Friction = automatic$' said
done
"$program" --help Boundary conditions >said
[ "$(sections said)" = 'Boundary conditions' ]
for topic in Cohesion materials/cohesion Materials/clay/Cohesion; do
  "$program" --help "$topic" >said
  [ "$(grep -c '^ *set ' said)" = 1 ] && grep -q '^    set Cohesion = ' said
done
"$program" --help Names >said # one of each list
[ "$(grep -c '^  set Names = ' said)" -ge 7 ]
"$program" --help Newton | grep -q '1\. return map'
"$program" --help Mesh | fails grep -q '1\. return map'

refused() { # TOPIC SUGGESTION
  fails "$program" --help "$1" >out 2>err
  [ ! -s out ] && grep -q "did you mean '$2'?" err
  grep -q 'allowed: .*Analysis, Discretisation, Geometry' err
}
refused Materialls Materials
refused 'Newton/Tolerence' 'Newton/Tolerance'
refused 'Friction angel' 'Friction angle'
fails "$program" --help Tractions/Cohesion 2>err
fails "$program" --help Zzz 2>err
grep -q "remedy:  'geocone --help' describes the sections" err

# In three dimensions.
"$program" --help 'Velocity z' --set 'Geometry/Dimension = 3' | grep -q 'set Velocity z = free'
fails "$program" --help 'Velocity z' 2>err

# The schema is valid, and so are the defaults; it has the parameters of --help all.
"$program" --schema >schema.json
"$program" --schema --set 'Geometry/Dimension = 3' >schema_3d.json
/usr/bin/python3 -B "$root/tests/output/schema.py" schema.json all
"$program" --help all --set 'Geometry/Dimension = 3' >all_3d
/usr/bin/python3 -B "$root/tests/output/schema.py" schema_3d.json all_3d
