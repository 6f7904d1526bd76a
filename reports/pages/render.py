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
from markupsafe import Markup

from reports.pages import alive
from reports.pages.body import body_of
from reports.pages.markdown import Row, markdown_of
from reports.pages.pictures import Picture
from sched_sim.errors import InputError
from sched_sim.files.writable import check_writable, write

FOR_PEOPLE = re.compile(r"[-+\N{MINUS SIGN}]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?")
"""A number as tables of a page show it."""


def render(template: str, title: str, figures: Mapping[str, Picture], **values: Any) -> dict[str, bytes]:
    """The files "index.md" and "index.html" from templates/TEMPLATE.md.j2; figures: by file name."""
    markdown = markdown_of(template, title=title, **values)
    body = body_of(markdown, figures)
    page = Environment(
        loader=PackageLoader("reports"),
        undefined=StrictUndefined,
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    html = page.get_template("page.html.j2").render(
        title=title,
        lead=Markup(body.lead),
        rest=Markup(body.rest),
        sections=[(heading.id, Markup(heading.text)) for heading in body.headings if heading.level == 2],
        style=Markup(alive.style()),
        script=Markup(alive.script()),
    )
    return {"index.md": markdown.encode(), "index.html": html.encode()}


def csv_bytes(rows: Sequence[Row]) -> bytes:
    """The table for programs: numbers that people read with commas and a true minus are without, as -1234.5."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([_for_programs(cell) for cell in row] for row in rows)
    return text.getvalue().encode()


def _for_programs(cell: Any) -> Any:
    if isinstance(cell, str) and FOR_PEOPLE.fullmatch(cell):
        return cell.replace(",", "").replace("\N{MINUS SIGN}", "-")
    return cell


def make_folder(folder: Path) -> None:
    """Raises InputError if there is no such folder and none can be made, or it cannot be written."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"--output: {str(folder)!r} cannot be written ({error.strerror}); give a folder that is yours to write"
        ) from None
    page = folder / "index.html"
    try:
        check_writable(page, "--output")
    except InputError:
        raise InputError(f"--output: {str(page)!r} cannot be written; give a folder that is yours to write") from None


def write_report(files: Mapping[str, bytes], folder: Path) -> None:
    """Raises InputError if one of the files cannot be written."""
    for name, content in files.items():
        write(folder / name, content, "--output")
