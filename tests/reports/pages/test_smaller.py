"""A picture in a page: the same elements as in its file, in fewer letters."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest
from matplotlib.figure import Figure

from reports.drawing.picture import image
from reports.pages.smaller import smaller


@pytest.fixture(scope="module")
def svg() -> bytes:
    figure = Figure(figsize=(3, 2))
    axes = figure.add_subplot(title="100 % of #1")
    axes.plot([0, 1 / 3, 1], [0, 2 / 3, 1], "o-")
    return image(figure, "svg")


def shown(svg: bytes) -> str:
    return ElementTree.tostring(smaller(svg), encoding="unicode")


def elements(text: str) -> list[str]:
    """All that is seen: no groups, and no metadata."""
    tags = [element.tag.rpartition("}") for element in ElementTree.fromstring(text).iter()]
    return [tag for space, _, tag in tags if tag not in ("g", "metadata") and (not space or "svg" in space)]


def test_the_same_elements_in_fewer_letters(svg: bytes) -> None:
    assert elements(shown(svg)) == elements(svg.decode())
    assert len(shown(svg).encode()) < len(svg)


def test_coordinates_are_moved_by_less_than_a_hundredth_of_a_point(svg: bytes) -> None:
    before, after = (
        [
            float(number)
            for path in re.findall(r" d=[\"']([^\"']*)", text)
            for number in re.findall(r"-?\d+\.?\d*", path)
        ]
        for text in (svg.decode(), shown(svg))
    )
    assert after == pytest.approx(before, abs=0.00501)
    assert any(number != round(number, 2) for number in before)


def test_what_is_scaled_is_scaled_as_much() -> None:
    svg = b'<svg xmlns="http://www.w3.org/2000/svg"><g transform="translate(1.23456 2) scale(0.015625 -0.015)"/></svg>'
    assert 'transform="translate(1.23 2) scale(0.015625 -0.015)"' in shown(svg)
