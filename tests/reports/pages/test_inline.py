"""Pictures in one page: each says what it shows, keeps its names to itself, and has its colours for the dark."""

from __future__ import annotations

import re
from html import unescape
from io import BytesIO

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread

from reports.drawing.dark import dark
from reports.drawing.picture import image
from reports.pages.inline import inline
from tests.browser import Visit

ALT = 'Late: 12 % of "all" & <some>'


def figure(colour: str) -> Figure:
    axes = (drawn := Figure(figsize=(3, 2))).add_subplot(title="100 % of #1  & more")
    axes.bar([0, 1], [1, 2], color=colour, hatch="//", edgecolor="#11538c")
    axes.plot([0, 1 / 3, 1], [0, 2 / 3, 1], "o-", color="#c00000")
    return drawn


@pytest.fixture(scope="module")
def svg() -> bytes:
    return image(figure("#b3d4ee"), "svg")


def test_names_of_several_pictures_do_not_meet_and_each_refers_to_its_own(svg: bytes) -> None:
    one, other = (inline(svg, name, ALT) for name in ("figure1", "figure2"))
    ids = [re.findall(r' id="([^"]*)"', text) for text in (one, other)]
    assert ids[0]
    assert not set(ids[0]) & set(ids[1])
    for text, own in zip((one, other), ids, strict=True):
        assert set(re.findall(r"(?:url\(|href=\")#([\w-]+)", text)) == set(own)
        assert set(re.findall(r'class="([^"]*)"', text)) == set(re.findall(r"\.([\w-]+)[^}]*\{", text))
    assert one.replace("figure1", "figure2") == other


def test_it_is_an_image_named_by_what_it_shows(svg: bytes) -> None:
    text = inline(svg, "figure1", ALT)
    assert 'role="img"' in text
    assert [unescape(title) for title in re.findall("<title>(.*?)</title>", text)] == [ALT]


def test_every_colour_has_another_for_the_dark(svg: bytes) -> None:
    text = inline(svg, "figure1", ALT)
    assert f"light-dark(#b3d4ee,{dark('#b3d4ee')})" in text
    assert re.sub(r"light-dark\([^)]*\)", "", text).count("#") == len(re.findall(r"(?:url\(|href=\")#", text)) + 1


def test_in_a_browser_it_looks_as_its_file_does(visit: Visit, svg: bytes) -> None:
    page = visit.page
    shots = []
    for picture in (svg.decode()[svg.decode().index("<svg") :], inline(svg, "figure1", ALT)):
        page.set_content(f"<!doctype html><style>svg {{width: 600px; height: 400px}}</style>{picture}")
        shots.append(imread(BytesIO(page.locator("svg").screenshot())))
    assert shots[0].std() > 0.1
    assert np.abs(shots[0] - shots[1]).max() < 0.06, "coordinates are moved by half a hundredth of a point"


def test_its_texts_are_found_and_spaces_in_them_stay(visit: Visit, svg: bytes) -> None:
    visit.page.set_content(inline(svg, "figure1", ALT))
    assert visit.page.evaluate("window.find('#1')")
    assert "100 % of #1  & more" in visit.page.eval_on_selector_all("text", "all => all.map(it => it.textContent)")
