# The files of doc/changes are as they must be and join the change log in order of kind, those
# that change results first; names, first lines and sentences that are wrong are refused. The
# version is the same in all its places, and a release sets all of them.
root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder/doc/changes" && cd "$folder"
"$root/scripts/changes" --check > said
fails grep -qv '^changes: [0-9]* unreleased$' said
changes() {
  /usr/bin/python3 -B "$root/scripts/changes" "$@" "$folder"
}
(cd "$root" && cp --parents CMakeLists.txt CITATION.cff packaging/README.md \
  packaging/conda/meta.yaml packaging/spack/package.py "$folder")
printf '# Changes\n\nNewest first.\n\n## 0.1.0 - 2026-01-01\n\n### Added\n\n- All.\n' > CHANGELOG.md
[ -z "$(changes)" ]
fails changes --release 7.8.9 2> said
printf 'fixed; results change: no\nThe first is\nfixed.\n' > doc/changes/20260102_first.md
printf 'fixed; results change: yes\nThe second is fixed.\n' > doc/changes/20260103_second.md
printf 'added\nThe third is added.\n' > doc/changes/20260104_third.md
changes > said
cat > expected <<'TEXT'
## Unreleased

### Added

- The third is added.

### Fixed

- The second is fixed. **Results change: yes.**
- The first is fixed. Results change: no.
TEXT
diff expected said
refused() { # NAME FIRST-LINE SENTENCE WORDS
  printf '%s\n%s\n' "$2" "$3" > "doc/changes/$1"
  fails changes --check 2> said
  grep -q "$1: .*$4" said
  rm "doc/changes/$1"
}
refused 20261301_month.md added 'It is.' 'the name must be'
refused Month.md added 'It is.' 'the name must be'
refused 20260105_a.md new 'It is.' 'the first line must be'
refused 20260105_a.md fixed 'It is.' "must say '; results change"
refused 20260105_a.md added 'It is' 'must be a sentence'
refused 20260105_a.md added "$(printf 'long %.0s' {1..80})." 'at most 300'
changes --release 7.8.9
[ -z "$(ls doc/changes)" ]
sed "s/Unreleased/7.8.9 - $(date +%F)/" expected > joined
printf '\n## 0.1.0 - 2026-01-01\n' >> joined
sed -n '/^## 7.8.9/,/^## 0.1.0/p' CHANGELOG.md | diff joined -
[ "$(head -3 CHANGELOG.md | tail -1)" = 'Newest first.' ]
grep -q 'project(geocone VERSION 7.8.9 ' CMakeLists.txt
[ "$(grep -c '7\.8\.9' packaging/README.md packaging/*/* CITATION.cff | grep -c ':[1-9]')" = 4 ]
sed -i 's/^version: .*/version: 7.8.8/' CITATION.cff
fails changes --check 2> said
grep -q 'the version differs: .*CITATION.cff has 7.8.8' said
