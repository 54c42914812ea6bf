# geocone.MaterialPoint: a point in the process of Python would give other numbers than the
# program, know only the parameters of the point that was made last, lose its state where a
# path is driven in parts, or end the interpreter by a refusal.
program=$1 root=$2 folder=$3
if ! ls "$(dirname "$program")"/geocone_point*.so > /dev/null 2>&1; then
  echo 'pybind11-dev is missing, or the target geocone_point was not built: nothing is tested'
  exit 0
fi
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
PYTHONPATH=$root/python /usr/bin/python3 -B - "$program" "$root" <<'PYTHON'
import sys, warnings
from pathlib import Path
import h5py  # has another library of HDF5 than the module
import numpy as np
import geocone
program, root = sys.argv[1], Path(sys.argv[2])
quiet = {"Output/Pictures": False, "Output/Expectations": ""}
def point_of(scene, parameters=None):
    return geocone.MaterialPoint(scene, parameters, program=program)

# The same columns and numbers as the program's, which writes nine digits or more.
file = root / "prm" / "element" / "undrained_triaxial.prm"
of_program = geocone.run(file, quiet, program=program).path
point = point_of(file)
table = point.run()
assert list(table) == list(of_program) == point.columns
for name, values in of_program.items():
    np.testing.assert_allclose(table[name], values, rtol=1e-8, atol=1e-12, err_msg=name)
# Driven in parts, from Python, also after a restart.
axial = table["eps yy (-)"][1:]
for _ in range(2):
    point.restart()
    assert point.state == {name: values[0] for name, values in table.items()}
    first = point.follow({"xx": -axial[:100] / 2, "yy": axial[:100], "zz": -axial[:100] / 2})
    last = point.follow({"xx": 0.05, "yy": -0.1, "zz": 0.05}, increments=300)
    for name in ("q (Pa)", "p (Pa)", "R (-)", "eps_q (-)"):
        np.testing.assert_allclose(np.append(first[name], last[name]), table[name][1:], rtol=1e-9)
    np.testing.assert_array_equal(point.stress[:2],
                                  [last[f"stress {c} (Pa)"][-1] for c in ("xx", "yy")])
np.testing.assert_allclose(point.strain, [0.05, -0.1, 0.05, 0, 0, 0], rtol=1e-12)

# Closed form: Mohr-Coulomb in plane strain, sigma_1 = sigma_3 k + 2 c sqrt(k), and stress
# control up to it; points of other laws beside each other keep their parameters.
sand = {"Materials/Names": "sand", "Materials/sand/Type": "Mohr-Coulomb",
        "Materials/sand/Young modulus": 50e6, "Materials/sand/Cohesion": 10e3,
        "Materials/sand/Friction angle": 30, "Materials/sand/Dilatancy angle": 0}
points = {angle: point_of(sand, {"Materials/sand/Friction angle": angle})
          for angle in (20., 30., 40.)}
clay = point_of(file, {"Materials/clay/Structure loss rate cb": 0})
for angle, point in points.items():
    k = np.tan(np.radians(45. + angle / 2.)) ** 2
    strength = 100e3 * k + 20e3 * np.sqrt(k)
    table = point.follow(strain={"yy": -0.02}, stress={"xx": -100e3}, increments=50)
    np.testing.assert_allclose(-table["stress yy (Pa)"][-1], strength, rtol=1e-9)
    np.testing.assert_allclose(table["stress xx (Pa)"], -100e3, rtol=1e-9)
    point.restart()
    point.follow(stress={"xx": -100e3, "yy": -0.999 * strength}, increments=20)
    try:
        point.follow(stress={"xx": -100e3, "yy": -1.001 * strength})
        raise AssertionError("carries more than its strength")
    except RuntimeError as problem:
        assert "remedy:" in str(problem), problem
assert clay.run()["q (Pa)"].max() > 1.2 * of_program["q (Pa)"].max()
del points, clay
assert abs(point_of(sand).stress[0] + 100e3) < 1e-6

# Refusals, with words; what is no parameter of a point is refused where it is given.
def refused(kind, words, call):
    try:
        call()
        raise AssertionError(words)
    except kind as problem:
        assert words in str(problem), problem
change = lambda path, value: lambda: point_of(sand, {path: value})
refused(ValueError, "'Materials/sand/Friction angle' = '95'",
        change("Materials/sand/Friction angle", 95))
refused(ValueError, "did you mean 'Materials/sand/Cohesion'", change("Materials/sand/Cohesoin", 1))
refused(ValueError, "no parameter of a material point", change("Mesh/Cell size", 1))
refused(ValueError, "1 + e", change("Element/Initial specific volume", 1))
point = point_of(sand)
refused(ValueError, "Path/loading", point.run)  # has no path
refused(ValueError, "unknown component 'yz'\n  allowed: xx, yy, xy", lambda: point.follow({"yz": 0}))
refused(ValueError, "a strain and a stress", lambda: point.follow({"yy": 0}, {"yy": 0}))
refused(ValueError, "shapes [(2,), (3,)]", lambda: point.follow({"yy": [0, 0], "xx": [0, 0, 0]}))
refused(geocone.MissingModule, "pybind11-dev",
        lambda: geocone.MaterialPoint(sand, program="/bin/true"))
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    point_of(file, {"Materials/clay/Initial size pcb": 1e3, "Materials/clay/Stress outside": "raise size",
                    "Materials/clay/Initial anisotropy": "0,0,0,0",
                    "Materials/clay/Initial centre ratio chi": 0})
assert "pcb was raised" in str(caught[0].message), caught
PYTHON
