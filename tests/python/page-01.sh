# report.html holds all that it shows: pictures that are pictures, the numbers of the
# summary, the parameters, and a slider where there are several times. It asks for
# nothing else, is small, and a browser (where there is one) runs its script.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/contact/incline.prm" --quiet --output run \
  --set 'Discretisation/Method = MPM' --set 'Loading/slide/Duration = 0.1' \
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
    images, words, inputs = [], [], []
    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        assert tag not in ("link", "iframe", "a"), tag
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
assert len(page.images) >= 4, len(page.images)
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
assert "set Friction coefficient" in words and "0.3" in words
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
  grep -q '<output id="shown">0 s</output>' dom
fi
