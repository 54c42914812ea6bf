# The Python package that pip installs from its folder would have another version than the
# program, lack its templates, or fail with an unexplained traceback where the program or a
# module of others is not there.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder/source" && cd "$folder"
cp -r "$root/python" "$root/CMakeLists.txt" source # pip writes beside what it installs
export PYTHONDONTWRITEBYTECODE=1 PIP_NO_INDEX=1 PIP_NO_CACHE_DIR=1 PATH=/usr/bin:/bin
unset PYTHONPATH GEOCONE
/usr/bin/python3 -m venv --without-pip --system-site-packages env
/usr/bin/python3 -m pip --python env/bin/python install --no-build-isolation --no-deps \
  ./source/python > said 2>&1
for file in plots/run.html report/page.html py.typed; do
  [ -f env/lib/python3*/site-packages/geocone/$file ]
done
[ "geocone $(env/bin/python -c \
  'import importlib.metadata; print(importlib.metadata.version("geocone"))')" = \
  "$("$program" --version | head -1 | grep -o '^geocone [0-9.]*')" ]

# The program: the environment variable, the prefix, the PATH, or how to get it.
place() { env/bin/python -c 'import geocone; print(geocone.find_program())'; }
fails place 2> said
grep -q "there is no program 'geocone'; looked for: .*, PATH$" said
grep -q 'scripts/build .* GEOCONE' said
mkdir bin env_program
ln -s "$program" bin/geocone
[ "$(PATH=$folder/bin:$PATH place)" = "$(readlink -f "$program")" ]
[ "$(GEOCONE=$program place)" = "$(readlink -f "$program")" ]
GEOCONE=$folder/none fails place 2> said
grep -q "looked for: $folder/none$" said
GEOCONE=$program env/bin/python - <<'PYTHON'
import geocone
run = geocone.run(geocone.example("element/cam_clay.prm"), {"Output/Pictures": False})
assert run.status == "finished"
PYTHON
cat > none.py <<'PYTHON'
import geocone
try:
    geocone.run("any.prm")
    raise AssertionError
except geocone.RunFailed as problem:
    assert str(problem).startswith("there is no program 'geocone'"), problem
    assert "remedy: build it by scripts/build" in str(problem)
PYTHON
env/bin/python none.py

# Modules of others.
cat > missing.py <<'PYTHON'
import sys
sys.modules.update(dict.fromkeys(["numpy", "meshio", "h5py"][int(sys.argv[1]):]))
try:
    import geocone
    geocone.modules.require("meshio")
    raise AssertionError
except ImportError as problem:
    print(problem)
PYTHON
for i in 0 1; do
  name=$([ $i = 0 ] && echo numpy || echo meshio)
  env/bin/python missing.py $i > said
  grep -q "geocone needs the Python module '$name', which $folder/env/bin/python" said
  grep -q "apt-get install python3-$name .* -m pip install $name$" said
done
