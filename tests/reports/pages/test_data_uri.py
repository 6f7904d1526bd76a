"""A picture in a page: the same elements as in the file, and nothing that would end the attribute or the address."""

from __future__ import annotations

import re
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest
from matplotlib.figure import Figure

from reports.drawing.picture import image
from reports.pages.data_uri import data_uri


@pytest.fixture(scope="module")
def svg() -> bytes:
    figure = Figure(figsize=(3, 2))
    axes = figure.add_subplot(title="100 % of #1")
    axes.plot([0, 1 / 3, 1], [0, 2 / 3, 1], "o-")
    return image(figure, "svg")


def elements(text: str) -> list[str]:
    """All that is seen: no groups, and no metadata."""
    unseen = ("}g", "}metadata")
    return [it.tag for it in ElementTree.fromstring(text).iter() if "svg" in it.tag and not it.tag.endswith(unseen)]


def test_the_same_elements(svg: bytes) -> None:
    kind, _, text = data_uri(svg).partition(",")
    assert kind == "data:image/svg+xml"
    assert elements(unquote(text)) == elements(svg.decode())


def test_it_ends_neither_the_attribute_nor_the_address_and_is_smaller(svg: bytes) -> None:
    uri = data_uri(svg)
    assert not set('"#\n') & set(uri)
    assert len(uri) < len(svg)


def test_coordinates_are_moved_by_less_than_a_hundredth_of_a_point(svg: bytes) -> None:
    before, after = (
        [
            float(number)
            for path in re.findall(r" d=[\"']([^\"']*)", text)
            for number in re.findall(r"-?\d+\.?\d*", path)
        ]
        for text in (svg.decode(), unquote(data_uri(svg)))
    )
    assert after == pytest.approx(before, abs=0.00501)
    assert any(number != round(number, 2) for number in before)
