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
# Points that move are balls, seen from where the flow is, in pictures, film and page.
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
for name, kind in (("hexahedra", "hexahedron"), ("tetra", "tetra")):
    png = open(f"{name}/plastic_strain_rate.png", "rb").read()
    assert min(struct.unpack(">II", png[16:24])) > 500
    run = geocone.read(name)
    mesh = run.fields("cells")
    assert mesh.points.shape[1] == 3 and mesh.cells[0].type == kind
    cells = mesh.cells[0].data
    faces, normals = solid.outer_faces(mesh.points, cells, solid.vertices_of(mesh.points))
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
