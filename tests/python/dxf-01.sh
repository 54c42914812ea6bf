# A drawing becomes a parameter file: body, layers and water by the names of its layers, in
# metres, with holes, and sides that are held. What holds no body is refused, and no file is replaced.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B - <<'PYTHON'
import ezdxf


def drawing(name, unit, code, body):
    file = ezdxf.new("R2010")
    file.header["$INSUNITS"] = code
    space = file.modelspace()

    def points(*xy):
        return [(x / unit, y / unit) for x, y in xy]

    if body:  # clockwise, of single lines that were drawn in any order
        corners = points((0, -4), (0, 8), (10, 8), (26, 0), (40, 0), (40, -4))
        lines = list(zip(corners, [*corners[1:], corners[0]]))
        for a, b in [lines[3], lines[0], *lines[1:3], *lines[:3:-1]]:
            space.add_line(a, b, dxfattribs={"layer": "fill"})
    space.add_lwpolyline(points((40, 0), (0, 0)), dxfattribs={"layer": "clay"})
    space.add_lwpolyline(points((0, 4), (18, 4)), dxfattribs={"layer": "silt.1"})
    space.add_lwpolyline(points((2, 5), (4, 5), (4, 7), (2, 7)), close=True,
                         dxfattribs={"layer": "block"})
    space.add_lwpolyline(points((8, -3), (10, -3), (9, -1)), close=True,
                         dxfattribs={"layer": "Holes"})
    space.add_lwpolyline(points((26, 0), (16, 2), (0, 3)), dxfattribs={"layer": "Water"})
    file.saveas(name)


drawing("metres.dxf", 1., 6, True)
drawing("millimetres.dxf", 1e-3, 4, True)
drawing("no_body.dxf", 1., 6, False)
PYTHON
export PYTHONPATH=$root/python
dxf() {
  /usr/bin/python3 -B -m geocone dxf "$@"
}
dxf metres.dxf metres.prm
dxf millimetres.dxf millimetres.prm
diff <(tail -n +2 metres.prm) <(tail -n +2 millimetres.prm)
for line in 'Polygon = 0, -4; 40, -4; 40, 0; 26, 0; 10, 8; 0, 8' 'Names = fill, silt_1, clay, block' \
  'Region below = 0, 4; 18, 4' 'Region below = 0, 0; 40, 0' 'Region polygon = 2, 5; 4, 5; 4, 7; 2, 7' \
  'Table = 0, 3; 16, 2; 26, 0' 'Holes = 8, -3; 10, -3; 9, -1'; do
  grep -qF "$line" <(tr -s ' ' <metres.prm) || { cat metres.prm; exit 1; }
done
"$program" metres.prm --dry-run --picture --quiet --output model \
  --set 'Analysis/Kind = steps' --set 'Discretisation/Method = FEM' \
  --set 'Loading/Stages = weight' --set 'Loading/weight/Duration = 1'
grep -q '"silt_1"' model/model.json
fails dxf no_body.dxf none.prm --body hull 2>said
grep -q 'layers with a closed line: block' said
[ ! -e none.prm ]
fails dxf metres.dxf metres.prm 2>said
grep -q exists said
fails dxf metres.prm none.prm 2>said
grep -q 'no DXF file' said
fails dxf metres.dxf nowhere/new.prm 2>said
grep -q '^error: .*nowhere' said
[ "$(wc -l <said)" = 1 ]
