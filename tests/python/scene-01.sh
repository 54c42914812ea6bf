# Scenes as mappings: a name that the program does not have would be found out only by the
# run, a scene that is written would lose includes, continued lines or the files it names,
# and a change would not reach the run.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder/written" && cd "$folder"
PYTHONPATH=$root/python /usr/bin/python3 -B - "$program" "$root" <<'PYTHON'
import os, sys
from pathlib import Path
import numpy
import geocone
from geocone.parameter_file import parameters_of, settings_in
program, root = sys.argv[1], Path(sys.argv[2])
file = root / "tests" / "footing_coarse.prm"
short = {"Output/Report for tests": "none", "Output/Pictures": False,
         "Loading/push/Duration": 0.02, "Mesh/Cell size": 0.25}
def scene_of(file, parameters=None):
    return geocone.Scene(file, parameters, program=program)

# Reading: includes, later lines, defaults, sections.
scene = scene_of(file)
assert scene["Mesh/Cell size"] == "0.1" and scene["Materials"]["soil"]["Cohesion"] == "2000"
assert scene["Analysis"]["Gap tolerance"] == "0.01"  # the program's
soil = scene["Materials/soil"]
assert "Cohesion" in soil and "K0" not in soil and soil.get("No") is None
assert dict(soil)["Cohesion"] == "2000" and len(soil) == len(list(soil))
assert dict(scene) == scene.settings() and scene.changes == {}
assert settings_in(["subsection A", "set B = 1, \\  ", "set B = 1, \\", " 2 # x \\", "  3", "end"]
                   ) == {"A/B": "1, 2"}

# Values, and what no file can hold.
soil["Cohesion"] = 12e3
scene["Materials"]["soil"].update({"Friction angle": numpy.float64(27.), "Density": 1900})
scene["Geometry"] = {"Box": numpy.array([[-1, -2], [1, 0]])}
scene["Observation/Conditions"] = ["footing"]
scene["Time stepping/Inertia"] = numpy.bool_(False)
assert scene.changes == {
    "Materials/soil/Cohesion": "12000.0", "Materials/soil/Friction angle": "27.0",
    "Materials/soil/Density": "1900", "Geometry/Box": "-1, -2; 1, 0",
    "Observation/Conditions": "footing", "Time stepping/Inertia": "false"}, scene.changes

def refused(kind, words, change):
    before = dict(scene.changes)
    try:
        change()
        raise AssertionError(words)
    except kind as problem:
        assert words in str(problem), str(problem)
    assert scene.changes == before
def sets(path, value=1):
    return lambda: scene.update({path: value})
Unknown = geocone.UnknownParameter
refused(Unknown, "did you mean 'Materials/soil/Cohesion'?", sets("Materials/soil/Cohesoin"))
refused(Unknown, "did you mean 'Analysis/Gap tolerance'?", sets("Mesh/Gap tolerance"))
refused(Unknown, "added to 'Materials/Names'", sets("Materials/clay/Cohesion"))
refused(Unknown, "added to 'Loading/Stages'", sets("Loading/pusch/Duration"))
refused(Unknown, "'geocone --help'", lambda: scene["Zzz"])
refused(ValueError, "modified Cam-Clay", sets("Materials/soil/Type", "clay"))
for value in "a\nb", "a # b", "a \\":
    refused(ValueError, "cannot stand in a parameter file", sets("Output/Folder", value))
# Parameters of another law, of a new material, and of three dimensions.
refused(Unknown, "Swelling", sets("Materials/soil/Swelling index kappa"))
other = scene_of(file, {"Materials/Names": ["soil", "clay"],
                        "Materials/clay/Type": "modified Cam-Clay",
                        "Materials/clay/Swelling index kappa": 0.02})
refused(Unknown, "", sets("Boundary conditions/sides/Velocity z", 0))
scene_of(file, {"Geometry/Dimension": 3, "Boundary conditions/sides/Velocity z": 0})
# Without a program names are not checked.
geocone.Scene(file, {"No/Name": 1}, program="./none")

# The run has the changes, also what is written; the file is as it was.
before = file.read_bytes()
scene.update(short)
run = scene.run({"Mesh/Cell size": 0.5})
assert run.parameters["Materials/soil/Cohesion"] == "12000.0" and run.name == "footing_coarse"
assert run.parameters["Mesh/Cell size"] == "0.5" and scene["Mesh/Cell size"] == "0.25"
runs = scene.run_many({c: {"Materials/soil/Cohesion": c} for c in (12000., 6000.)})
assert str(runs[6000.].folder) == "results/footing_coarse-2/6000"
assert scene.write("written/mine.prm") == Path("written/mine.prm")
assert parameters_of("written/mine.prm") == scene.settings()
again = geocone.run("written/mine.prm", program=program)
for one in (runs[12000.], geocone.run(scene, program=program)):
    assert one.summary["limit_load"] == again.summary["limit_load"]
assert runs[6000.].value("limit_load/last") < again.value("limit_load/last")
assert file.read_bytes() == before

# Continued lines; files that a scene names are found from elsewhere.
scene = scene_of(root / "prm" / "safety" / "slope_2to1.prm")
assert scene["Output/Expectations"].endswith(", bounds/gap <= 0.01")
assert scene["Materials/soil/Cohesion"] == "10000"  # before a comment
for name, parameter in (("safety/slope_seepage", "Water/File"), ("contact/discs", "Geometry/File")):
    scene = scene_of(root / "prm" / f"{name}.prm")
    path = scene.write(f"written/{Path(name).name}.prm")
    named = parameters_of(path)[parameter]
    assert not os.path.isabs(named)
    assert (path.parent / named).samefile(scene.file.parent / scene[parameter])
    assert os.system(f"'{program}' --check {path} > said") == 0
record = Path("record.prm")
record.write_text("subsection Tractions\nset Names = a\nsubsection a\nset Traction x = record r.csv"
                  "\nend\nend\n")
Path("r.csv").write_text("t,v\n")
assert parameters_of(scene_of(record).write("written/r.prm"))["Tractions/a/Traction x"] == (
    "record ../r.csv")
PYTHON
