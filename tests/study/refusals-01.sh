# Wrong study files are refused before anything is computed, with what is allowed.
program=$1 source=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cp "$source/prm/footing.prm" .
group='[[group]]
name = "a"
file = "footing.prm"'

refuse() { # text of the message, study file
  echo "$2" >study.toml
  if "$source/scripts/study" study.toml --program "$program" --output results 2>log; then
    echo "accepted: $2"
    exit 1
  fi
  grep -qF "$1" log || { cat log; exit 1; }
  [ ! -e results ]
}

refuse "there is no [[group]] of runs" 'title = "none"'
refuse "unknown key 'titel' in the study" "titel = 'x'
$group"
refuse "unknown key 'fiel' in the group 'a'" "$group
fiel = 'x'"
refuse "the group 'a' has no file" '[[group]]
name = "a"'
refuse "file = 'none.prm'" '[[group]]
name = "a"
file = "none.prm"'
refuse "'PARAMETER = VALUE'" "$group
set = ['Mesh/Cell size']"
refuse "the axis 'Mesh/Cell size' is empty" "$group
vary = {'Mesh/Cell size' = []}"
refuse "two runs are named 'a'" "$group
$group"
refuse "unknown group 'b'" "$group
[[section]]
title = 'x'
[[section.figure]]
kind = 'speed.work_precision'
groups = ['b']"
refuse "ranks = 0" "$group
ranks = 0"
refuse "'{psi/2}' in the setting" "$group
set = ['Materials/soil/Dilatancy angle = {psi/2}']"
refuse "is no TOML file" "$group
name ="
refuse "unknown figure or table 'speed.none'" "$group
[[section]]
[[section.figure]]
kind = 'speed.none'"
