# The Debian package: it says who has made it, what it needs, and holds a Python package
# that "import geocone" finds where Debian looks; links of its pages lead to pages.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
export PYTHONDONTWRITEBYTECODE=1
# Little compression: much takes most of the time.
export DPKG_DEB_COMPRESSOR_LEVEL=0
DEBFULLNAME='Ada Example' DEBEMAIL=ada@example.org \
  "$root/scripts/package" --built "$(dirname "$program")" "$folder" > said
package=$(echo "$folder"/geocone_*.deb)
grep -qx "package: $package" said
dpkg-deb -f "$package" > control
grep -qx 'Maintainer: Ada Example <ada@example.org>' control
for name in libdeal.ii libgmsh python3-meshio python3-jinja2; do
  grep -q "^Depends:.* $name" control
done
dpkg-deb -x "$package" tree
zcat tree/usr/share/doc/geocone/changelog.gz | grep -qx ' -- Ada Example <ada@example.org>  .*'
# Nothing that only a source tree can use, and nothing that a run has left.
[ "$(ls tree/usr/share/geocone/scripts | xargs)" = 'check_certificate plot study' ]
[ -z "$(find tree -name '*.pyc' -o -name results -o -name '*.part')" ]
(cd tree && md5sum --quiet -c <(dpkg-deb -I "$package" md5sums))
[ -s tree/usr/share/bash-completion/completions/geocone ]
# The interpreter, with the package where it would be unpacked.
PYTHONPATH=tree/usr/lib/python3/dist-packages /usr/bin/python3 -c '
import pathlib
import geocone
from geocone.runner import find_program
tree = pathlib.Path("tree").resolve()
assert pathlib.Path(geocone.__file__).resolve().is_relative_to(tree / "usr/share/geocone")
assert find_program() == tree / "usr/bin/geocone"
assert geocone.example("footing_fem.prm").is_relative_to(tree)'
[ "$(readlink tree/usr/lib/python3/dist-packages/geocone)" = ../../../share/geocone/python/geocone ]
/usr/bin/python3 - <<'PYTHON'
import pathlib, re
folder = pathlib.Path("tree/usr/share/doc/geocone")
pages = [*folder.glob("book/*.md"), *folder.glob("cookbook/*.md"), *folder.glob("theory/*.md"),
         *folder.glob("tutorials/*.md"), *folder.glob("*.md"),
         *folder.glob("notebooks/*.ipynb")]
seen = 0
for page in pages:
    if page.name in ("README.md", "CHANGELOG.md") and page.parent == folder:
        continue  # of the source
    for link in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
        if "://" not in link and not link.startswith("../../") and link != "../CONTRIBUTING.md":
            seen += 1
            assert (page.parent / link).exists(), (page, link)
assert seen > 100, seen
PYTHON
if command -v lintian > /dev/null; then
  lintian --fail-on error,warning "$package" > lint || { cat lint; false; }
fi
