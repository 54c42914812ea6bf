# Runs in notebooks: a data frame of many, a table of one with its picture, figures and
# meshes; names from outside would be read as HTML, and figures would be written as files.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
PYTHONPATH=$root/python /usr/bin/python3 -B - "$program" "$root" <<'PYTHON'
import importlib.util, json, os, sys
import geocone
program, root = sys.argv[1:]
file = f"{root}/tests/footing_coarse.prm"
short = {"Output/Report for tests": "none", "Output/Pictures": False,
         "Loading/push/Duration": 0.1, "Loading/push/Output every": 5}
runs = geocone.run_many(file, {
    (size, c): {**short, "Mesh/Cell size": size, "Materials/soil/Cohesion": c}
    for size in (0.2, 0.25, -1) for c in (1e3, 2e3)}, program=program, keep_failed=True)
run = runs[0.25, 2e3]

# Rows in the order of the runs, of two levels; what has failed has no numbers.
frame = geocone.to_dataframe(runs)
assert list(frame.index) == list(runs) and frame.index.nlevels == 2
assert frame.loc[(0.25, 2e3), "limit_load/value"] == run.value("limit_load/value")
assert frame["size/method"].iloc[0] == "FEM" and "run/pid" not in frame
assert frame["status"].tolist()[:4] == ["finished"] * 4
assert frame["status"].iloc[4].startswith("failed: parameter 'Mesh/Cell size' = '-1'")
assert frame["size/cells"].isna().tolist() == [False] * 4 + [True] * 2
few = geocone.to_dataframe([run], ["size/cells", "no/value"])
assert few.columns.tolist() == ["status", "size/cells", "no/value"]
assert few.index.tolist() == [run.folder.name] and few["size/cells"].tolist() == [64]

# A table for notebooks, with the picture that is there.
text = run._repr_html_()
for words in ("<b>footing_coarse</b>", "Limit load: ", "natural-map error at most",
              "FEM, 64 cells", str(run.folder)):
    assert words in text, (words, text)
assert "<img" not in text
assert os.system(f"'{root}/scripts/plot' '{run.folder}' > said") == 0
assert "<img src='data:image/png;base64," in run._repr_html_()
summary = json.loads((run.folder / "summary.json").read_text())
summary.update(name="<b>x", warnings=["<script>"], status="failed: <i>")
os.mkdir("named")
with open("named/summary.json", "w") as out:
    json.dump(summary, out)
text = geocone.read("named")._repr_html_()
for words in "<b>x", "<script>", "<i>":
    assert words not in text.replace("<b>&lt;", "")

# Figures are the caller's, and no file is written.
before = {path: path.stat().st_mtime_ns for path in run.folder.iterdir()}
figure = run.figure("load_displacement")
assert "load" in figure.axes[0].get_ylabel()
figure.axes[0].set_title("mine")
figure.savefig("mine.pdf")
assert run.figure("newton.png").axes and run.figure("model").axes
assert before == {path: path.stat().st_mtime_ns for path in run.folder.iterdir()}
for name, kind, words in (("none", ValueError, "allowed: model, load_displacement, "),
                          ("plastic_strain", geocone.Missing, "")):
    try:
        run.figure(name)
        raise AssertionError(name)
    except kind as problem:
        assert words in str(problem), str(problem)

# Meshes of pyvista, or what is missing.
if importlib.util.find_spec("pyvista"):
    mesh = run.pyvista("cells")
    assert mesh.n_cells == 64 and "displacement" in mesh.point_data
else:
    try:
        run.pyvista("cells")
        raise AssertionError
    except geocone.MissingModule as problem:
        assert "-m pip install pyvista" in str(problem)
PYTHON
