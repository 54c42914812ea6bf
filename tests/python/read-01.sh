# geocone.read gives the numbers that a run has written: summary, tables, parameters, and
# fields as another reader finds them in the VTU files, on one rank and on two.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
options=(--quiet --set 'Output/Report for tests = none' --set 'Output/Pictures = false')
"$program" "$root/tests/footing_coarse.prm" --output footing "${options[@]}" \
  --set 'Output/Fields = true' --set 'Loading/push/Output every = 5'
for ranks in 1 2; do
  mpirun -np $ranks "$program" "$root/tests/mpm/square-01.prm" --output square$ranks \
    "${options[@]}" --set 'Output/Fields = true' --set 'Output/Expectations =' \
    --set 'Loading/turn/Duration = 0.1' --set 'Loading/turn/Output every = 5'
done
"$(dirname "$program")/element_test" "$root/prm/element/undrained_triaxial.prm" \
  --output element --quiet --set 'Output/Pictures = false'
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import csv, sys
import numpy as np
import geocone
assert not {"matplotlib", "meshio"} & sys.modules.keys()  # they take long to load

run = geocone.read("footing")
assert (run.name, run.status, run.method) == ("footing_coarse", "finished", "FEM")
assert "finished" in repr(run)
assert run.summary["size"]["cells"] == run.value("size/cells") == 400
assert run.value("size/none") is None and run.value("none/cells") is None
assert abs(run.value("limit_load/value") / 10161.394 - 1.) < 1e-6
# The exact load of Prandtl for c = 2 kPa, phi = 25, B = 0.2 m.
phi = np.radians(25.)
exact = 0.2 * 2e3 / np.tan(phi) * (
    np.exp(np.pi * np.tan(phi)) * np.tan(np.pi / 4. + phi / 2.)**2 - 1.)
assert abs(run.value("limit_load/reference") / exact - 1.) < 1e-12
assert run.parameters["Mesh/Cell size"] == "0.1"
assert run.parameters["Materials/soil/Friction angle"] == "25"
rows = list(csv.DictReader(open("footing/statistics.csv")))
assert list(run.statistics) == list(rows[0])
for name, column in run.statistics.items():
    assert column.shape == (10,)
    assert np.array_equal(column, [float(row[name]) for row in rows])
load = run.statistics["load (N/m)"]
assert abs(load[-1] - run.value("limit_load/last")) < 1e-6 * load[-1]
assert run.newton["step"][-1] == 10. and run.newton["iteration"][0] == 0.
assert run.statistics is run.statistics  # read once

import meshio
def same(mesh, file, kind):
    other = meshio.read(file)
    assert np.array_equal(mesh.points, other.points[:, :2])
    assert [block.type for block in mesh.cells] == [kind]
    assert np.array_equal(mesh.cells[0].data, other.cells[0].data)
    assert mesh.point_data.keys() == other.point_data.keys()
    for name, values in mesh.point_data.items():
        assert np.array_equal(values, other.point_data[name]), name
assert np.allclose(run.times("cells"), [0.1, 0.2])
same(run.fields("cells"), "footing/cells-0001.vtu", "triangle")
same(run.fields("cells", time=0.12), "footing/cells-0000.vtu", "triangle")
same(run.fields(), "footing/points-0001.vtu", "vertex")
mesh = run.fields(time=0.04)
assert mesh.info == {"time": 0.1}
assert mesh.point_data["stress_xx"].shape == (2800,)
mesh.write("copy.vtu")
assert len(meshio.read("copy.vtu").points) == 2800

one, two = geocone.read("square1"), geocone.read("square2")
assert np.array_equal(one.times(), two.times()) and len(one.times()) == 3
for time in 0., 0.05:
    a, b = one.fields(time=time), two.fields(time=time)
    assert a.point_data["displacement"].shape == (len(a.points), 3)
    place, other = (np.lexsort(np.round(mesh.points.T, 6)) for mesh in (a, b))
    assert np.allclose(a.points[place], b.points[other], rtol=0., atol=1e-5)

point = geocone.read("element")
assert point.summary["size"]["method"] == "point" and len(point.path["p (Pa)"]) == 401
assert abs(point.path["q (Pa)"][-1] / point.value("final/q_Pa") - 1.) < 1e-9
assert set(point.surfaces["state"]) == {0., 1.}
PYTHON
[ -z "$(find "$root/python" -newer element/summary.json -name '*.pyc')" ]
