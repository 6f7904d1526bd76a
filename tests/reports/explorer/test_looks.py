"""How lines look in the browser, beside how they look in print."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from reports.drawing.style import METHOD_LINES, SOURCE_LINES
from reports.explorer.module import asset
from tests.reports.explorer.scripts import Ask, asking
from tests.reports.explorer.test_palette import COLOURS, DARK, contrast

STROKE_PX = 1.6
PALETTE = re.findall(r"--ss-source-\d: light-dark\((#\w{6}), (#\w{6})\);", asset("plot.css"))


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "looks") as ask:
        yield ask


def test_methods_have_the_dashes_and_the_markers_of_print(ask: Ask) -> None:
    looks = ask("return of.looksOf(a)", [*METHOD_LINES])
    for (method, line), look in zip(METHOD_LINES.items(), looks, strict=True):
        printed = () if isinstance(line.dashes, str) else line.dashes[1]
        assert look["colour"] == f"var(--ss-method-{method})"
        assert look["marker"] == line.marker
        assert [float(dash) for dash in look["dashes"].split()] == pytest.approx(
            [STROKE_PX * dash for dash in printed], abs=0.05
        )


def test_other_names_are_sources_in_turn(ask: Ask) -> None:
    looks = ask("return of.looksOf(a)", ["paper", "dual-rate", *(f"other {number}" for number in range(5))])
    markers = [look["marker"] for look in looks]
    sources = [line.marker for line in SOURCE_LINES]
    assert markers == [sources[0], METHOD_LINES["dual-rate"].marker, *sources[1:], sources[0]]
    assert looks[0] == looks[-1]


def test_no_two_looks_differ_in_colour_alone(ask: Ask) -> None:
    looks = ask("return of.looksOf(a)", [*METHOD_LINES])
    assert len({(look["dashes"], look["marker"]) for look in looks}) == len(looks)


def test_sources_have_the_colours_the_dashes_and_the_markers_of_print(ask: Ask) -> None:
    looks = ask("return of.looksOf(a)", [f"other {number}" for number in range(len(SOURCE_LINES))])
    for line, look, (light, dark) in zip(SOURCE_LINES, looks, PALETTE, strict=True):
        assert look["marker"] == line.marker
        assert [float(dash) for dash in look["dashes"].split()] == pytest.approx(
            [STROKE_PX * dash for dash in ([] if isinstance(line.dashes, str) else line.dashes[1])], abs=0.05
        )
        assert light == line.colour
        assert contrast(dark, COLOURS["ground"][DARK]) >= 3


@pytest.mark.parametrize("marker", sorted({line.marker for line in (*METHOD_LINES.values(), *SOURCE_LINES)}))
def test_a_marker_is_about_its_point(ask: Ask, marker: str) -> None:
    box = ask(
        """const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
        path.setAttribute("d", "M100 50" + of.markerPath(a));
        const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg");
        picture.append(path); document.body.append(picture);
        const {x, y, width, height} = path.getBBox(); return [x, y, x + width, y + height]""",
        marker,
    )
    left, top, right, bottom = box
    assert left <= 100 <= right
    assert top < 50 < bottom
    assert max(right - left, bottom - top) <= 12
