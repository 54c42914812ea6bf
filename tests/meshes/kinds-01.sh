# Mesh files of all kinds of cells, and names of curves with commas: an elastic block that is
# compressed has the exact force E / (1 - nu^2) times the strain on quadrilaterals, triangles,
# both in one mesh (the quadrilaterals are divided), and on quadratic ones, whose corners count.
# Curved edges, an open quote, and a curve inside the body are refused.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 - <<'END'
n = 2


def mesh(name, kind, order=1, bent=0.):
    """A unit square; its cells left of x = 0.5 are triangles if it is mixed."""
    nodes, places = {}, []

    def node(x, y):
        if (x, y) not in nodes:
            nodes[x, y] = len(nodes) + 1
            places.append((x + bent * y * (1 - y), y))
        return nodes[x, y]

    def middles(corners):
        ends = list(zip(corners, corners[1:] + corners[:1])) if len(corners) > 2 else [corners]
        return corners + [((a + c) / 2, (b + d) / 2) for (a, b), (c, d) in ends]

    elements = []

    def add(kind, group, corners):
        places_of = middles(corners) if order == 2 else corners
        number = {"line": (1, 8), "triangle": (2, 9), "quadrilateral": (3, 16)}[kind][order - 1]
        elements.append((number, group, [node(*x) for x in places_of]))

    grid = [i / n for i in range(n + 1)]
    for a, b in zip(grid, grid[1:]):
        add("line", 1, [(a, 0), (b, 0)])
        add("line", 2, [(a, 1), (b, 1)])
        add("line", 3, [(a, 0.5), (b, 0.5)])
        for c, d in zip(grid, grid[1:]):
            corners = [(a, c), (b, c), (b, d), (a, d)]
            if kind == "triangles" or (kind == "mixed" and a < 0.5):
                add("triangle", 1, corners[:3])
                second = corners[2:] + corners[:1]
                add("triangle", 1, second[::-1] if name == "turned" else second)
            else:
                add("quadrilateral", 1, corners)
    with open(name + ".msh", "w") as file:
        print('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 "base, level"\n'
              '1 2 "top (load)"\n1 3 "inside"\n$EndPhysicalNames\n$Nodes', file=file)
        print(len(places), file=file)
        for i, (x, y) in enumerate(places):
            print(i + 1, x, y, 0, file=file)
        print(f"$EndNodes\n$Elements\n{len(elements)}", file=file)
        for i, (number, group, own) in enumerate(elements):
            print(i + 1, number, 2, group, group, *own, file=file)
        print("$EndElements", file=file)


mesh("quadrilaterals", "quadrilaterals")
mesh("triangles", "triangles")
mesh("mixed", "mixed")
mesh("turned", "triangles")  # every second one is clockwise, as those of surfaces that look down
for kind in ("quadrilaterals", "triangles", "mixed"):
    mesh(kind + "2", kind, 2)
mesh("curved", "triangles", 2, 0.1)
END
cat >block.prm <<'END'
subsection Geometry
  set Shape = file
end
subsection Materials
  set Names = soil
  subsection soil
    set Type          = Tresca
    set Cohesion      = 1e6
    set Young modulus = 1e7
    set Poisson ratio = 0.3
  end
end
subsection Boundary conditions
  set Names = base, corner, push
  subsection base
    set Sides      = "base,level"
    set Velocity y = 0
  end
  subsection corner
    set Sides      = 1
    set Box        = -0.1, -0.1; 0.1, 0.1
    set Velocity x = 0
  end
  subsection push
    set Sides      = top (load)
    set Velocity y = -0.001
  end
end
subsection Loading
  set Stages = push
  subsection push
    set Duration  = 1
    set Step size = 1
  end
end
subsection Observation
  set Conditions = push
  set Component  = y
  set Factor     = -1
end
subsection Output
  set Pictures     = false
  set Fields       = false
  set Expectations = limit_load/last = 10989.010989 +- 1e-4
end
END
for mesh in quadrilaterals triangles turned mixed quadrilaterals2 triangles2 mixed2; do
  "$program" block.prm --quiet --output "$mesh" --set "Geometry/File = $mesh.msh" 2>&1
done

refused() {  # TEXT ARGUMENTS...
  text=$1 && shift
  if "$program" block.prm --dry-run "$@" >out.txt 2>&1; then
    echo "accepted: $*" && exit 1
  fi
  grep -q "$text" out.txt && grep -q "remedy:" out.txt || { cat out.txt && exit 1; }
}
refused "is curved at" --set "Geometry/File = curved.msh"
refused "close the quote" --set "Geometry/File = mixed.msh" \
  --set 'Boundary conditions/base/Sides = "base, level'
refused '"base, level", inside' --set "Geometry/File = mixed.msh" \
  --set 'Boundary conditions/base/Sides = base, level'
refused "inside the body" --set "Geometry/File = mixed.msh" \
  --set 'Boundary conditions/base/Sides = 1, inside'
# Regions of a gmsh mesh may be given clockwise where the body is not.
"$program" "$root/prm/safety/embankment.prm" --quiet --dry-run \
  --set 'Materials/clay/Region polygon = 0, 0; 40, 0; 40, -5; 0, -5'
