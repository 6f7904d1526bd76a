"""The page of all reports in a folder: of each its title, its answer, its first figure, and when and where it was made.

It is made from the reports' own files, whatever wrote them: what is damaged of one hides nothing of the others.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

from jinja2 import Environment, PackageLoader, StrictUndefined
from markdown_it import MarkdownIt
from markupsafe import Markup, escape

from reports.explorer.compact import compact
from reports.explorer.module import PALETTE, asset
from reports.pages.inline import inline
from reports.pages.made import FILE, made_of
from reports.pages.numbers import unbroken
from sched_sim.errors import InputError

TITLE = "Reports of sched_sim"
INTRODUCTION = (
    "What each report found. Its page begins with the answer and one figure that shows it. "
    "`sched-sim report --all` makes them anew."
)
HEADING = re.compile(r"^# (.+)$", re.MULTILINE)
ANSWER = re.compile(r"^\*\*Answer\.\*\* (.+?)(?:\n\n|\Z)", re.MULTILINE | re.DOTALL)
FIRST_FIGURE = re.compile(r"^!\[([^\]]*)\]\(([^):]+\.svg)\)$", re.MULTILINE)


OURS = {"index.html": f"<title>{TITLE}</title>", "index.md": f"# {TITLE}\n"}
"""What each file of this page holds."""


class Report(NamedTuple):
    """name: of its folder; title, answer: as Markdown, the answer empty where there is none; figure: its file, alt: in
    words, both empty where there is none; made: when, where and in how long it was, in words; empty where nobody wrote
    that down."""

    name: str
    title: str
    answer: str
    figure: str
    alt: str
    made: str


def overview(folder: Path, order: Iterable[str]) -> dict[str, bytes]:
    """The files "index.md" and "index.html" of the reports of these names that are in `folder`."""
    reports = [report_in(folder / name) for name in order if (folder / name / "index.md").is_file()]
    environment = Environment(
        loader=PackageLoader("reports"),
        undefined=StrictUndefined,
        autoescape=lambda name: name is not None and name.endswith(".html.j2"),
        trim_blocks=True,
        lstrip_blocks=True,
    )
    markdown = MarkdownIt("commonmark", {"html": False})
    environment.filters["inline"] = lambda text: Markup(unbroken(markdown.renderInline(text)))
    environment.filters["unbroken"] = lambda text: Markup(unbroken(escape(text)))
    environment.filters["thumbnail"] = lambda report: Markup(_thumbnail(folder, report))
    values = {
        "title": TITLE,
        "introduction": INTRODUCTION,
        "reports": reports,
        "style": Markup(compact(asset(PALETTE))),
    }
    return {
        name: environment.get_template(f"{name}.j2").render(**values).encode() for name in ("index.md", "index.html")
    }


def check_overview(folder: Path) -> None:
    """Raises InputError if a file that the page of all reports would replace is something else."""
    for name, mark in OURS.items():
        path = folder / name
        is_ours = path.is_file() and mark in path.read_text(encoding="utf-8", errors="replace")
        if path.exists() and not is_ours:
            raise InputError(
                f"--output {str(folder)!r}: {str(path)!r} is there and is no page of reports, which would replace it; "
                f"give another folder"
            )


def report_in(folder: Path) -> Report:
    """What its Markdown says, and what stands beside it of its making."""
    text = (folder / "index.md").read_text(encoding="utf-8", errors="replace")
    title, answer, figure = HEADING.search(text), ANSWER.search(text), FIRST_FIGURE.search(text)
    seen = figure is not None and _is_picture(folder / figure[2])
    return Report(
        folder.name,
        title[1] if title else folder.name,
        " ".join(answer[1].split()) if answer else "",
        figure[2] if figure and seen else "",
        figure[1] if figure and seen else "",
        _made(folder),
    )


def _made(folder: Path) -> str:
    try:
        made = made_of(folder)
    except InputError:
        return f"its {FILE} cannot be read"
    return made.words if made else ""


def _is_picture(path: Path) -> bool:
    try:
        return path.is_file() and "viewBox" in ElementTree.fromstring(path.read_bytes()).attrib
    except ElementTree.ParseError:
        return False


def _thumbnail(folder: Path, report: Report) -> str:
    svg = (folder / report.name / report.figure).read_bytes()
    return inline(svg, f"of-{report.name}", report.alt)
