# Bounds on meshes of files are refined where they differ, as those of a polygon: a quarter of a
# thick cylinder of two clays, c = 1 inside and 2 outside, of 48 triangles in the file, ends with
# a bracket of its exact pressure at collapse, 2 (c1 ln(m/a) + c2 ln(b/m)); a ground with an
# opening has, on meshes made of a file's, a bracket that overlaps with that of the same ground
# with Geometry/Holes. Of a body that hangs together in a point no other mesh is made, and the
# run says so. Quadrilaterals are refused.
program=$1 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 - <<'END'
from math import cos, pi, sin


def write(name, cells, side_of, surface_of):
    """A mesh of quadrilaterals, divided into triangles, with the physical curves of its boundary
    edges and the physical surfaces of its cells."""
    nodes, edges, elements = {}, {}, []

    def node(x):
        return nodes.setdefault((round(x[0], 12), round(x[1], 12)), len(nodes) + 1)

    for corners in cells:
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edge = tuple(sorted((node(a), node(b))))
            edges[edge] = None if edge in edges else (a, b)
        x, y = (sum(c) / 4 for c in zip(*corners))
        n = [node(c) for c in corners]
        for triangle in (n[:3], n[2:] + n[:1]):
            elements.append((2, surface_of(x, y), triangle))
    for edge, ends in edges.items():
        if ends and side_of(*ends):
            elements.append((1, side_of(*ends), edge))
    with open(name, "w") as out:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes", len(nodes), sep="\n", file=out)
        for (x, y), number in nodes.items():
            print(number, repr(x), repr(y), 0, file=out)
        print("$EndNodes\n$Elements", len(elements), sep="\n", file=out)
        for number, (kind, group, of) in enumerate(elements, 1):
            print(number, kind, 2, group, group, *of, file=out)
        print("$EndElements", file=out)


radii, n = [1, 1.4, 2], 12
at = lambda r, k: (r * cos(k * pi / 2 / n) if k < n else 0., r * sin(k * pi / 2 / n))
# Radii of chords with the area of the circle's sector.
scale = ((pi / 2 / n) / sin(pi / 2 / n))**0.5
cells = [[at(scale * r, k), at(scale * s, k), at(scale * s, k + 1), at(scale * r, k + 1)]
         for r, s in zip(radii, radii[1:]) for k in range(n)]
size = lambda x: (x[0]**2 + x[1]**2)**0.5
write("cylinder.msh", cells,
      lambda a, b: 1 if a[1] == b[1] == 0 else 2 if a[0] == b[0] == 0 else
      3 if size(a) < 1.1 else 0, lambda x, y: 4 if size((x, y)) < 1.4 else 5)

ground = [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
          for x in range(-4, 4) for y in range(-6, 0)
          if not (-1 <= x < 1 and -4 <= y < -2)]
write("ground.msh", ground, lambda a, b: 1 if a[1] == b[1] == -6 else
      2 if abs(a[0]) == abs(b[0]) == 4 else 3 if a[1] == b[1] == 0 else 0, lambda x, y: 4)
write("corners.msh", [[(0, 0), (1, 0), (1, 1), (0, 1)], [(1, 1), (2, 1), (2, 2), (1, 2)]],
      lambda a, b: 1 if a[1] == b[1] == 0 else 3, lambda x, y: 4)
END
cat >common.prm <<'END'
subsection Geometry
  set Shape = file
end
subsection Materials
  set Names = clay
  subsection clay
    set Type     = Tresca
    set Cohesion = 1
  end
end
subsection Boundary conditions
  set Names = base, sides
  subsection base
    set Sides      = 1
    set Velocity y = 0
  end
  subsection sides
    set Sides      = 2
    set Velocity x = 0
  end
end
subsection Tractions
  set Names = load
  subsection load
    set Sides           = 3
    set Traction normal = -1
  end
end
subsection Output
  set Pictures = false
  set Fields   = false
end
subsection Analysis
  set Kind = limit load
end
END
run() # NAME OPTION ...
{
  local name=$1
  shift
  local options=()
  for option in "$@"; do options+=(--set "$option"); done
  "$program" "$PWD/common.prm" --quiet --output "$name" "${options[@]}" >"$name.txt" 2>&1 ||
    { cat "$name.txt"; exit 1; }
}
run cylinder 'Geometry/File = cylinder.msh' 'Materials/Names = clay, outer' \
  'Materials/outer/Type = Tresca' 'Materials/outer/Cohesion = 2' \
  'Materials/outer/Region number = 5' 'Analysis/Gap tolerance = 0.05'
run file 'Geometry/File = ground.msh' 'Analysis/Gap tolerance = 0.1'
run holes 'Geometry/Shape = box' 'Geometry/Box = -4, -6; 4, 0' \
  'Geometry/Holes = -1, -4; 1, -4; 1, -2; -1, -2' 'Analysis/Gap tolerance = 0.1' \
  'Mesh/Type = unstructured' 'Mesh/Cell size = 1' 'Boundary conditions/base/Sides = bottom' \
  'Boundary conditions/sides/Sides = left, right' 'Tractions/load/Sides = top'
# Steps of finite elements on a mesh with sizes from bounds, 80 triangles in the file.
run steps 'Geometry/File = ground.msh' 'Analysis/Kind = steps' 'Mesh/Type = from the bounds' \
  'Mesh/Number of cells = 200' 'Discretisation/Method = FEM' \
  'Materials/clay/Young modulus = 1000' 'Loading/Stages = load' 'Loading/load/Duration = 1' \
  'Loading/load/Step size = 1' 'Time stepping/Inertia = false'
"$program" "$PWD/common.prm" --dry-run --set 'Geometry/File = corners.msh' \
  --set 'Boundary conditions/Names = base' --set 'Boundary conditions/base/Velocity x = 0' \
  >corners.txt 2>&1
/usr/bin/python3 "$2/tests/output/ring.py" ring.msh 2
! "$program" "$PWD/common.prm" --dry-run --set 'Geometry/File = ring.msh' \
  --set 'Boundary conditions/sides/Sides = plane_x' >ring.txt 2>&1
grep -q 'a mesh of triangles for strict bounds' ring.txt || { cat ring.txt; exit 1; }
grep -q 'is not refined: parts of the body touch in a point' corners.txt ||
  { echo "the body in two parts:"; cat corners.txt; exit 1; }
/usr/bin/python3 - <<'END'
import json
from math import log


def bounds(name):
    return json.load(open(name + "/summary.json"))["bounds"]


cells = json.load(open("steps/summary.json"))["size"]["cells"]
assert 150 < cells < 300, cells


exact = 2 * (log(1.4) + 2 * log(2 / 1.4))
cylinder, of_file, holes = (bounds(name) for name in ("cylinder", "file", "holes"))
print(cylinder, of_file, holes, sep="\n")
assert cylinder["certified"] and cylinder["gap"] <= 0.05 and cylinder["levels"] > 2
# The chords change the pressure by (1 - cos(pi/48))/2 or so.
assert cylinder["lower"] <= 1.004 * exact and cylinder["upper"] >= 0.996 * exact
for of in of_file, holes:
    assert of["certified"] and of["gap"] <= 0.1
assert max(of_file["lower"], holes["lower"]) <= min(of_file["upper"], holes["upper"])
END
