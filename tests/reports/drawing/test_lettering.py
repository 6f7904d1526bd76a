"""The texts of an SVG: found, as they are read, and as wide whatever the font."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from reports.drawing.lettering import FAMILIES, advance
from reports.drawing.picture import image
from reports.drawing.style import FONT_PT, page, text_width_mm
from tests.browser import Visit
from tests.svg import texts

FORMULA = r"$L$ asked for, $\sqrt{q}$ & $10^{-3}$ <b>"


def written(text: str, *, rim: bool = False, **look: object) -> Figure:
    """A page with this text on it alone."""
    figure = page(20)
    artist = figure.text(0.5, 0.5, text, **look)
    if rim:
        artist.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
    return figure


def attribute(svg: bytes, name: str) -> float:
    (found,) = re.findall(rf'{name}="([\d.]+)"', svg.decode())
    return float(found)


@given(st.text("aV.7−†µ", min_size=1, max_size=6), st.text("aV.7−†µ", min_size=1, max_size=6))
def test_a_text_is_as_long_as_its_parts_but_for_how_near_two_letters_stand(one: str, other: str) -> None:
    assert advance(one) + advance(other) == pytest.approx(advance(one + other), abs=0.2)


@pytest.mark.parametrize("text", ["late, 12 % of AVATAR", "Dual-rate", "−0.25"])
def test_its_length_is_that_which_matplotlib_lays_out(text: str) -> None:
    assert advance(text) * FONT_PT == pytest.approx(text_width_mm(text, FONT_PT) / 25.4 * 72, abs=0.2 * FONT_PT)
    svg = image(written(text, size=FONT_PT), "svg")
    assert attribute(svg, "textLength") == pytest.approx(advance(text) * FONT_PT, abs=0.006)


@pytest.mark.parametrize("rim", [False, True])
def test_a_formula_is_read_from_left_to_right(rim: bool) -> None:
    assert texts(image(written(FORMULA, rim=rim), "svg")) == ["L asked for, √q & 10−3 <b>"]


def test_a_text_with_a_rim_is_a_text_and_keeps_it_for_other_formats() -> None:
    figure = written("12 %", rim=True)
    svg = image(figure, "svg").decode()
    assert "paint-order: stroke; stroke: #ffffff; stroke-width: 2.5" in svg
    assert image(figure, "png") == image(written("12 %", rim=True), "png")
    assert image(figure, "png") != image(written("12 %"), "png")


def test_it_has_a_title_and_is_one_image() -> None:
    root = ElementTree.fromstring(image(written("x"), "svg", "a <b> & \x1b"))
    assert root.get("role") == "img"
    assert root[0].tag.endswith("title")
    assert root[0].text == r"a <b> & \x1b"


def test_in_another_font_every_text_is_as_wide(visit: Visit) -> None:
    figure = written("WAVE: 12 % of ill", size=9)
    figure.text(0.1, 0.2, FORMULA)
    figure.text(0.1, 0.8, "bold AVATAR", weight="bold", rotation=30)
    own = image(figure, "svg").decode()
    other = own.replace(FAMILIES, "'DejaVu Sans Mono'")
    assert other != own
    widths = []
    for svg in (own, own.replace("textLength", "data-length"), other):
        visit.page.set_content(svg)
        widths.append(visit.page.eval_on_selector_all("text", "all => all.map((text) => text.getBBox().width)"))
    assert widths[1] == pytest.approx(widths[0], rel=0.01)
    assert widths[2] == pytest.approx(widths[0], rel=0.03)
