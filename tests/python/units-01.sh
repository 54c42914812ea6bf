# Analysis/Units = kN-m: numbers would be converted twice or not at all, defaults would stay
# those of SI units, and tables, summaries, messages and pictures would name the wrong unit.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
PYTHONPATH=$root/python /usr/bin/python3 -B - "$program" "$root" <<'PYTHON'
import re, subprocess, sys
from pathlib import Path
import numpy as np
import geocone
from geocone.style import unit_for
program, root = sys.argv[1], Path(sys.argv[2])
def run(file, parameters, **options):
    return geocone.run(root / file, parameters, program=program, **options)
def close(a, b, tolerance=1e-9):
    np.testing.assert_allclose(a, b, rtol=tolerance, atol=1e-12)

# A footing by finite elements: kN, kPa and t throughout. Young's modulus and the density of
# the file are defaults, which are converted where they are not set.
short = {"Output/Report for tests": "none", "Loading/push/Duration": 0.1,
         "Tractions/Names": "surcharge", "Tractions/surcharge/Sides": "top",
         "Tractions/surcharge/Box": "0.1, -0.1; 1, 0.1"}
si = run("tests/footing_coarse.prm", {**short, "Tractions/surcharge/Traction y": "-500*(1 + x)"})
text = re.sub(r".*(Young modulus|Density).*\n", "",
              (geocone.Scene(root / "tests/footing_coarse.prm", program="./none")
               .write("footing.prm").read_text()))
Path("footing.prm").write_text(text)
in_kn = {**short, "Analysis/Units": "kN-m", "Materials/soil/Cohesion": 2,
         "Tractions/surcharge/Traction y": "-0.5*(1 + x)"}
kn = run(Path.cwd() / "footing.prm", in_kn)
assert not [name for name in kn.statistics if re.search(r"\((N|J|Pa|kg)", name)], list(kn.statistics)
for name, values in si.statistics.items():
    factor = 1e-3 if re.search(r"\((N|J|Pa|kg)\b", name) else 1.
    if "iterations" not in name and "time (s)" != name and "wall" not in name:
        close(kn.statistics[name], factor * values, 1e-6)
close(kn.statistics["load (kN/m)"], kn.statistics["load (N/m)"])
assert kn.value("limit_load/unit") == "kN/m" and si.value("limit_load/unit") == "N/m"
close(kn.value("limit_load/last"), 1e-3 * si.value("limit_load/last"), 1e-6)
close(kn.value("limit_load/reference"), 1e-3 * si.value("limit_load/reference"))  # Prandtl
keys = [key for key in kn.summary["energy"] if re.search("_(N|J|Pa)(_|$)", key)]
assert not keys and "kJ_per_m" in str(kn.summary["energy"]), kn.summary["energy"]
assert kn.parameters["Materials/soil/Young modulus"] == "100000"
assert kn.parameters["Materials/soil/Cohesion"] == "2"
assert kn.unit("Pa") == "kPa" and kn.per_metre("J") == "kJ/m"
assert unit_for(8.3, "kN/m") == ("kN/m", 1.) and unit_for(2e4, "kPa") == ("MPa", 1e3)
again = run(Path.cwd() / kn.folder / "parameters.prm", {"Output/Folder": ""})
close(again.value("limit_load/last"), kn.value("limit_load/last"), 1e-12)

# Explicit steps with a stage that removes soil, whose mass and momentum are told.
cut = {"Output/Expectations": "", "Output/Report for tests": "none"}
in_kn = {"Density": 2, "Young modulus": 1e3, "Cohesion": 2}
si = run("tests/explicit/cut-01.prm", cut)
kn = run("tests/explicit/cut-01.prm", {
    **cut, "Analysis/Units": "kN-m", **{f"Materials/sand/{k}": v for k, v in in_kn.items()}})
close(kn.value("state/removed_mass_t_per_m"), 8)
close(kn.value("energy/released_potential_kJ_per_m"),
      1e-3 * si.value("energy/released_potential_J_per_m"), 1e-6)
log = (Path(kn.folder) / "log.txt").read_text()
assert "8 t/m, momentum (" in log and ") kN s/m" in log, log

# A strength reduction by bounds with water has no unit: the same factor.
slope = {"Analysis/Gap tolerance": 0.1, "Output/Pictures": False, "Output/Expectations": ""}
of_si = run("prm/safety/slope_water.prm", {**slope, "Gravity/Acceleration": "0, -9.81",
                                           "Water/Unit weight": 9810})
table = (geocone.Scene(root / "prm/safety/slope_water.prm", program="./none")
         .write("slope.prm").read_text())
Path("slope.prm").write_text(re.sub(r".*(Unit weight =|Density).*\n", "", table))
of_kn = run(Path.cwd() / "slope.prm", {**slope, "Gravity/Acceleration": "0, -9.81",
                                       "Analysis/Units": "kN-m", "Materials/soil/Cohesion": 10})
for end in "lower", "upper":
    close(of_kn.value(f"safety/{end}"), of_si.value(f"safety/{end}"), 1e-5)

# Refusals and questions name the unit; a cohesion that may be meant in kPa is asked about.
def said(*settings):
    words = [word for one in settings for word in ("--set", one)]
    ended = subprocess.run([program, "--dry-run", "slope.prm", *words], text=True,
                           capture_output=True)
    return ended.stdout + ended.stderr
kN = "Analysis/Units = kN-m"
assert "kN/m^3" in said(kN, "Water/Unit weight = -1") and "9.81 is usual" in said(
    kN, "Water/Unit weight = -1")
question = said("Materials/soil/Cohesion = 12")
assert "'soil' is 12 Pa: is it meant in larger units" in question, question
assert "larger units" not in said(kN, "Materials/soil/Cohesion = 12")
assert "density of 'soil' is 2000 t/m^3" in said(kN, "Materials/soil/Density = 2000")
assert "SI | kN-m" in said("Analysis/Units = kPa") or "Analysis/Units" in said("Analysis/Units = kPa")
PYTHON
