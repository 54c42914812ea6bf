# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Completion of geocone's options, parameter files, sections (--help) and paths of
# parameters (--set) in bash.

# Sections of parameters.
_geocone_sections() { # PROGRAM
  "$1" --help 2>/dev/null | sed -n '/^Sections/,$s/^  \([^ ].*[^ ]\)   *[^ ].*$/\1/p' |
    sed 's/   .*//'
}

# Paths of all parameters; members of lists are those of FILE.prm, or else 'NAME'.
_geocone_paths() { # PROGRAM FILE.prm
  "$1" --help all 2>/dev/null | awk -v file="$2" '
    function rest(line) { sub(/^[ \t]*[a-z]+ /, "", line); return line }
    BEGIN {
      while (file != "" && (getline line < file) > 0) {
        sub(/[ \t\r]*(#.*)?$/, "", line)
        if (line ~ /^[ \t]*subsection /) {
          section[++depth] = rest(line)
          if (depth == 2 && !known[section[1], section[2]]++)
            names[section[1]] = names[section[1]] "\n" section[2]
        }
        else if (line ~ /^[ \t]*end$/)
          --depth
      }
      depth = 0
    }
    $1 == "subsection" { section[++depth] = rest($0) }
    $1 == "end" { --depth }
    $1 == "set" {
      name = rest($0)
      sub(/ *=.*/, "", name)
      if (depth == 1)
        print section[1] "/" name
      else {
        n = split(section[1] in names ? names[section[1]] : "\n" section[2], members, "\n")
        for (i = 2; i <= n; ++i)
          print section[1] "/" members[i] "/" name
      }
    }'
}

_geocone() { # PROGRAM WORD PREVIOUS
  local word=${COMP_WORDS[COMP_CWORD]} file=
  # The names of sections have blanks, which are quoted.
  word=${word#[\'\"]}
  word=${word//\\/}
  local choices=()
  compopt -o filenames 2>/dev/null
  case $3 in
    --help | -h) mapfile -t choices < <(_geocone_sections "$1" && echo all) ;;
    --set)
      for file in "${COMP_WORDS[@]}"; do
        [[ $file == *.prm ]] && break
        file=
      done
      mapfile -t choices < <(_geocone_paths "$1" "$file")
      compopt -o nospace 2>/dev/null
      ;;
    --output | --resume) mapfile -t choices < <(compgen -d -- "$word") ;;
    *)
      if [[ $word == -* ]]; then
        mapfile -t choices < <("$1" --help 2>/dev/null | grep -o -- '--[a-z][a-z-]*' | sort -u)
      else
        mapfile -t choices < <(compgen -f -X '!*.prm' -- "$word" && compgen -d -- "$word")
      fi
      ;;
  esac
  COMPREPLY=()
  for choice in "${choices[@]}"; do
    [[ $choice == "$word"* ]] && COMPREPLY+=("$choice")
  done
}
complete -F _geocone geocone
