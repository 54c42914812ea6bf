# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables and studies as Markdown, for pages that people read as text."""

import re
import textwrap


def table_text(head, lines):
    """A table; cells may be anything that has a text."""
    first, *rest = ("| " + " | ".join(" ".join(str(cell).replace("|", "\\|").split())
                                      for cell in line) + " |\n"
                    for line in [head, *lines])
    return first + "|" + "---|" * len(head) + "\n" + "".join(rest)


def wrapped(text):
    """Paragraphs, which are separated by empty lines, in lines of 88 columns."""
    return "".join(textwrap.fill(" ".join(paragraph.split()), 88, break_on_hyphens=False,
                                 break_long_words=False) + "\n\n"
                   for paragraph in re.split(r"\n\s*\n", text.strip()) if paragraph)


def page_text(part, pictures="figures"):
    """A study and what its sections show, as page.write_report() has found it.
    @param pictures the folder of the figures"""
    text = f"# {part['title']}\n\n" + wrapped(part["source"])
    for section in part["sections"]:
        text += f"## {section['title']}\n\n" + wrapped(section["source"])
        text += "".join(f"**{problem}**\n\n" for problem in section["problems"])
        for figure in section["figures"]:
            text += (f"![{section['title']}]({pictures}/{figure['file']})\n\n" +
                     wrapped(figure["source"]))
        for table in section["tables"]:
            text += (table_text(table["head"], table["lines"]) + "\n" +
                     wrapped(table["source"]))
    return text.rstrip("\n") + "\n"
