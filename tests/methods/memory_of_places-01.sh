# The automatic memory of friction depends on the scene, and not on how the part that is
# pushed is told: by a box, a formula or a side of a polygon, nor on the number of ranks;
# a mesh from a file is one of these bodies, whole or half of it.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 - <<'PYTHON'
def write_msh(name, left):
    """A body from left to 2 and from -1 to 0 in squares of 0.2 m; 4 is the footing."""
    columns, rows = round((2 - left) / 0.2), 5
    node = lambda i, j: j * (columns + 1) + i + 1
    x = lambda i: left + 0.2 * i
    lines = [(1, node(i, 0), node(i + 1, 0)) for i in range(columns)]
    lines += [(2, node(0, j), node(0, j + 1)) for j in range(rows)]
    lines += [(3, node(columns, j), node(columns, j + 1)) for j in range(rows)]
    lines += [(4 if abs(x(i) + 0.1) < 0.2 else 5, node(i, rows), node(i + 1, rows))
              for i in range(columns)]
    with open(name, "w") as file:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes", file=file)
        print((columns + 1) * (rows + 1), file=file)
        for j in range(rows + 1):
            for i in range(columns + 1):
                print(node(i, j), x(i), -1 + 0.2 * j, 0, file=file)
        print("$EndNodes\n$Elements", file=file)
        print(len(lines) + columns * rows, file=file)
        for number, (side, a, b) in enumerate(lines):
            print(number + 1, 1, 2, side, side, a, b, file=file)
        for j in range(rows):
            for i in range(columns):
                print(len(lines) + 1 + j * columns + i, 3, 2, 1, 1, node(i, j),
                      node(i + 1, j), node(i + 1, j + 1), node(i, j + 1), file=file)
        print("$EndElements", file=file)


def write(name, body, base, walls, footing):
    with open(name + ".prm", "w") as file:
        print(f"""
subsection Geometry
{body}
end
subsection Mesh
  set Type      = {"unstructured" if "polygon" in name else "uniform"}
  set Cell size = 0.2
end
subsection Discretisation
  set Method = FEM
end
subsection Materials
  set Names = sand
  subsection sand
    set Type            = Mohr-Coulomb
    set Cohesion        = 1000
    set Friction angle  = 30
    set Dilatancy angle = 0
    set Young modulus   = 1e7
    set Poisson ratio   = 0.3
  end
end
subsection Boundary conditions
  set Names = base, walls, footing
  subsection base
    set Sides      = {base}
    set Velocity x = 0
    set Velocity y = 0
  end
  subsection walls
    set Sides      = {walls}
    set Velocity x = 0
  end
  subsection footing
{footing}
    set Velocity y = -0.01
  end
end
subsection Loading
  set Stages = push
  subsection push
    set Duration  = 0.1
    set Step size = 0.1
  end
end
subsection Output
  set Pictures = false
end""", file=file)


for half in ("", "half_"):
    left = 0 if half else -2
    low = 0 if half else -0.2
    write_msh(half + "body.msh", left)
    box = f"  set Box = {left}, -1; 2, 0"
    file = f"  set Shape = file\n  set File = {half}body.msh"
    corners = f"{left}, -1; 2, -1; 2, 0; 0.2, 0; " + ("" if half else "-0.2, 0; ")
    polygon = f"  set Shape = polygon\n  set Polygon = {corners}{left}, 0"
    where = "    set Where = 0.04 + 1e-9 - x^2"
    write(half + "box", box, "bottom", "left, right",
          f"    set Sides = top\n    set Box = {low}, -0.01; 0.2, 0.01")
    write(half + "formula", box, "bottom", "left, right",
          f"    set Sides = top\n{where}")
    write(half + "polygon", polygon, "0", "1, 4" if half else "1, 5", "    set Sides = 3")
    write(half + "file", file, "1", "2, 3", "    set Sides = 4")
PYTHON
for scene in box formula polygon file half_box half_formula half_polygon half_file; do
  "$program" $scene.prm --output $scene >log 2>&1 || { cat log; exit 1; }
  # 0.4 m/1000 at 0.01 m/s
  grep -q 'friction has a memory of 0.04 s' log || { echo "$scene"; cat log; exit 1; }
done
mpirun -np 2 "$program" file.prm --output file-2 >log 2>&1
grep -q 'friction has a memory of 0.04 s' log
