"""A report as files: one Markdown template gives the Markdown file and one self-contained HTML page.

Figures stand in the Markdown as links to SVG files; in the HTML page they are the SVG itself, so that it opens offline,
and beside it the data from which the page's script makes it alive.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markdown_it import MarkdownIt
from markupsafe import Markup

from reports.pages import alive
from reports.pages.data_uri import data_uri
from reports.pages.pictures import Picture
from sched_sim.errors import InputError
from sched_sim.files.writable import check_writable, write

Row = Sequence[Any]


FIGURE = re.compile(r'<p><img src="([^":]+\.svg)"([^>]*)></p>')


def render(template: str, title: str, figures: Mapping[str, Picture], **values: Any) -> dict[str, bytes]:
    """The files "index.md" and "index.html" from templates/TEMPLATE.md.j2; figures: by file name."""
    environment = Environment(
        loader=PackageLoader("reports"), undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["table"] = markdown_table
    markdown = environment.get_template(f"{template}.md.j2").render(title=title, **values)
    body = MarkdownIt("commonmark", {"html": True}).enable("table").render(markdown)
    page = Environment(loader=PackageLoader("reports"), undefined=StrictUndefined, autoescape=True)
    html = page.get_template("page.html.j2").render(
        title=title,
        body=Markup(FIGURE.sub(lambda match: _figure(figures[match[1]], match[2]), body)),
        style=Markup(alive.style()),
        script=Markup(alive.script()),
    )
    return {"index.md": markdown.encode(), "index.html": html.encode()}


def _figure(picture: Picture, attributes: str) -> str:
    """The SVG itself, as a data URI: identifiers in one SVG cannot meet those of another."""
    return alive.figure(f'<img src="{data_uri(picture.svg)}"{attributes}>', picture.alive)


def markdown_table(rows: Sequence[Row]) -> str:
    """The first row is the heading; columns of numbers are aligned right."""
    heading, *body = rows
    numeric = [all(_is_number(row[column]) for row in body) for column in range(len(heading))]
    lines = [heading, ["---:" if right else "---" for right in numeric], *body]
    return "\n".join("| " + " | ".join(_unbroken(str(cell)) for cell in line) + " |" for line in lines)


def _unbroken(cell: str) -> str:
    """A line may end before an interval, not in it."""
    return re.sub(r"(?<=[\d.%]) (to|±) (?=[-\d])", "\N{NO-BREAK SPACE}\\1\N{NO-BREAK SPACE}", cell)


def _is_number(cell: Any) -> bool:
    return re.fullmatch(r"[-+]?[\d., ]+( ?%)?|-", str(cell)) is not None


def csv_bytes(rows: Sequence[Row]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue().encode()


def make_folder(folder: Path) -> None:
    """Raises InputError if there is no such folder and none can be made, or it cannot be written."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"--output: {str(folder)!r} cannot be written ({error.strerror}); give a folder that is yours to write"
        ) from None
    check_writable(folder / "index.html", "--output")


def write_report(files: Mapping[str, bytes], folder: Path) -> None:
    """Raises InputError if one of the files cannot be written."""
    for name, content in files.items():
        write(folder / name, content, "--output")
