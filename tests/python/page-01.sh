# report.html holds all that it shows: pictures that are pictures, tables of the scene, the
# numbers of the summary, the parameters, and a slider where there are several times. It asks
# for nothing else, is small, and a browser (where there is one) runs its scripts, shows it
# within a desk's and a telephone's width, and prints it.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/contact/incline.prm" --quiet --output run \
  --set 'Discretisation/Method = MPM' --set 'Mesh/Box = 0, 0; 0.6, 0.2' \
  --set 'Particles/Layout = sub-cells' --set 'Loading/slide/Duration = 0.1' \
  --set 'Loading/slide/Output every = 5' --set 'Reference/Quantity =' \
  --set 'Output/Pictures = false'
"$root/scripts/plot" run > said
grep -qx 'run/report.html' said
grep -qx 'report.html' run/files.txt
/usr/bin/python3 -B - <<'PYTHON'
import base64, html.parser, json, pathlib, struct
text = pathlib.Path("run/report.html").read_text()
assert len(text) < 5e6, len(text)
class Page(html.parser.HTMLParser):
    images, words, inputs, titles, folded = [], [], [], [], 0
    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        assert tag not in ("link", "iframe", "a"), tag
        if tag == "details":
            assert "open" not in of
            self.folded += 1
        self.titles.append(of.get("title", ""))
        if tag == "img":
            self.images.append(of["src"])
        if tag == "script":
            assert "src" not in of
        if tag == "input":
            self.inputs.append(of)
    def handle_data(self, data):
        self.words.append(data)
page = Page()
page.feed(text)
# Among them that of an elastic body, which has no plastic strain.
assert len(page.images) == 6, len(page.images)
for source in page.images:
    kind, data = source.split(",", 1)
    assert kind == "data:image/png;base64"
    png = base64.b64decode(data)
    assert png[:8] == b"\x89PNG\r\n\x1a\n" and min(struct.unpack(">II", png[16:24])) > 100
assert "http://" not in text and "https://" not in text
steps = 4  # of output after the start
assert [one["max"] for one in page.inputs] == [str(steps)], page.inputs
words = " ".join(page.words)
summary = json.loads(pathlib.Path("run/summary.json").read_text())
assert f"{summary['energy']['kinetic_J_per_m']:.6g}" in words
assert "kinetic (J/m)" in words and "front x (m)" in words
assert "The model" in words and "Largest shear stress of the material points" in words
assert "set Friction coefficient" in words and "0.3" in words
assert page.folded == 2
places = [words.index(part) for part in (
    "Model", "The model", "Soils", "Loads", "Results", "In time",
    "Numbers of the computation", "kinetic (J/m)", "All parameters")]
assert places == sorted(places), places
# Values that are rounded have all their digits, with their place, where the pointer is.
assert f"energy/kinetic_J_per_m = {summary['energy']['kinetic_J_per_m']}" in page.titles
PYTHON
# What a file says is shown, not run.
sed -i 's/"name": "[^"]*"/"name": "<script>alert(1)<\/script>"/' run/summary.json
"$root/scripts/plot" run > said
fails grep -q '<script>alert' run/report.html
if command -v chromium > /dev/null; then
  sed 's|</body>|<script>const s = document.getElementById("time"); s.value = 0; s.dispatchEvent(new Event("input"));</script></body>|' \
    run/report.html > moved.html
  chromium --headless --no-sandbox --disable-gpu --dump-dom "file://$PWD/moved.html" \
    > dom 2> /dev/null
  grep -q '<output id="shown">t = 0 s</output>' dom
  # Nothing is wider than the page, on a desk or on a telephone, with all numbers unfolded; a
  # picture that is tapped is scrolled within its own place.
  for width in 1280 400; do
    sed 's|</body>|<script>document.querySelector(".pictures img").click();for (const one of document.querySelectorAll("details")) one.open = true;</script></body>|' \
      run/report.html > page.html
    cat > frame.html <<HTML
<iframe src="page.html" style="width: ${width}px; height: 900px" onload="
  const root = this.contentDocument.documentElement;
  document.title = root.scrollWidth <= root.clientWidth &amp;&amp;
    root.querySelectorAll('.large img').length == 1 ? 'fits' : 'too wide'"></iframe>
HTML
    chromium --headless --no-sandbox --disable-gpu --allow-file-access-from-files \
      --dump-dom "file://$PWD/frame.html" > dom 2> /dev/null
    grep -q '<title>fits</title>' dom
  done
  # A column is sorted by its head, and again the other way.
  "$program" "$root/prm/limit_load/footing_rough.prm" --quiet --output bounds \
    --set 'Analysis/Maximum levels = 1' --set 'Analysis/Gap tolerance = 9' \
    --set 'Mesh/Largest size = 0.2' --set 'Output/Pictures = false' \
    --set 'Output/Expectations ='
  "$root/scripts/plot" bounds > said
  sed 's|</body>|<script>const head = [...document.querySelectorAll(".sortable th")].find(one => one.textContent == "support");const names = () => [...head.closest("table").tBodies[0].rows].map(row => row.cells[0].textContent);head.click();const up = names();head.click();document.title = up.length > 1 \&\& up.join() == [...up].sort().join() \&\& up.join() == names().reverse().join() ? "sorted" : up;</script></body>|' \
    bounds/report.html > sorted.html
  chromium --headless --no-sandbox --disable-gpu --dump-dom "file://$PWD/sorted.html" \
    > dom 2> /dev/null
  grep -q '<title>sorted</title>' dom
  # Two pages of A4, or a few more: what is folded away is not printed.
  chromium --headless --no-sandbox --disable-gpu --no-pdf-header-footer \
    --print-to-pdf=page.pdf "file://$PWD/run/report.html" 2> /dev/null
  /usr/bin/python3 -B - <<'PYTHON'
import pathlib, re
content = pathlib.Path("page.pdf").read_bytes()
pages = len(re.findall(rb"/Type /Page\b(?!s)", content))
assert 1 <= pages <= 5, pages
for width, height in re.findall(rb"/MediaBox \[0 0 ([0-9.]+) ([0-9.]+)\]", content):
    assert abs(float(width) - 595.) < 2. and abs(float(height) - 842.) < 2., (width, height)
PYTHON
fi
# Names with their units, the answer in front, and what a run failed of.
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import copy, geocone
from geocone.plots import page
for key, name in {"angular_N_m_s_per_m": "angular (N m s/m)", "volume_m2": "volume (m2)",
                  "stress_xx_Pa_least": "stress xx least (Pa)", "p_Pa": "p (Pa)",
                  "largest_speed_m_per_s": "largest speed (m/s)", "steps": "steps",
                  "numerical_loss_max_relative": "numerical loss max relative"}.items():
    assert page.name_of(key) == name, page.name_of(key)
run = geocone.read("run")
assert page.answer_of(run) == ""  # nothing is loaded to its limit
def answer(**topics):
    other = copy.copy(run)
    other.summary = topics
    return page.answer_of(other)
assert answer(limit_load={"value": 8442.8, "unit": "N/m"}, reference={
    "quantity": "limit_load/value", "expected": 8288.21, "relative_error": 0.018652}) == (
        "Limit load: 8442.8 N/m; reference 8288.21 (+1.87 %)")
assert answer(bounds={"lower": 8231.21, "upper": 8303.44, "unit": "N/m"}) == (
    "Between 8231.21 and 8303.44 N/m")
assert answer(bounds={"lower": 1., "upper": 2., "unit": "-"}, safety={
    "factor": 1.38164, "lower": 1.38123, "upper": 1.38203}) == (
        "Factor of safety: 1.3816 (on this mesh: equilibrium at 1.3812, none at 1.382)")
assert answer(size={"method": "strength reduction"}, safety={
    "factor": 1.38164, "lower": 1.3732, "upper": 1.3868}) == (
        "Factor of safety: 1.3816 (certified: 1.3732 to 1.3868)")
# Bounds that made the mesh of steps are those of a load, not of the factor.
def titles(method):
    other = copy.copy(run)
    other.summary = {"size": {"method": method}, "safety": {"factor": 1.166},
                     "bounds": {"lower": 2.352, "upper": 2.577}}
    return [title for title, _ in page.numbers_of(other)]
assert "Bounds of the factor of all loads at full strength" in titles("FEM"), titles("FEM")
assert "Bounds" in titles("strength reduction") and "Bounds" not in titles("FEM")
# Bounds for intervals of parameters have a table of their own.
def interval_rows(**interval):
    other = copy.copy(run)
    other.summary = {"bounds": {"interval": interval}}
    return [row[:2] for title, rows in page.numbers_of(other)
            if title == "For all parameters of the intervals" for row in rows]
assert interval_rows(lower=1.1, upper=None, intervals={
    "clay/Cohesion": [8000., 12000.], "clay/Friction angle": 30.}) == [
        ("lower", "1.1"), ("upper", "none"), ("clay/Cohesion", "8000 to 12000"),
        ("clay/Friction angle", "30")], interval_rows(lower=1.)
# A bracket in words is not narrower than that of the numbers.
assert answer(size={"method": "strength reduction"}, bounds={"certified": True}, safety={
    "factor": 1.38003297, "lower": 1.37326, "upper": 1.38684}) == (
        "Factor of safety: 1.38 (certified: 1.3732 to 1.3869)")
assert answer(safety={"factor": None, "lower": None, "upper": None}) == ""
assert page.text_of("failed: it stopped remedy: smaller steps") == (
    "failed: it stopped Remedy: smaller steps")
PYTHON
