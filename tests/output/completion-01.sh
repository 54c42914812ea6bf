# Completion in bash: options, parameter files, sections of --help, and paths of --set with
# the names that the parameter file has.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder/runs" && cd "$folder"
cat >slope.prm <<'TEXT'
subsection Materials # comment
  set Names = clay, sand
  subsection clay
    set Cohesion = 5e3 # end
  end
  subsection sand
  end
end
TEXT
touch notes.txt
. "$root/packaging/completion.bash"
complete -p geocone | grep -q _geocone
completed() { # WORD...: proposals for the last one
  COMP_WORDS=(geocone "$@") COMP_CWORD=$#
  _geocone "$program" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}" || true
  printf '%s\n' "${COMPREPLY[@]}"
}
completed --sch | grep -qx -- --schema
[ "$(completed -- | wc -l)" -ge 12 ]
[ "$(completed '' | sort | xargs)" = 'runs slope.prm' ]
[ "$(completed --output '')" = runs ]
[ "$(completed --help Ti)" = 'Time stepping' ]
[ "$(completed --help 'Time\ ')" = 'Time stepping' ]
[ "$(completed --help "'Boundary c")" = 'Boundary conditions' ]
[ "$(completed --help '' | wc -l)" = \
  "$("$program" --help | sed '1,/^Sections/d' | grep -c '^  [A-Z]' | awk '{ print $1 + 1 }')" ]
[ "$(completed --set 'Materials/NAME/Coh' | sed -n 1p)" = Materials/NAME/Cohesion ]
completed slope.prm --set "'Materials/" >said
[ "$(grep -c '/Cohesion$' said)" = 2 ] && grep -qx Materials/sand/Cohesion said
fails grep -q NAME said
[ "$(completed slope.prm --set 'Time\ stepping/Fr')" = 'Time stepping/Friction' ]
