# scripts/try_debian refuses what it cannot do before it makes or removes anything.
root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder/used" && cd "$folder"
touch used/file
refused() { # words, arguments
  words=$1
  shift
  if "$root/scripts/try_debian" "$@" > said 2>&1; then
    return 1
  fi
  grep -q "$words" said
}
refused 'usage: scripts/try_debian'
refused 'usage: scripts/try_debian' --root
if [ "$(id -u)" != 0 ] || ! command -v debootstrap > /dev/null; then
  refused 'needs root, and the package debootstrap' trixie
  exit 0
fi
refused "knows no suite 'none'" none
refused 'is neither empty nor the root of a Debian' --root used trixie
[ "$(ls used)" = file ]
[ -z "$(ls -d /var/tmp/geocone-none.* 2> /dev/null)" ]
