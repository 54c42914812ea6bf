# Without it a single node sets the colours of a field, a bracket in a title may be narrower
# than the proven one, and a title of a strength reduction gives a time: scales end at a value
# that a part of the area exceeds, titles say F or the load, also in vector files.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
bounds() { # name, file: the two coarsest meshes
  "$program" "$root/prm/$2" --quiet --output "$1" --set 'Analysis/Maximum levels = 2' \
    --set 'Analysis/Gap tolerance = 1e-3' --set 'Output/Pictures = false' \
    --set 'Output/Expectations ='
}
bounds slope safety/slope_2to1.prm
bounds footing limit_load/footing_rough.prm
"$program" "$root/tests/footing_coarse.prm" --quiet --output steps \
  --set 'Output/Report for tests = none' --set 'Output/Fields = true' \
  --set 'Output/Pictures = false'
"$root/scripts/plot" slope footing steps --format svg --output drawn > said
[ ! -e drawn/slope/report.html ]
while read -r file; do [ -s "$file" ] || { echo "announced: $file"; exit 1; }; done < said
grep -q 'slope_2to1: F = 1\.[0-9]* to 1\.[0-9]* (certified)' drawn/slope/mechanism.svg
grep -q 'footing_rough: load [0-9.]* to [0-9.]* k*N/m (certified)' drawn/footing/mechanism.svg
grep -q ': limit load [0-9.]* k*N/m' drawn/steps/plastic_strain_rate.svg
# Parts of the gap are last; two meshes have no order, and no trend.
[ "$(grep -o 'mechanism of the upper\|parts of the gap' drawn/slope/mechanism.svg | head -1)" \
  = 'mechanism of the upper' ]
fails grep -q 'order\|gap against' drawn/slope/bounds.svg
# A film by ffmpeg, here one that counts its input: whole pictures of even sizes.
mkdir bin
printf '#!/bin/sh\nwhile [ "$1" != -s ]; do shift; done\necho "$2 $(wc -c)"\n' > bin/ffmpeg
chmod +x bin/ffmpeg
"$program" "$root/tests/explicit/slope_cut-01.prm" --quiet --output cut \
  --set 'Output/Report for tests = none' --set 'Output/Expectations =' \
  --set 'Output/Fields = true' --set 'Output/Pictures = false' \
  --set 'Loading/cut/Output every = 2' --set 'Loading/cut/Duration = 1.2' 2> /dev/null
PATH=$PWD/bin:$PATH "$root/scripts/plot" cut --mp4 > said
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import pathlib

import numpy as np

import geocone
from geocone.plots import answer, overlay, point_values, rates
from geocone.style import areas_of, columns_of, level

size, count = pathlib.Path("cut/points.mp4").read_text().split()
width, height = map(int, size.split("x"))
pictures = len(geocone.read("cut").times("points"))
assert width % 2 == height % 2 == 0 and int(count) == 3 * width * height * pictures

# The value that 2 % of the area exceed: many small cells with great values do not count.
values = np.array([1e6] * 50 + [2.] * 100 + [1.] * 50)
areas = np.array([1e-4] * 50 + [1.] * 100 + [1.] * 50)
assert level(values, areas) == 2.
assert level(values, np.ones(200)) == 1e6
assert level(np.array([3.]), np.array([0.])) == 3.
corners = np.array([[[0., 0.], [2., 0.], [2., 1.], [0., 1.]]])
assert np.allclose(areas_of(corners), 2.) and np.allclose(areas_of(corners[:, :3]), 1.)

# Brackets are rounded outwards, zeros included.
assert answer.bracket_text(1.30049, 1.30951, 4) == "1.300 to 1.310"
assert answer.bracket_text(-1.30951, -1.30049, 4) == "-1.310 to -1.300"
assert answer.bracket_text(8231.21, 8303.44, 4, 1e3) == "8.231 to 8.304"
assert answer.digits_of(8346.4) == "8346"

# Panels have no empty places if they need none.
for n in (1, 2, 3, 4, 6):
    for ratio in (0.3, 1., 1.7, 4.):
        assert n % columns_of(n, ratio) == 0, (n, ratio)
# Round factors; large displacements of small strains are made smaller.
view = np.zeros(2), np.array([10., 1.])
assert overlay.magnification(0.1, view) == 5. and overlay.magnification(3., view) == 0.1

# Where strength is reduced a state is that of a factor, not of a time.
run = geocone.read("steps")
assert answer.moment(run, 0.04) == "t = 0.04 s"
run.statistics = {"time (s)": np.array([1., 3.634]),
                  "strength factor (-)": np.array([1., 1.9527])}
assert answer.moment(run, 3.634) == "F = 1.953"

# Values of cells, recovered at the nodes: means over their areas.
class Two:
    points = np.array([[0., 0.], [1., 0.], [0., 1.], [1., 0.], [1., 1.], [0., 1.]])
    cells = np.array([[0, 1, 2], [3, 4, 5]])
    data = {"material": np.array([[0.]] * 3 + [[1.]] * 3)}
# Rates are shown over three decades; over one where most of the body flows about as fast.
for slow, decades in (1e-3, 3.), (9., 1.):
    norm = rates.scale_of(Two, np.array([slow] * 3 + [10.] * 3))
    assert norm.vmax == 10.
    assert np.isclose(norm.vmax / norm.vmin, 10.**decades), (norm.vmin, norm.vmax)
# The view of a narrow flow is as wide as high, but not wider than the body.
class Body:
    points = np.stack(np.meshgrid(np.arange(11.), np.arange(11.)), axis=-1).reshape(-1, 2)
for left, narrow in (0., True), (4., True), (0., False):
    flows = (Body.points[:, 0] >= left) & (Body.points[:, 0] <= left + (1. if narrow else 10.))
    low, high = rates.view_of(Body, 1. * (flows & (Body.points[:, 1] > 1.)), 1.)
    assert np.all(low >= -1.) and np.all(high <= 11.) and low[0] <= left, (low, high)
    assert np.isclose(*(high - low)) or not narrow, (low, high)
values = np.array([1.] * 3 + [3.] * 3)
assert np.allclose(point_values.recovered(Two, values), [1., 2., 2., 2., 3., 2.])
between, outer = overlay.borders_of(Two)
assert len(between) == 1 and len(outer) == 4, (between, outer)
PYTHON
