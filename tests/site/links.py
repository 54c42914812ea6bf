"""What the pages of a site link to and load: all of it must be in the site, and nothing
may be loaded from elsewhere. links.py SITE prints what is wrong, and how much it has seen."""

import html.parser
import sys
from pathlib import Path
from urllib.parse import unquote, urlsplit

site = Path(sys.argv[1]).resolve()


class Page(html.parser.HTMLParser):
    """The places of a page that can be linked to, and what it refers to."""

    def __init__(self, path):
        super().__init__()
        self.path, self.ids, self.links, self.loads = path, set(), [], []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.ids.add(value)
            elif name == "href" and tag == "a":
                self.links.append(value)
            elif name in ("href", "src", "data", "action") and value:
                self.loads.append(value)


pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
problems, seen = [], 0
for path, page in pages.items():
    for text in page.links + page.loads:
        url = urlsplit(text)
        if url.scheme == "data":
            continue
        seen += 1
        if url.scheme or url.netloc:
            if text in page.loads:
                problems.append(f"{path.relative_to(site)} loads {text}")
            continue
        target = (path.parent / unquote(url.path)).resolve() if url.path else path
        if not target.is_file() or site not in target.parents:
            problems.append(f"{path.relative_to(site)} has {text}, which is not there")
        elif url.fragment and target in pages and unquote(
                url.fragment) not in pages[target].ids:
            problems.append(f"{path.relative_to(site)} has {text}, a place that is not "
                            "there")
print("\n".join(problems))
for style in site.rglob("*.css"):
    if "url(http" in style.read_text().replace('"', "").replace("'", ""):
        problems.append(str(style))
        print(f"{style} loads from elsewhere")
print(f"{len(pages)} pages, {seen} links")
sys.exit(bool(problems) or seen < 1000)
