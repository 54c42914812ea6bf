# Libraries that are not allowed, not there, not libraries, or without the function are
# refused by name before anything is written; so is a wrong number of state variables.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
echo 'int other(void) { return 0; }' >law.c
cc -shared -fPIC -o law.so law.c
echo 'no library' >text.so
scene() { # NAME LINES
  printf 'include %s\nsubsection Materials\n subsection soil\n  set Type = umat\n%s\n end\nend\n' \
    "$root/tests/umat/block.prm" "$2" >"$1.prm"
}
scene absent '  set Library = absent.so'
scene text '  set Library = text.so'
scene function '  set Library = law.so'
scene state '  set Library = law.so
  set State variables = 1, 2'
refused() { # TEXT FILE...
  if "$program" "${@:2}" >error 2>&1; then exit 1; fi
  grep -q "$1" error || { cat error; exit 1; }
}
for option in --dry-run --check; do
  refused "Materials/soil/Library' = 'law.so'" $option function.prm
  refused 'give the option --load-library' $option function.prm
done
if "$program" --load-library --check absent.prm text.prm function.prm state.prm >errors 2>&1; then
  exit 1
fi
for text in "Library' = 'absent.so'" 'the system says: .*text.so' "Function' = 'umat'" \
  "State variables' = '2 values'"; do
  grep -q "$text" errors || { cat errors; exit 1; }
done
[ ! -e results ]
