# Of a body in three dimensions the package reads cells with three coordinates, and draws
# the faces that are seen: all of a convex body that face the eye, each once.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for cells in "hexahedra" "tetra --set Mesh/Type=unstructured"; do
  "$program" "$root/prm/three/triaxial.prm" --quiet --output ${cells%% *} \
    --set 'Output/Pictures = false' --set 'Loading/press/Output every = 6' \
    --set 'Loading/press/Duration = 1.5' $([ "$cells" = hexahedra ] || echo "${cells#* }") \
    $([ "$cells" = hexahedra ] || echo --set Discretisation/Element=P2)
  "$root/scripts/plot" ${cells%% *} > said
  grep -qx "${cells%% *}/plastic_strain_rate.png" said
  # A picture that is not drawn has no line.
  while read -r file; do [ -s "$file" ]; done <said
done
# Points that move are balls or disks, seen from where the flow is, in pictures, film and page.
"$program" "$root/tests/three/explicit_layer-01.prm" --quiet --output points \
  --set 'Output/Fields = true' --set 'Loading/collapse/Output every = 1' \
  --set 'Output/Report for tests = none'
"$root/scripts/plot" points > said
"$root/scripts/plot" points --animation >> said
for picture in energy.png runout.png points.png points.gif report.html; do
  grep -qx "points/$picture" said
done
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import struct
import numpy as np
import geocone
from geocone.plots import solid
from geocone.plots.point_values import vertices_of
for name, kind in (("hexahedra", "hexahedron"), ("tetra", "tetra")):
    png = open(f"{name}/plastic_strain_rate.png", "rb").read()
    assert min(struct.unpack(">II", png[16:24])) > 500
    run = geocone.read(name)
    mesh = run.fields("cells")
    assert mesh.points.shape[1] == 3 and mesh.cells[0].type == kind
    cells = mesh.cells[0].data
    faces, normals = solid.outer_faces(mesh.points, cells, vertices_of(mesh.points))
    a, b, c, d = (mesh.points[faces[:, i]] for i in range(4))
    area = np.linalg.norm(np.cross(c - a, d - b), axis=1) / 2.
    area[area == 0.] = np.linalg.norm(np.cross(b - a, c - a), axis=1)[area == 0.] / 2.
    # The surface of a cube of 0.1 m, whose normals are those of its sides.
    assert abs(area.sum() / 0.06 - 1.) < 1e-6, area.sum()
    assert np.allclose(np.abs(normals).max(axis=1), 1., atol=1e-6)
    centre = np.mean([a, b, c, d], axis=0) - 0.05
    assert np.all(np.sum(centre * normals, axis=1) > 0.)
# The heap runs along x, away from the wall: it is seen from there.
run = geocone.read("points")
assert run.per_metre("J") == "J"
last, = run.states("points")
look = solid.SolidLook([last], [last.points[:, 0]], lambda size: size)
assert look.view.signs[0] == 1. and np.ptp(look.box, axis=0).min() > 0.
PYTHON
# The same pictures by VTK where it and a display are to be had, and by matplotlib elsewhere.
number=0
if ! /usr/bin/python3 -c 'import vtkmodules' 2> /dev/null || ! command -v Xvfb > /dev/null; then
  echo "skipped: images by VTK (needs python3-vtk9 and xvfb)" >&2
else
  Xvfb -displayfd 3 -screen 0 1600x1600x24 3> display 2> /dev/null &
  server=$!
  trap 'kill $server' EXIT
  until [ -s display ]; do sleep 0.05; done
  number=$(cat display)
fi
DISPLAY=:$number PYTHONPATH=$root/python /usr/bin/python3 -B - "${server:+with}" <<'PYTHON'
import os
import sys
import numpy as np
import geocone
from geocone import style
from geocone.plots import pictures_of, rates, rendered, solid
from geocone.plots.point_values import vertices_of
# A cube of 8^3 cells, of which the one behind the middle flows: it is opened there.
n = np.arange(8)
corner = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1],
                   [1, 1, 1], [0, 1, 1]])
origins = np.stack(np.meshgrid(n, n, n, indexing="ij"), axis=-1).reshape(-1, 1, 3)
points = (origins + corner).reshape(-1, 3).astype(float)
cells = np.arange(len(points)).reshape(-1, 8)
flows = np.all(origins[:, 0] == [4, 4, 4], axis=1)
view, faces, normals, cut = solid.chosen_view(points, cells, np.repeat(1. * flows, 8))
assert np.allclose(cut, 4.5)
where = view.seen(points)
box = where.min(axis=0), where.max(axis=0)
vertices = vertices_of(points)
first = np.unique(vertices, return_index=True)[1]
nodes = vertices[cells]
height = points[first][:, 1] / 8.
fields = [("cell", np.where(flows, 1., -1.), style.RATES), ("point", height, style.STEPS)]
images = rendered.images_of(points[first], nodes, fields, view, box, cut)
assert len(images) == (2 if sys.argv[1] else len(images))
if sys.argv[1]:
    def color(image, place):
        """Of what is seen at a place in space."""
        x, y = (view.seen(np.array(place)) - box[0]) / (box[1] - box[0])
        rows, columns = image.shape[:2]
        return image[int((1. - y) * rows), int(x * columns)] / 255.
    # The cell that flows, inside of the cube, is seen in the sides of the cut.
    in_side = cut + np.array([0., 0.2, 0.3 * view.signs[1]])
    assert color(images[0], in_side).max() < 0.3
    # Nodal values vary smoothly: colours of a vertical line of the outside, in its light.
    x, z = np.where(view.signs > 0., [8., 2.5], [0., 5.5])
    for y in 1.5, 2.6, 3.5:
        seen = color(images[1], [x, y, z])
        told = np.array(style.STEPS(y / 8.))[:3]
        assert np.allclose(seen / seen.sum(), told / told.sum(), atol=0.02), (y, seen, told)
    os.environ["GEOCONE_VTK"] = "0"
    assert rendered.images_of(points[first], nodes, fields, view, box) == []
    assert rendered.images_of_balls(points, np.ones(len(points)), [], view, box) == []
    del os.environ["GEOCONE_VTK"]
    # Two balls, of which the nearer one hides the other but for its rim; none beside them.
    near = rendered.images_of_balls(np.array([0.5 * view.towards, -0.5 * view.towards]),
                                    np.array([0.5, 1.]), [("point", [0., 0.9], style.STEPS)],
                                    view, ([-1., -1.], [1., 1.]))[0]
    middle, side = len(near) // 2, len(near) // 4
    for place, part in (middle, 0.), (middle + int(0.8 * side), 0.9):
        seen, told = near[middle, place] / 255., np.array(style.STEPS(part))[:3]
        assert np.allclose(seen / seen.sum(), told / told.sum(), atol=0.02), (part, seen, told)
    assert np.all(near[middle, middle + int(1.2 * side)] == 255)
    with style.kept() as figures:
        run = geocone.read("points")
        pictures_of(run)["points.png"](run, run.folder / "rendered.png")
    *shown, _ = figures[0].axes  # the last one is the bar
    assert shown and all(len(axes.images) == 1 for axes in shown)
    with style.kept() as figures:
        run = geocone.read("tetra")
        rates.draw_run(run, run.folder / "rendered.png")
    # Rates, smooth rates, displacement.
    assert sum(len(axes.images) for axes in figures[0].axes) == 3
# Without a display: VTK before 9.4 would end the process that it runs in.
os.environ["DISPLAY"] = ":12345"
assert len(rendered.images_of(points[first], nodes, fields, view, box)) in (0, 2)
PYTHON
# Why VTK has drawn nothing is said in a line: of a module that ends the process, and of one that
# takes too long.
mkdir -p broken/vtkmodules slow/vtkmodules
echo 'raise SystemExit("no such renderer")' >broken/vtkmodules/__init__.py
echo 'import time; time.sleep(60)' >slow/vtkmodules/__init__.py
for fake in broken slow; do
  PYTHONPATH=$root/python:$fake /usr/bin/python3 -B - 2>said <<'PYTHON'
import numpy as np
from geocone import style
from geocone.plots import rendered, solid
rendered.TIME_LIMIT = 2.
rendered.can_render = lambda: True
assert rendered.images_of(np.eye(4, 3), np.array([[0, 1, 2, 3]]), [("cell", [1.], style.RATES)],
                          solid.View(1., 1.), ([0., 0.], [1., 1.])) == []
PYTHON
  [ "$(wc -l <said)" = 1 ]
  grep -q "$([ $fake = broken ] && echo 'exit code 1: no such renderer' || echo 'more than 2 s')" said
done
