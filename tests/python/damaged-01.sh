# What is damaged or not there is one exception that names the file, of one kind.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/footing_coarse.prm" --quiet --output good \
  --set 'Output/Report for tests = none' --set 'Output/Pictures = false' \
  --set 'Output/Fields = true' --set 'Loading/push/Duration = 0.02'
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import os, pathlib, random, re, shutil
import geocone
good = pathlib.Path("good")
READS = {"summary.json": lambda run: None, "statistics.csv": lambda run: run.statistics,
         "newton.csv": lambda run: run.newton, "points.pvd": lambda run: run.fields(),
         "parameters.prm": lambda run: run.parameters,
         "points-0000.vtu": lambda run: run.fields(),
         "cells-0000.vtu": lambda run: run.fields("cells")}

def outcome(name, change):
    """What reading says of a folder with one file changed; "" if it reads on."""
    shutil.rmtree("bad", ignore_errors=True)
    shutil.copytree(good, "bad")
    change(pathlib.Path("bad") / name)
    try:
        READS[name](geocone.read("bad"))
    except geocone.ReadError as problem:
        text = str(problem)
        assert "\n" not in text and "bad" in text, text
        return text
    return ""

def says(words, name, change):
    text = outcome(name, change)
    assert words in text, (name, words, text)
    if name != "summary.json" and "there is no file" in words:
        try:
            READS[name](geocone.read("bad"))
        except geocone.Missing:
            return
        raise AssertionError(name)

def write(data):
    return lambda path: path.write_bytes(data)
def cut(path):
    path.write_bytes(path.read_bytes()[:path.stat().st_size // 2])
def folder(path):
    path.unlink()
    path.mkdir()

for name in READS:
    assert outcome(name, lambda path: None) == ""
says("no summary.json", "summary.json", os.remove)
says("no summary.json", "summary.json", folder)
says("no summary.json", "summary.json", cut)
for text in b"[1]", b"{}", b'{"name": 1, "status": ["a"]}', b"[" * 100000, b"\xff\x00":
    says("no summary.json", "summary.json", write(text))
for name in "statistics.csv", "newton.csv", "points.pvd", "parameters.prm":
    says("there is no file", name, os.remove)
    says("there is no file", name, folder)
says("has no lines", "statistics.csv", write(b""))
says("has no lines", "statistics.csv", write(b"step,load (N/m)\n"))
says("cannot be read", "statistics.csv", write(b"step\nx\n"))
says("cannot be read", "statistics.csv", write(b"\xff\x00,\n1,2\n"))
for name in "points-0000.vtu", "cells-0000.vtu", "points.pvd":
    for change in cut, write(b""), write(b"<VTKFile>"), write(b"\x00\xff"):
        says("cannot be read", name, change)
says("cannot be read", "points-0000.vtu", os.remove)
says("cannot be read", "points.pvd", write(b"<VTKFile/>"))
# A line that is being written is left out.
def unfinished(path):
    path.write_text(path.read_text() + "2,0.04")
assert outcome("statistics.csv", unfinished) == ""
# A device is not read, nor is what a file says run.
says("cannot be read", "points.pvd", lambda path: path.write_text(
    re.sub('file="[^"]*"', 'file="/dev/zero"', path.read_text())))

# Whatever is changed in a file, it reads or it is a ReadError.
random.seed(7)
def scramble(path):
    data = bytearray(path.read_bytes())
    for _ in range(random.choice((1, 3, 30))):
        place = random.randrange(len(data))
        data[place:place + random.choice((0, 1, 20))] = random.randbytes(
            random.choice((0, 1, 5)))
    path.write_bytes(data)
told = {name: sum(outcome(name, scramble) != "" for _ in range(60)) for name in READS}
assert told["points-0000.vtu"] > 20, told
PYTHON
