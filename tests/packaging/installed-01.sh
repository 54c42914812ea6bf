# After "cmake --install" Python imports geocone without PYTHONPATH, from a prefix in which
# it looks for modules, runs the program beside it, and finds the examples; twice is as once.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder/home" && cd "$folder"
export HOME=$folder/home PYTHONDONTWRITEBYTECODE=1
unset PYTHONPATH PYTHONNOUSERSITE
fails /usr/bin/python3 -c 'import geocone' 2> said
grep -q "No module named 'geocone'" said
for time in first second; do
  cmake --install "$(dirname "$program")" --prefix "$HOME/.local" > said
done
[ "$(grep -c 'site-packages/geocone$' said)" = 1 ]
/usr/bin/python3 - <<'PYTHON'
import os, pathlib
import geocone
home = pathlib.Path(os.environ["HOME"])
assert pathlib.Path(geocone.__file__).resolve().is_relative_to(home / ".local/share/geocone")
from geocone.runner import find_program
assert find_program() == home / ".local/bin/geocone"
file = geocone.example("element/cam_clay.prm")
assert file == home / ".local/share/doc/geocone/examples/element/cam_clay.prm"
run = geocone.run(file, {"Output/Pictures": True})
assert abs(run.value("final/q_Pa") / 197.238e3 - 1.) < 1e-4  # closed form: element_tests.md
# The program has found the scripts that draw, and these the package.
assert (run.folder / "stress_path.png").is_file()
try:
    geocone.example("element/none.prm")
    raise AssertionError
except FileNotFoundError as problem:
    assert "element/none.prm" in str(problem)
PYTHON
/usr/bin/python3 -m geocone plot results/cam_clay > said
grep -qx 'results/cam_clay/report.html' said
[ "$(ls "$HOME"/.local/share/doc/geocone/notebooks | wc -l)" = \
  "$(ls "$root"/doc/notebooks/*.ipynb | wc -l)" ]

# A virtual environment of this interpreter has it, too.
/usr/bin/python3 -m venv --without-pip --system-site-packages env
cmake --install "$(dirname "$program")" --prefix "$folder/env" > said
mv "$HOME/.local" moved
env/bin/python -c 'import geocone, pathlib, sys
assert pathlib.Path(geocone.__file__).resolve().is_relative_to(sys.prefix)'
# What somebody else has put there is left alone.
rm env/lib/python3*/site-packages/geocone
mkdir "$(echo env/lib/python3*/site-packages)/geocone"
fails cmake --install "$(dirname "$program")" --prefix "$folder/env" > said 2>&1
grep -q 'is a folder, and not a link of a former installation' said
