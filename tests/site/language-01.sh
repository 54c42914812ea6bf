# The words of code and pages pass scripts/check_language; a comment that begins with
# "What", a word of the glossary over a break of the line, and a list that allows more than
# there is are refused, and --shrink lowers such a list.
root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder/scripts" "$folder/source" && cd "$folder"
"$root/scripts/check_language" > said
touch README.md scripts/check_language.txt
printf '/**\n * Whether the wall is at rest.\n */\nint bearing_capacity;\n' > source/wall.cc
"$root/scripts/check_language" "$folder" > said
printf '/**\n * What the wall does: it gives\n * way.\n */\n' >> source/wall.cc
fails "$root/scripts/check_language" "$folder" > said
grep -q "source: 1 places of 'What', 0 allowed" said
grep -q "source: 1 places of 'give way', 0 allowed" said
grep -qx '  source/wall.cc:6' said
printf '1 source What\n2 source give way\n' > scripts/check_language.txt
fails "$root/scripts/check_language" "$folder" > said
grep -q "1 places of 'give way', but check_language.txt lists 2" said
"$root/scripts/check_language" --shrink "$folder" > said
"$root/scripts/check_language" "$folder" > said
grep -qx '1 source give way' scripts/check_language.txt
