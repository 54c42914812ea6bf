# Wrong study files are refused before anything is computed, in one message: the place, the
# key and its value, what is allowed, and a remedy.
program=$1 source=$2 folder=$3
. "$source/tests/fails.sh"
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cp "$source/prm/footing.prm" .
study() {
  timeout 60 "$source/scripts/study" "$@" --program "$program" --output results 2>log
}
cat >study.toml <<'END'
[[group]]
name = "a"
file = "footing.prm"
repeat = 99999999999999999999
END
fails study study.toml
diff - log <<END
error: $PWD/study.toml: the group 'a': repeat = 99999999999999999999
  allowed: a whole number from 1 to 10000
  remedy:  correct it in the study file; doc/studies.md explains the keys, studies/quick.toml is an example
END
sed -i 's/repeat.*/repeat = 2/' study.toml
mkdir other
cp study.toml footing.prm other
fails study study.toml other/study.toml
grep -q "has the same name" log
[ ! -e results ]

PYTHONPATH=$source/python /usr/bin/python3 -B "$source/tests/study/refusals.py"
