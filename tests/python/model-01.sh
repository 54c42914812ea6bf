# The model of a scene is drawn without a run, into a folder of its own, and again into the
# same one. Its description has materials, supports, loads and what stages change; values and
# places are those of the parameter files.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for _ in 1 2; do
  "$program" "$root/prm/stages/embankment.prm" --dry-run --picture --quiet
done
[ "$(ls results)" = embankment-model ]
"$program" "$root/prm/three/square_footing.prm" --dry-run --picture --quiet --output space
"$program" "$root/prm/footing_mpm.prm" --dry-run --picture --quiet --output particles
/usr/bin/python3 -B - <<'PYTHON'
import json
from pathlib import Path

from PIL import Image

embankment = Path("results/embankment-model")
for folder in (embankment, Path("space"), Path("particles")):
    with Image.open(folder / "model.png") as picture:
        assert picture.width > 500 and picture.height > 300, folder

model = json.loads((embankment / "model.json").read_text())
assert [m["name"] for m in model["materials"]] == ["clay", "fill 1", "fill 2", "fill 3", "fill 4"]
assert [s["added"] for s in model["stages"] if "added" in s] == [[f"fill {i}"] for i in range(1, 5)]
assert len(model["material_of_cell"]) == len(model["cells"]) > 0
for support in model["supports"]:  # all are fixed
    assert support["faces"] and not any(map(any, support["values"])), support["name"]
road, = model["tractions"]
ends = [x for face in road["faces"] for x, _ in face]
assert abs(min(ends)) < 1e-9 and abs(max(ends) - 6.) < 0.2, ends
assert all(abs(value[1] + 10e3) < 1e-6 for value in road["values"])

particles = json.loads(Path("particles/model.json").read_text())
assert not particles["material_of_cell"] and particles["cells"]
footing, = (s for s in particles["supports"] if any(map(any, s["values"])))
assert all(value == [0., -0.02] for value in footing["values"]), footing["values"]
PYTHON

# Conditions of some stages are named with them, valued in them only, and drawn in a strip.
"$program" "$root/tests/stages/footing.prm" --dry-run --picture --quiet --output staged \
  --set 'Boundary conditions/footing/Velocity y = if(t < 0.1, -9, -0.02)'
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from pathlib import Path

from geocone.plots.model import Model, notable_stages

model = Model(Path("staged"))
footing, = (s for s in model.data["supports"] if s["stages"])
assert footing["name"] == "footing" and footing["stages"] == ["push"]
assert all(value == [0., -0.02] for value in footing["values"]), footing["values"]
assert [stage["name"] for stage in notable_stages(model)] == ["surcharge", "push"]
assert Path("staged/model.png").stat().st_size > 10000
PYTHON

# Obstacles are in the pictures of stages too, without their names.
"$program" "$root/prm/safety/excavation_wall.prm" --dry-run --picture --quiet --output wall
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from pathlib import Path

from geocone.plots.model import Model, draw_stages, notable_stages, view_of
from geocone.style import subplots

model = Model(Path("wall"))
stages = notable_stages(model)
assert [stage["name"] for stage in stages] == ["first lift", "second lift"]
_, axes_of = subplots(1, 2, figsize=(4., 2.))
draw_stages(axes_of, model, stages, view_of(model))
triangles = len(model.data["obstacles"][0]["triangles"])
for axes in axes_of:
    assert triangles in [len(c.get_paths()) for c in axes.collections] and not axes.texts
PYTHON

# The scene of all that a model may have in the plane: each thing is in the picture or its legend.
"$program" "$root/prm/stages/road_beside_pit.prm" --dry-run --picture --quiet --output all
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from pathlib import Path

from geocone.plots.model import draw
from geocone.style import kept

assert Path("all/model.png").stat().st_size > 10000
with kept() as figures:
    draw(Path("all"), Path("all/again.png"))
main, lower = figures[0].axes
words = [text.get_text() for text in main.get_legend().get_texts()]
for start in ("fill: Mohr-Coulomb", "clay: ", "sand: ", "road: 10 kPa", "fixed", "roller",
              "water table", "observed points"):
    assert sum(word.startswith(start) for word in words) == 1, (start, words)
written = [text.get_text() for text in main.texts]
assert "wall" in written and set("01234567") <= set(written), written
assert [axes.get_title() for axes in lower.child_axes] == ["first lift: excavation",
                                                           "second lift: excavation"]
PYTHON

# A material that changes and changes back is there at the start and looks as at the start; what is
# dug away stays away until it is filled, in the plane and in space.
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from pathlib import Path

import numpy as np
from matplotlib.quiver import Quiver

from geocone.plots import model_solid
from geocone.plots.model import Model, draw_stages, states_of, view_of
from geocone.style import subplots


def stage(name, **changes):
    return {"name": name, "duration_s": 1., **changes}


model = Model(Path("results/embankment-model"))
pit = {"low": [0., -1.], "high": [1., 0.], "rows": ["1"]}
model.data["stages"] = [
    stage("grout", changed={"clay": "fill 1"}), stage("dig", removed_lattice=pit),
    stage("weaken", changed={"fill 1": "clay"}), stage("fill", added=["fill 2"])]
assert model.absent() == {"fill 2"}
states = list(states_of(model, model.data["stages"]))
assert [state.now["clay"] for state in states] == ["fill 1", "fill 1", "clay", "clay"]
assert [state.done for state in states] == [[], [pit], [pit], [pit, "fill 2"]]
assert [state.end for state in states] == [1., 2., 3., 4.]
_, axes_of = subplots(1, 4, figsize=(4., 2.))
draw_stages(axes_of, model, model.data["stages"], view_of(model))
assert [len(axes.images) for axes in axes_of] == [0, 1, 1, 1]  # the pit
# The fill is drawn above the pit.
assert max(c.get_zorder() for c in axes_of[3].collections[:2]) > axes_of[3].images[0].get_zorder()

model = Model(Path("space"))
model.data["stages"] = []
low, high = model.low, model.high
middle = (low + high) / 2.
box = [list(middle), list(high)]
model.data["materials"] = [{"name": "soil"}, {"name": "fill", "region": box}]
model.data["material_of_cell"] = []
drawn = []
model_solid.draw_grid = lambda axes, view, lines, colors: drawn.append(
    int(np.isnan(colors[..., 0]).sum()))
for absent, done in ((set(), []), ({"fill"}, []), (set(), [box]), (set(), [box, "fill"])):
    model_solid.draw_body(None, model, model_solid.ABOVE, absent, {}, done)
assert drawn == [0, 1, 1, 0], drawn
# Of the cells of a mesh, those of the boundary are drawn where nothing is missing, or where there
# is no grid, which is said.
drawn.clear()
model.data["material_of_cell"] = [0, 1]
model.data["cells"] = [[[*low[:2], z], [high[0], low[1], z], [*high[:2], z]]
                       for z in (low[2], high[2])]
_, axes = subplots(1, 1, figsize=(2., 2.))
for absent, kind, faces in ((set(), "box", 2), ({"fill"}, "box", None), ({"fill"}, "file", 1)):
    model.data["body"]["shape"] = kind
    before = len(axes.collections)
    model_solid.draw_body(axes, model, model_solid.ABOVE, absent)
    assert [len(c.get_paths()) for c in axes.collections[before:]] == [faces] * (faces is not None)
    assert bool(model_solid.remark_of(model, absent)) == (faces == 1)
assert drawn == [1], drawn
# A plane under the body is behind it from above, and before it from below.
plane = np.array([[[0., -1., 0.], [1., -1., 0.], [0., -1., 1.]]])
assert [model_solid.is_behind(plane, np.zeros(3), view)[0]
        for view in (model_solid.ABOVE, model_solid.BELOW)] == [True, False]
# Of a body on a lattice, supports are where its cells are: two of four, one on another.
model.data.update(material_of_cell=[], body={"shape": "box", "lattice": {
    "low": [0., 0., 0.], "high": [2., 2., 1.], "layers": [["10", "10"]]}})
for side, number in (([[0., 0., 0.], [0., 0., 1.], [0., 3., 1.], [0., 3., 0.]], 2),
                     ([[0., 0., 0.], [2., 0., 0.], [2., 0., 1.], [0., 0., 1.]], 1)):
    found = model_solid.faces_on_body(model, [side])
    assert len(found) == number
    for face in found:
        assert np.isclose(np.linalg.norm(model_solid.normal_of(face)), 1.)
        assert model_solid.normal_of(face) @ model_solid.normal_of(np.array(side)) > 0.
# A load is drawn where its face is seen.
top = {"name": "top", "faces": [[[0., 1., 0.], [0., 1., 1.], [1., 1., 1.], [1., 1., 0.]]],
       "values": [[0., -1., 0.]]}
model.data.update(tractions=[top], supports=[])
for view, arrows in ((model_solid.ABOVE, 1), (model_solid.BELOW, 0)):
    _, axes = subplots(1, 1, figsize=(2., 2.))
    assert list(model_solid.draw_loads(axes, model, view)) == ["top: 1 Pa"]
    assert sum(isinstance(one, Quiver) for one in axes.collections) == arrows
PYTHON

# The table of the report has soil without tension, and a cohesion that is a formula.
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from types import SimpleNamespace

from geocone.plots.scene_tables import loads_of, soils_of

table = soils_of({"Materials/a/Tensile strength": "0", "Materials/a/Cohesion formula": "1e3 + y",
                  "Materials/b/Tensile strength": "none"}, ["a", "b"])
assert table.head[2:] == ["c(x, y) (Pa)", "tension (kPa)"], table
assert [row[2:] for row in table.rows] == [["1e3 + y", "0"], ["", ""]], table
# A unit weight is used in place of the density, which has a default.
table = soils_of({"Materials/a/Density": "2000", "Materials/a/Unit weight": "18000",
                  "Materials/b/Density": "1900", "Materials/b/Unit weight": "0"}, ["a", "b"])
assert [row[2:] for row in table.rows] == [["", "18"], ["1900", "0"]], table
# Gravity that is not vertical, as in pseudo-static analyses, is shown by its components.
for gravity, text in (([0., -9.81], "9.81 m/s²"), ([0.3, -9.81], "(0.3, -9.81) m/s²"),
                      ([0., -9.81, 1.5], "(0, -9.81, 1.5) m/s²"), ([0., 0.], None)):
    table = loads_of(SimpleNamespace(parameters={}, stress_unit="Pa", data={
        "gravity_m_per_s2": gravity, "tractions": [], "supports": []}))
    assert table.rows == ([["weight", text, "body"]] if text else []), table
PYTHON
fails "$program" "$root/prm/footing_mpm.prm" --picture 2>said
grep -q -- '--picture goes with --dry-run' said
fails "$program" "$root/prm/element/cyclic_shear.prm" --dry-run --picture 2>said
grep -q -- '--picture draws a scene' said
[ "$(ls results)" = embankment-model ]

# Obstacles in space are in the legend, and half-spaces do not hide the body from below.
"$program" "$root/prm/three/bounds_wall.prm" --dry-run --picture --quiet --output half_spaces
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
from pathlib import Path

from geocone.plots.model import draw
from geocone.style import kept

with kept() as figures:
    draw(Path("half_spaces"), Path("half_spaces/again.png"))
above, below = figures[0].axes[:2]
words = [text.get_text() for text in above.get_legend().get_texts()]
assert "wall, base: obstacles" in words, words
for axes, is_light in ((above, False), (below, True)):
    shades = [c.get_facecolor()[0][3] for c in axes.collections
              if len(c.get_paths()) == 2 and len(c.get_paths()[0].vertices) == 4]
    assert len(shades) == 2 and all((shade < 0.2) == is_light for shade in shades), shades
PYTHON
