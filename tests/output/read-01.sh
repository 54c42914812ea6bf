# What is read as a parameter file: text with a byte-order mark or the line ends of
# another system, too; no devices, folders, endless or binary files.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
sed "s#^include #include $root/tests/../#" >scene.prm <<PRM
include tests/footing_coarse.prm
subsection Loading
  subsection push
    set Duration = 0.02
  end
end
PRM
options=(--quiet --set 'Output/Report for tests = none')
{ printf '\xef\xbb\xbf'; cat scene.prm; } >mark.prm
"$program" mark.prm "${options[@]}"
sed 's/$/\r/' scene.prm >dos.prm
"$program" dos.prm "${options[@]}"
refuse() {
  if timeout 20 "$program" "$1" --quiet 2>err; then exit 1; fi
  grep -q "$2" err || { cat err; exit 1; }
  grep -q 'remedy: ' err || { cat err; exit 1; }
}
refuse /dev/zero 'is no file'
mkdir a_folder
refuse a_folder 'is no file'
mkfifo pipe
refuse pipe 'is no file'
printf 'set a = \0\1\2\n' >binary.prm
refuse binary.prm 'control characters'
head -c 17000000 /dev/zero | tr '\0' '#' >large.prm
refuse large.prm 'larger than 16 MB'
printf 'include self.prm\ninclude self.prm\n' >self.prm
refuse self.prm 'includes itself'
printf 'end\nend\n' >ends.prm
refuse ends.prm "'end' without a subsection"
printf 'subsection Rainfall\nend\n' >rainfall.prm
refuse rainfall.prm "unknown section 'Rainfall'"
fails grep -q 'did you mean' err
