# A slope that is cut: one of the six panels of points.png is from before the cut, the
# slide has a picture of its own, and a film has all times.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/tests/explicit/slope_cut-01.prm" --quiet --output cut \
  --set 'Output/Report for tests = none' --set 'Output/Expectations =' \
  --set 'Output/Fields = true' --set 'Loading/cut/Output every = 2' \
  --set 'Loading/cut/Duration = 1.2' 2>/dev/null
"$root/scripts/plot" cut >plot.txt
for picture in points.png energy.png structure.png; do
  [ -s "cut/$picture" ] || { cat plot.txt; exit 1; }
done
# In 1.2 s nothing moves by 5 % of the height, or it has a picture; what is not drawn has no
# line.
while read -r file; do [ -s "$file" ] || { echo "announced: $file"; exit 1; }; done <plot.txt
"$root/scripts/plot" cut --animation --apng
PYTHONPATH=$root/python /usr/bin/python3 - <<'PYTHON'
import geocone
import numpy as np
from geocone.plots.explicit import snapshots_of, taken_away_at
from PIL import Image

run, films = geocone.read("cut"), []
for name in "points.gif", "points_film.png":
    film = Image.open("cut/" + name)
    assert film.n_frames == len(run.times("points")), (name, film.n_frames)
    assert not films or film.size == films[0].size
    films.append(film)
# Pixels of a GIF that do not change are left out of it: all frames are those of the other film.
for i in range(films[0].n_frames):
    for film in films:
        film.seek(i)
    gif, png = (np.asarray(film.convert("RGB"), dtype=float) for film in films)
    wrong = np.mean(np.max(np.abs(gif - png), axis=2) > 64.)
    assert wrong < 1e-3, (i, wrong)
cut = taken_away_at(run)
times = [field.time for field in snapshots_of(run, None)]
assert sum(time < cut for time in times) == 1 and len(times) == 6, (cut, times)
assert times[-1] == run.times("points")[-1], times
PYTHON
