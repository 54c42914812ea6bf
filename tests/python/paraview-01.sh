# paraview_state.py opens what the run has written: for each kind of run its literal names
# a series that is there, arrays that the last state has, and a range that is theirs. A
# stand-in for ParaView sees the script open that series, VTKHDF by a ParaView that knows it
# (5.12); where ParaView itself is installed, it draws pictures that are not of one colour.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() { # name, file, options
  name=$1 file=$2
  shift 2
  "$program" "$root/$file" --quiet --output "$name" --set 'Output/Report for tests = none' \
    --set 'Output/Pictures = false' --set 'Output/Fields = true' \
    --set 'Output/Expectations =' "$@"
  [ "$("$root/scripts/plot" --paraview "$name")" = "$name/paraview_state.py" ]
  grep -qx 'paraview_state.py' "$name/files.txt"
}
run fem tests/fem/footing-Q2-01.prm --set 'Loading/push/Duration = 0.06' \
  --set 'Loading/push/Output every = 3'
run mpm tests/mpm/square-01.prm --set 'Loading/turn/Duration = 0.1' \
  --set 'Loading/turn/Output every = 2' --set 'Output/Fields format = hdf5'
run explicit tests/three/explicit_layer_plane-01.prm --set 'Loading/collapse/Output every = 2'
run bounds prm/limit_load/footing_rough.prm --set 'Analysis/Maximum levels = 1' \
  --set 'Analysis/Gap tolerance = 9'
run solid prm/three/triaxial.prm --set 'Loading/press/Output every = 6' \
  --set 'Loading/press/Duration = 1.5'
run balls tests/three/explicit_layer-01.prm --set 'Loading/collapse/Output every = 4'
# What an element test has are no fields; nothing is written.
"$program" "$root/prm/element/oedometer.prm" --quiet --output point --set 'Output/Pictures = false'
fails "$root/scripts/plot" --paraview point 2> said
grep -qx 'error: there are no fields' said
[ ! -e point/paraview_state.py ]
# It comes with the pictures, too; where these are elsewhere it knows where the run is.
"$root/scripts/plot" fem --output elsewhere/pictures > said
grep -qx 'elsewhere/pictures/paraview_state.py' said
grep -q "'from': '../../fem'" elsewhere/pictures/paraview_state.py

PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import ast, os, runpy, sys, types
from pathlib import Path
from unittest.mock import MagicMock
import numpy as np
import geocone
from geocone.style import sizes_of

def literal_of(path):
    """What the file says of its run, read without running it."""
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.Assign) and node.targets[0].id == "RUN":
            return ast.literal_eval(node.value)

def opened_by(path, version):
    """The files that the script opens in ParaView of a version."""
    opened = []
    def open_file(name):
        opened.append(os.path.normpath(name))
        return source
    source = MagicMock(TimestepValues=[0., 1.])
    source.GetDataInformation.return_value.GetBounds.return_value = (0., 2., 0., 1., 0., 0.)
    simple = MagicMock()
    simple.OpenDataFile.side_effect = open_file
    simple.WarpByVector.return_value = source
    simple.GetParaViewVersion.return_value = version
    simple.CreateView.return_value.ViewSize = [400, 300]
    simple.CreateView.return_value.CameraFocalPoint = [0., 0., 0.]
    sys.modules["paraview"] = types.SimpleNamespace(simple=simple)
    runpy.run_path(str(path))
    assert simple.Show.called and simple.ColorBy.called
    return opened

SERIES = {"fem": "cells", "mpm": "points", "explicit": "points", "bounds": "bounds",
          "solid": "cells", "balls": "points"}
for name, series in SERIES.items():
    run, path = geocone.read(name), Path(name) / "paraview_state.py"
    said = literal_of(path)
    field, = run.states(series)
    solid = field.points.shape[1] == 3
    assert said["name"] == run.name and said["from"] == "."
    assert bool(said["towards"]) == solid == (name in ("solid", "balls"))
    assert len(said["views"]) == 2, said["views"]
    for view in said["views"]:
        assert view["series"] == series, view
        values = field.data[view["array"]]
        size = np.linalg.norm(values, axis=1) if values.shape[1] > 1 else values[:, 0]
        low, high = view["range"]
        assert low < high and size.min() <= high and low <= size.max()
        # Few values, or those of a small part of the body, are beyond the range.
        beyond = size > high * (1. + 1e-6)
        sizes = sizes_of(field)
        assert (np.sum(beyond) <= 1 + 0.005 * len(size) or
                np.sum(sizes[beyond[field.cells[:, 0]]]) <= 0.021 * np.sum(sizes))
        assert not view["log"] or low > 0.
        assert (view["radius"] is not None) == (series == "points")
        if view["warp"]:
            most = np.linalg.norm(field.data[view["warp"]], axis=1).max()
            assert view["factor"] >= 1. and most > 0.
    # A body of finite elements is deformed so that it is seen.
    warped = [view for view in said["views"] if view["warp"]]
    assert len(warped) == (2 if series == "cells" else 0)
    for version in ((5, 11), (5, 13)):
        files = opened_by(path, version)
        ending = ("pvd" if name != "mpm" else "xdmf" if version < (5, 12) else "vtkhdf")
        assert files == [str(Path(name).resolve() / f"{series}.{ending}")], files
        assert Path(files[0]).is_file()
# The points of the mean fill the body about once.
view = literal_of(Path("explicit/paraview_state.py"))["views"][0]
assert 0.05 < view["radius"] < 0.1  # two by two in cells of 0.25 m
PYTHON
if command -v pvbatch > /dev/null; then
  for name in fem mpm explicit bounds solid balls; do
    # The server is not to start anew when VTK closes its first window.
    xvfb-run -a -s "-noreset -screen 0 1280x1024x24" pvbatch --force-offscreen-rendering "$name/paraview_state.py" "$name.png"
    /usr/bin/python3 -c "
from PIL import Image
colors = Image.open('$name.png').convert('RGB').getcolors(1 << 24)
assert len(colors) > 50, len(colors)"
  done
fi
