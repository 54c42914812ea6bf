# The site is built; all that its pages link to, with place, and all that they load is in
# it; every parameter is on a page; and a page that links to nothing is refused. A browser (where there is one) draws all
# formulas and searches, without a network.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
GEOCONE=$program "$root/scripts/site" "$folder/site" > said
grep -qx "site: $folder/site/index.html" said
/usr/bin/python3 -B "$root/tests/site/links.py" site
# Every page of the repository is in it, also by its menu.
cd "$root"
for page in *.md doc/*.md doc/cookbook/*.md doc/theory/*.md doc/tutorials/*.md; do
  [ "$page" = doc/api.md ] && continue # doxygen's
  [ -f "$folder/site/${page%.md}.html" ]
  grep -q "toctree-l.*href=\"\(${page%.md}.html\|#\)\"" "$folder/site/README.html" ||
    grep -q "toctree-l.*href=\"$(basename "${page%.md}").html\"" \
      "$folder/site/$(dirname "$page")/README.html" || [ "$page" = README.md ]
done
cd "$folder"
"$program" --schema > schema.json
/usr/bin/python3 -B "$root/tests/site/parameters.py" schema.json site/doc/parameters
# The checks find what is wrong.
cp -r site damaged
rm damaged/doc/limit_load.html damaged/_images/footing_mpm.png
sed -i 's/id="in-paraview"/id="other"/' damaged/doc/runs.html
sed -i 's|</body>|<script src="https://example.org/a.js"></script></body>|' damaged/search.html
fails /usr/bin/python3 -B "$root/tests/site/links.py" damaged > said
for words in 'limit_load.html, which is not there' 'footing_mpm.png, which is not there' \
  'in-paraview, a place that is not there' \
  'search.html loads https://example.org/a.js'; do
  grep -q "$words" said
done
# Two pages are enough to see that links to nothing are refused.
mkdir -p broken/doc/cookbook broken/doc/parameters
cp -r "$root/CMakeLists.txt" "$root/scripts" "$root/python" broken
cp -r "$root/doc/site" broken/doc
echo 'PAGES = {"Use": ["doc/parameters/README", "doc/cookbook/README"]}' >>broken/doc/site/conf.py
for page in README doc/parameters/README doc/cookbook/footing; do echo '# Title' >broken/$page.md; done
printf '# Title\n[a](bar.md), [b](footing.md)\n' >broken/doc/cookbook/README.md
echo '# Title' >broken/doc/cookbook/bar.md
broken/scripts/site "$folder/accepted" >said 2>&1 || { cat said; exit 1; }
[ -f accepted/doc/cookbook/bar.html ]
cat >>broken/doc/cookbook/bar.md <<'TEXT'

[a](none.md), [b](../../prm/none.prm), [c](footing.md#none), ![d](none.png)
TEXT
fails broken/scripts/site "$folder/refused" > said 2>&1
[ ! -e refused ]
for name in none.md none.prm "[#']none\>" none.png; do
  grep -q "bar.md.*$name" said
done
# What is no site is not overwritten.
mkdir other && touch other/file
fails "$root/scripts/site" "$folder/other" 2> said
grep -q 'is no site' said && [ -e other/file ]
if command -v chromium > /dev/null; then
  shows() {
    chromium --headless --no-sandbox --disable-gpu --virtual-time-budget=60000 \
      --host-resolver-rules='MAP * ~NOTFOUND' --dump-dom "file://$folder/site/$1" 2> /dev/null
  }
  all=0
  # One start of the browser for the articles of all pages, one after another.
  pages=(site/doc/theory/*.html) together=site/doc/theory/together.html
  sed '/<article/,$d' "${pages[0]}" >$together
  for page in "${pages[@]}"; do
    sed -n '/<article/,/<\/article>/p' "$page" >article
    formulas=$(grep -o 'class="math notranslate' article | wc -l)
    [ "$formulas" = "$(grep -o 'class="math notranslate' "$page" | wc -l)" ]
    all=$((all + formulas))
    cat article >>$together
  done
  sed '1,/<\/article>/d' "${pages[0]}" >>$together
  shows "${together#site/}" > dom
  rm $together
  [ "$(grep -o '<svg' dom | wc -l)" -ge "$all" ]
  fails grep -q 'class="merror\|<merror\|Math Processing Error' dom
  [ "$all" -gt 500 ]
  shows 'search.html?q=Prandtl' > dom
  fails grep -q '<a href="doc/cookbook/footing.html' site/search.html
  shows 'search.html?q=Swelling+index' > parameter
  grep -q '<a href="doc/parameters/materials.html' parameter
  grep -q '<a href="doc/cookbook/footing.html' dom
fi
