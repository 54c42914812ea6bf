# Nothing in a folder of results, of a study or of the call is executed, nothing outside of the
# folder is read because a file in it says so, and nothing behind a link or of somebody else is
# replaced.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder/foreign" "$folder/work" && cd "$folder/work"
for ranks in 1 2; do
  mpirun -np $ranks "$program" "$root/tests/mpm/square-01.prm" --output run$ranks --quiet \
    --set 'Output/Report for tests = none' --set 'Output/Fields = true' \
    --set 'Output/Expectations =' --set 'Output/Pictures = false' \
    --set 'Loading/turn/Duration = 0.1' --set 'Loading/turn/Output every = 5'
done
cp -r run1 run2 ../foreign
echo mine >../foreign/data
echo 'set Names = secret' >../foreign/secret.prm
hashes() {
  (cd "$folder/foreign" && find . -type f -exec sha256sum {} + | sort)
}
before=$(hashes)

# Modules and settings in the folder of the call.
mkdir call
for module in numpy json csv matplotlib jinja2 tomllib geocone os argparse sitecustomize; do
  echo "open('$folder/executed', 'w')" >call/$module.py
done
echo "text.usetex: True" >call/matplotlibrc
cp -r run1 call/run
cp "$root/prm/footing.prm" call
cat >call/study.toml <<END
[[group]]
name = "a"
file = "footing.prm"
END
(cd call && "$root/scripts/plot" run >said && "$root/scripts/study" study.toml --list >said)
[ -s call/run/newton.png ] && [ ! -e executed ] && [ ! -e ../executed ]

# Records of fields that name files elsewhere.
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import json, pathlib, re
import geocone

def refused(folder, file, old, new):
    path = pathlib.Path(folder, file)
    text = path.read_text()
    assert old in text, (file, old)
    path.write_text(text.replace(old, new))
    try:
        geocone.read(folder).fields()
        raise AssertionError(f"read: {new}")
    except geocone.ReadError as problem:
        assert "not in its folder" in str(problem), problem
    path.write_text(text)

assert len(geocone.read("run1").fields().points) == len(geocone.read("run2").fields().points)
outside = str(pathlib.Path("../foreign").resolve())
for place in ("../foreign/run1/", outside + "/run1/", "./", "../work/run1/"):
    refused("run1", "points.pvd", 'file="', 'file="' + place)
record = sorted(pathlib.Path("run2").glob("points-*.pvtu"))[-1].name
for place in ("../foreign/run2/", outside + "/run2/"):
    refused("run2", record, 'Source="', 'Source="' + place)

# A parameter file that includes others.
with open("run1/parameters.prm", "a") as file:
    file.write("include ../../foreign/secret.prm\ninclude parameters.prm\n")
assert "secret" not in geocone.read("run1").parameters.values()

# Summaries that say what no run says.
path = pathlib.Path("run1/summary.json")
text = path.read_text()
summary = json.loads(text)
for run in ({"pid": 10**30}, {"pid": -1}, {"host": [1]}, {"last_sign_of_life": "x"}):
    path.write_text(json.dumps({**summary, "status": "running", "run": {**summary["run"], **run}}))
    try:
        geocone.read("run1").status
    except geocone.ReadError:
        pass
path.write_text(text)
PYTHON

# Links in the place of what is written, and files of somebody else.
for name in newton.png newton.png.part report.html.part load_displacement.svg.part \
  files.txt.part paraview_state.py.part; do
  ln -s "$folder/foreign/data" "run2/$name"
done
echo newton.png >>run2/files.txt
"$root/scripts/plot" run2 >said
[ -s run2/newton.png ] && [ ! -L run2/newton.png ] && [ -s run2/report.html ]
for name in report.html energy.png paraview_state.py; do
  rm -f "run1/$name"
  echo mine >"run1/$name"
  sed -i "/^$name\$/d" run1/files.txt
  fails "$root/scripts/plot" run1 >said 2>error
  grep -q "^error: 'run1/$name' is there, and is none of the run's files" error
  [ "$(cat "run1/$name")" = mine ]
  rm "run1/$name"
done
[ "$(hashes)" = "$before" ]
