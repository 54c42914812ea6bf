# submerged-01.sh PROGRAM SOURCE FOLDER NUMDIFF
# Water at rest above a slope as a line, as a file of pressures, and as the flow between equal
# levels: the same bracket.
rm -rf "$3"
mkdir -p "$3"
cd "$3"
bracket() {
  "$1" "$2" --output "$3" --quiet --set 'Output/Report for tests = none' "${@:4}" >/dev/null
  grep -E '"(lower|upper)"' "$3/summary.json" | sort -u
}
file=$2/tests/limit_load/water_file-01.prm
bracket "$1" "$file" line --set 'Water/File =' --set 'Water/Table = 0, 12' >line.txt
bracket "$1" "$file" file >file.txt
bracket "$1" "$2/tests/seepage/submerged.prm" flow >flow.txt
[ -s line.txt ]
"$4" -a 1e-9 -s ' \t\n,:' line.txt file.txt
"$4" -a 1e-9 -s ' \t\n,:' line.txt flow.txt
