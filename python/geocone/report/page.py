# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report of studies: one HTML page that holds its pictures."""

import base64
import datetime
import io
import os
import platform
import re
import subprocess
import sys
from pathlib import Path

import jinja2
from PIL import Image
from markupsafe import Markup, escape

from geocone.files import write_whole
from geocone.reader import ReadError
from geocone.report.markdown import page_text, table_text
from geocone.report.schema import find
from geocone.report.runs import own_folder
from geocone.runner import ROOT, duration
from geocone.style import PlotError, Skipped

TEMPLATE = Path(__file__).with_name("page.html")


def paragraphs(text):
    """Paragraphs are separated by empty lines; `words` are parameters or files."""
    parts = [re.sub(r"`([^`]+)`", r"<code>\1</code>", str(escape(part)))
             for part in re.split(r"\n\s*\n", text.strip()) if part]
    return Markup("".join(f"<p>{part}</p>" for part in parts))


def machine(program):
    """Conditions that the times depend on, as (name, value)."""
    def first(pattern, path):
        try:
            found = re.search(pattern, Path(path).read_text(), re.MULTILINE)
        except OSError:
            found = None
        return found[1].strip() if found else "unknown"

    def said(*command):
        try:
            return subprocess.run(command, capture_output=True, text=True, check=True,
                                  cwd=ROOT).stdout.strip()
        except (OSError, subprocess.CalledProcessError):
            return ""
    memory = first(r"^MemTotal:\s*(\d+)", "/proc/meminfo")
    return [
        ("processor", f"{first(r'^model name.*: (.*)$', '/proc/cpuinfo')}, "
         f"{len(os.sched_getaffinity(0))} cores, one thread for each rank"),
        ("memory", f"{int(memory) / 2**20:.0f} GB" if memory.isdigit() else memory),
        ("system", f"{first('^PRETTY_NAME=.(.*).$', '/etc/os-release')}, "
         f"Linux {platform.release()}"),
        ("program", said(str(program), "--version") or "unknown"),
        ("source", said("git", "describe", "--always", "--dirty") or "unknown"),
        ("date", datetime.date.today().isoformat())]


def rows_of(shown, rows):
    """The runs that a figure or a table shows."""
    wanted = shown.get("groups")
    rows = [row for row in rows if wanted is None or row["group"] in wanted]
    if not any(row["status"] == "finished" for row in rows):
        raise ValueError("none of its runs has finished")
    return rows


def figure_data(shown, rows, picture):
    """A drawn figure as data of the page, also left as a file; a picture that is there
    keeps its name."""
    figure = find(shown["kind"])(rows_of(shown, rows), shown)
    if isinstance(figure, Path):
        picture, drawn = picture.with_name(figure.name), figure.read_bytes()
    else:
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=130)
        drawn = buffer.getvalue()
    write_whole(picture, drawn)
    return {"data": base64.b64encode(drawn).decode(), "file": picture.name,
            "is_there": isinstance(figure, Path), "caption": paragraphs(shown.get("caption", "")),
            "source": shown.get("caption", "")}


def table_data(shown, rows):
    """Head and lines of a table."""
    head, lines = find(shown["kind"])(rows_of(shown, rows), shown)
    return {"head": head, "lines": lines, "caption": paragraphs(shown.get("caption", "")),
            "source": shown.get("caption", "")}


def failure_line(what, shown, problem):
    """The reason why something cannot be shown, in a line; also on the screen."""
    text = " ".join((str(problem) if isinstance(problem, (
        ValueError, PlotError, ReadError, Skipped)) else repr(problem)).split())
    print(f"error: the {what} {shown['kind']} cannot be shown: {text}", file=sys.stderr)
    return f"the {what} {shown['kind']} cannot be shown: {text}"


def section_data(study, number, section, rows, folder):
    """Content of a section; problems are reported in place of failed parts."""
    data = {"title": section.get("title", ""), "id": f"{study.name}-{number}",
            "text": paragraphs(section.get("text", "")),
            "source": section.get("text", ""), "figures": [], "tables": [],
            "problems": []}
    for i, shown in enumerate(section.get("figure", [])):
        picture = folder / f"{study.name}-{number}-{i + 1}.png"
        try:
            data["figures"].append(figure_data(shown, rows, picture))
        except Exception as problem:  # of one figure: the others are still shown
            data["problems"].append(failure_line("figure", shown, problem))
    for i, shown in enumerate(section.get("table", [])):
        try:
            table = table_data(shown, rows)
        except Exception as problem:
            data["problems"].append(failure_line("table", shown, problem))
            continue
        data["tables"].append(table)
        write_whole(folder / f"{study.name}-{number}-{i + 1}.md",
                    table_text(table["head"], table["lines"]))
    return data


def write_page(path, part, folder):
    """Writes a study as a page of documentation, its figures into 'images' beside it.
    @param folder of the figures"""
    pictures = path.parent / "images"
    pictures.mkdir(exist_ok=True)
    for section in part["sections"]:
        for figure in section["figures"]:
            if figure["is_there"] and (pictures / figure["file"]).is_file():
                continue
            small = io.BytesIO()
            with Image.open(folder / figure["file"]) as picture:
                picture.convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(
                    small, "png", optimize=True)
            write_whole(pictures / figure["file"], small.getvalue())
    write_whole(path, page_text(part, pictures.name))


def write_report(path, studies, program, page=None):
    """Writes the report.
    @param studies pairs of a study and its rows
    @param page of documentation, of the only study
    @return the problems of figures and tables"""
    folder = own_folder(path.parent / "figures")
    parts, problems = [], []
    for study, rows in studies:
        sections = [section_data(study, number + 1, section, rows, folder)
                    for number, section in enumerate(study.sections)]
        problems += [text for section in sections for text in section["problems"]]
        file = study.path
        parts.append({
            "title": study.title, "name": study.name, "text": paragraphs(study.text),
            "source": study.text,
            "file": file.relative_to(ROOT) if file.is_relative_to(ROOT) else file,
            "sections": sections, "rows": rows,
            "failed": sum(row["status"] == "failed" for row in rows),
            "time": duration(sum(row["seconds"] for row in rows))})
        write_whole(path.parent / f"{study.name}.md", page_text(parts[-1]))
    if page is not None and not problems:
        write_page(page, parts[0], folder)
    environment = jinja2.Environment(autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    template = environment.from_string(TEMPLATE.read_text())
    write_whole(path, template.render(parts=parts, machine=machine(program)))
    return problems
