# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How Sphinx makes the site of the pages that stand in the repository (scripts/site).
Pages are written for readers of the repository, in its Markdown; what a site needs
beyond, i.e. in which order they come, is here."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Text
from myst_parser.parsers.sphinx_ import MystParser

ROOT = Path(__file__).resolve().parents[2]

project, author = "geocone", "the geocone authors"
copyright = "2026, the geocone authors"  # pylint: disable=redefined-builtin
release = re.search(r"project\(geocone VERSION ([\d.]+)",
                    (ROOT / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "sphinx.ext.mathjax"]
root_doc = "README"
include_patterns = ["*.md", "doc/*.md", "doc/book/*.md", "doc/cookbook/*.md",
                    "doc/theory/*.md", "doc/tutorials/*.md", "doc/parameters/*.md",
                    "doc/notebooks/*.ipynb", "packaging/*.md", "meshes/*.md"]
exclude_patterns = ["doc/api.md"]  # the first page of doxygen's site
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
# Files of the repository that pages name are there to be read, as they are.
suppress_warnings = ["myst.header"]

html_theme = "furo"
html_title = "geocone"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = html_show_sourcelink = False

# Formulas are drawn by MathJax as Debian has it; the site holds the part that it needs.
MATHJAX = Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ["MathJax.js", "config/TeX-AMS_SVG-full.js", "jax/output/SVG/autoload",
                 "jax/output/SVG/fonts/TeX", "jax/element", "jax/input/TeX",
                 "extensions/TeX", "extensions/MathEvents.js", "extensions/MathMenu.js",
                 "extensions/MathZoom.js"]
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG-full"
mathjax2_config = {"tex2jax": {"inlineMath": [["\\(", "\\)"]],
                               "displayMath": [["\\[", "\\]"]],
                               "processClass": "math", "ignoreClass": "document"},
                   "SVG": {"scale": 92, "linebreaks": {"automatic": True}}, "messageStyle": "none",
                   "displayAlign": "left", "displayIndent": "1.5em"}

# The Python reference is made from the docstrings of the package and their type hints.
sys.path.insert(0, str(ROOT / "python"))
extensions += ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
napoleon_google_docstring, napoleon_use_ivar = False, True
autodoc_typehints, autodoc_typehints_description_target = "description", "documented"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
default_role = "py:obj"  # of `names` in docstrings
# Names of others, which have no pages here, and kinds of types.
nitpick_ignore_regex = [
    ("py:.*", r"(collections|matplotlib|meshio|numpy|np|os|pandas|pathlib|pyvista|typing)\..*")]

# The pages in the order of the menu, below the first one.
PAGES = {
    "Use": ["doc/tutorials/README", "doc/scenes", "doc/your_own_scene",
            "doc/parameters/README", "doc/cookbook/README", "doc/notebooks/footing",
            "doc/notebooks/slope_factor_of_safety", "doc/notebooks/element_tests",
            "doc/notebooks/calibration",
            "doc/runs", "doc/trust", "doc/element_test", "doc/studies", "doc/python_reference",
            "meshes/README", "packaging/README"],
    "What is known": ["doc/limits", "doc/comparison", "doc/validation", "doc/verification",
                      "doc/verification_mpm", "doc/limit_load", "doc/book/README",
                      "doc/footing_deep", "doc/friction_memory", "doc/small_dilatancy",
                      "doc/small_dilatancy_family", "doc/stability", "doc/performance",
                      "doc/overhead", "doc/paper",
                      "doc/profiles"],
    "How it works": ["doc/theory/README", "CONTRIBUTING", "doc/style", "CHANGELOG"]}


def menu(title, pages):
    """The directive that puts pages into the menu."""
    caption = [f":caption: {title}"] if title else []
    return "\n".join(["", "```{toctree}", ":hidden:", ":maxdepth: 1", *caption, "",
                      *(f"/{page}" for page in pages), "```", ""])


def linked_pages(text):
    """The pages of its own folder that a page links to, in their order."""
    return list(dict.fromkeys(re.findall(r"\]\((\w+)\.md\)", text)))


def add_menu(_, page, source):
    """Before a page is read."""
    if page == root_doc:
        source[0] += "".join(menu(*part) for part in PAGES.items())
    elif page in ("doc/tutorials/README", "doc/parameters/README", "doc/cookbook/README",
                  "doc/theory/README"):
        folder = page[:-len("README")]
        source[0] += menu("", (folder + name for name in linked_pages(source[0])))
    elif page == "CHANGELOG":
        unreleased = subprocess.run([ROOT / "scripts" / "changes"], check=True, text=True,
                                    capture_output=True).stdout
        source[0] = source[0].replace("\n## ", f"\n{unreleased}\n## ", 1)


class ParameterLexer(RegexLexer):
    """Colours of parameter files."""

    name, aliases = "parameter file", ["prm"]
    tokens = {"root": [(r"#.*", Comment),
                       (r"^(\s*)(set)( [^=\n]*)(=)", bygroups(Text, Keyword, Name.Attribute, Text)),
                       (r"^(\s*)(subsection|end|include)\b", bygroups(Text, Keyword)),
                       (r"[^#\n]+", Text), (r"\n", Text)]}


class NotebookParser(MystParser):
    """Reads a notebook as a page: its cells one after another."""

    supported = ("ipynb",)

    def parse(self, inputstring, document):
        cells = ((cell["cell_type"], "".join(cell["source"]))
                 for cell in json.loads(inputstring)["cells"])
        super().parse("\n\n".join(
            text if kind == "markdown" else f"```python\n{text}\n```"
            for kind, text in cells), document)


def add_mathjax(app, problem):
    """After the pages are written; and an index for those who open the folder."""
    if problem:
        return
    site = Path(app.outdir)
    for part in MATHJAX_PARTS:
        source, target = MATHJAX / part, site / "_static" / "mathjax" / part
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, dirs_exist_ok=True)
        else:
            shutil.copy(source, target)
    (site / "index.html").write_text(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<title>geocone</title><meta http-equiv=\"refresh\" content=\"0; url=README.html\">"
        "</head><body><a href=\"README.html\">geocone</a></body></html>\n")


def setup(app):
    """Entry point of Sphinx."""
    app.add_source_suffix(".ipynb", "ipynb")
    app.add_source_parser(NotebookParser)
    app.add_lexer("prm", ParameterLexer)
    app.connect("source-read", add_menu)
    app.connect("build-finished", add_mathjax)
