# Bounds do not depend on the direction of a body: a block between three smooth plates with a rough
# plate that is pushed has the same ones along the axes and turned in space, with all laws, both
# elements and a tensile strength.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B - <<'PYTHON'
from pathlib import Path

import numpy as np

n = 2
axis = np.array([0.3, -0.5, 0.8])
axis /= np.linalg.norm(axis)
K = np.cross(np.eye(3), axis).T
turned = np.eye(3) + np.sin(0.7) * K + (1. - np.cos(0.7)) * K @ K


def number(i, j, k):
    return 1 + i + (n + 1) * (j + (n + 1) * k)


def cells(corner, *steps):
    """Vertices of a square or a cube, in gmsh's order."""
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = [np.add(corner, a * steps[0] + b * steps[1]) for a, b in ring]
    if len(steps) == 3:
        corners += [x + steps[2] for x in corners]
    return [number(*x) for x in corners]


e = np.eye(3, dtype=int)
elements = []
for a in range(3):
    b, c = (a + 1) % 3, (a + 2) % 3
    for end in range(2):
        for j in range(n):
            for k in range(n):
                elements.append((3, 1 + 2 * a + end,
                                 cells(n * end * e[a] + j * e[b] + k * e[c], e[b], e[c])))
for i, j, k in np.ndindex(n, n, n):
    elements.append((5, 7, cells((i, j, k), *e)))
names = [f'2 {1 + 2 * a + end} "{"xyz"[a]} {end}"' for a in range(3) for end in range(2)]
for name, R in ("along", np.eye(3)), ("turned", turned):
    points = [(number(i, j, k), R @ (np.array([i, j, k]) / n + 0.1 * (k == 1) * e[0] * i * (n - i)))
              for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "7", *names,
             '3 7 "all"', "$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{k} " + " ".join(f"{a:.17g}" for a in x) for k, x in points]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{k} {kind} 2 {tag} {tag} " + " ".join(map(str, v))
              for k, (kind, tag, v) in enumerate(elements, 1)]
    Path(f"{name}.msh").write_text("\n".join([*lines, "$EndElements", ""]))
    v = R @ [0., -1., 0.]
    Path(f"{name}.prm").write_text(f"""
subsection Geometry
  set Dimension = 3
  set Shape = file
  set File = {name}.msh
end
subsection Analysis
  set Kind = limit load
  set Gap tolerance = 1e-5
  set Solver tolerance = 1e-7
  set Maximum levels = 1
end
subsection Materials
  set Names = soil
  subsection soil
    set Type = Mohr-Coulomb
    set Cohesion = 1000
    set Friction angle = 25
    set Dilatancy angle = 25
  end
end
subsection Boundary conditions
  set Names = plates, top
  subsection plates
    set Sides = x 0, y 0, z 0
    set Velocity normal = 0
  end
  subsection top
    set Sides = y 1
    set Velocity x = {v[0]:.17g}
    set Velocity y = {v[1]:.17g}
    set Velocity z = {v[2]:.17g}
  end
end
subsection Observation
  set Conditions = top
end
""")
PYTHON
run() {
  local name=$1
  shift
  for body in along turned; do
    "$program" $body.prm --quiet --output "$name-$body" --set 'Output/Fields = false' \
      --set 'Output/Pictures = false' "$@"
  done
}
run friction --set 'Analysis/Stresses = quadratic'
run linear --set 'Analysis/Velocities = linear'
run cut_off --set 'Materials/soil/Tensile strength = 300'
run circular --set 'Materials/soil/Type = Drucker-Prager'
run clay --set 'Materials/soil/Type = Tresca'
/usr/bin/python3 -B - <<'PYTHON'
import json

for name in "friction", "linear", "cut_off", "circular", "clay":
    along, turned = (json.load(open(f"{name}-{body}/summary.json"))["bounds"]
                     for body in ("along", "turned"))
    print(name, along["lower"], turned["lower"], along["upper"], turned["upper"])
    assert name == "clay" or 0. < along["lower"] < 0.999 * along["upper"], name
    for side in "lower", "upper":
        assert abs(turned[side] - along[side]) < 1e-6 * along[side], (name, side)
PYTHON
