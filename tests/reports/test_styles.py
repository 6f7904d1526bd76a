"""Figures of all reports, as they are published: said, told apart, and one look for one method or source."""

from __future__ import annotations

import json
import re
from collections import defaultdict
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from reports.charts.panels import METHOD_NAMES
from reports.drawing.style import METHOD_LINES, NOISE_LINES, SOURCES, Line
from reports.pages.machine import marked
from reports.pages.minus import true_minus
from tests.reports.explorer.test_palette import contrast
from tests.reports.published import FOLDER

REPORTS = sorted(path.name for path in FOLDER.iterdir() if path.is_dir())
FIGURE = re.compile(r"!\[(?P<alt>[^\]]*)\]\((?P<file>[^)]+\.svg)\)\n\n(?P<caption>.*)")
LEAST_LETTERS = 30
"""Of a text that says what is seen."""
DATA = re.compile(r'<script type="application/json">(.*?)</script>', re.DOTALL)
TEXT = re.compile(r"<text[^>]*>(.*?)</text>|<!-- (.*?) -->", re.DOTALL)
FORMULA = re.compile(r"\$.*?\$")
"""Set with true minus signs by matplotlib."""


@cache
def markdown(report: str) -> str:
    return (FOLDER / report / "index.md").read_text()


@cache
def told() -> list[tuple[str, dict[str, Any]]]:
    """The curves that have a label, in all figures of all reports, as their pages have them."""
    return [
        (report, line)
        for report in REPORTS
        for data in DATA.findall((FOLDER / report / "index.html").read_text())
        for plot in json.loads(data).get("plots", [])
        for line in plot["lines"]
    ]


def colour(line: dict[str, Any]) -> str:
    """In the light."""
    found = re.search(r"#\w{6}", line["colour"])
    assert found
    return found[0]


KNOWN: dict[str, Line] = {
    **{METHOD_NAMES[method]: line for method, line in METHOD_LINES.items()},
    "Dual-rate, Q′": NOISE_LINES["sum"],
    "Dual-rate, Q″": NOISE_LINES["euler"],
    **{marked(source) if source == "measured" else source: line for source, line in SOURCES.items()},
}
"""By the name that a curve has."""


@pytest.mark.parametrize("report", REPORTS)
def test_every_figure_has_an_alternative_text_and_a_caption_and_is_numbered(report: str) -> None:
    found = list(FIGURE.finditer(markdown(report)))
    assert {of["file"] for of in found} == {path.name for path in (FOLDER / report).glob("*.svg")}
    for number, of in enumerate(found, start=1):
        assert len(of["alt"]) >= LEAST_LETTERS, of["file"]
        caption, _, links = of["caption"].removeprefix(f"**Figure {number}.** ").rpartition(" *")
        assert len(caption) >= LEAST_LETTERS, of["file"]
        assert f"[{of['file']}]({of['file']})" in links
        assert caption != of["caption"], of["file"]


def test_a_method_and_a_source_look_alike_in_all_figures_of_all_reports() -> None:
    looks = defaultdict(set)
    for _, line in told():
        name = next((known for known in KNOWN if line["name"].lower() == known.lower()), "")
        if name:
            looks[name].add((colour(line), line.get("marker", KNOWN[name].marker)))
    assert looks == {name: {(KNOWN[name].colour, KNOWN[name].marker)} for name in looks}
    assert len(looks) > len(METHOD_LINES) / 2


def test_a_variant_of_a_method_has_its_colour() -> None:
    """Such as "Larsen, extended"."""
    of_method = [(line, line["name"].partition(", ")[0]) for _, line in told() if line["name"] not in KNOWN]
    others = {
        line["name"]: colour(line) for line, name in of_method if name in KNOWN and colour(line) != KNOWN[name].colour
    }
    assert others == {}


def test_methods_and_sources_have_one_name() -> None:
    """No identifier, no other case, and no source that is measured without its mark."""
    others = {name.lower() for name in KNOWN} | set(METHOD_LINES) | {"measured"}
    assert {line["name"] for _, line in told() if line["name"].lower() in others} <= set(KNOWN)


@pytest.mark.parametrize("report", REPORTS)
def test_every_curve_stands_out_from_the_page(report: str) -> None:
    of = {colour(line) for name, line in told() if name == report}
    assert {one for one in of if contrast(one, "white") < 3} == set()


@pytest.mark.parametrize("report", REPORTS)
def test_no_number_of_a_page_or_a_figure_has_a_hyphen_for_its_minus(report: str) -> None:
    assert true_minus(markdown(report)) == markdown(report)
    for path in (FOLDER / report).glob("*.svg"):
        written = [FORMULA.sub("", text or comment) for text, comment in TEXT.findall(path.read_text())]
        assert [text for text in written if true_minus(text) != text] == [], path.name


TEMPLATES = sorted((Path(__file__).parents[2] / "reports" / "templates").glob("*.md.j2"))


@pytest.mark.parametrize("path", TEMPLATES, ids=lambda path: path.name)
def test_nor_has_a_number_of_a_template(path: Path) -> None:
    """But in expressions."""
    text = re.sub(r"\{\{.*?\}\}|\{%.*?%\}", "", path.read_text(), flags=re.DOTALL)
    assert true_minus(text) == text
