"""Colours on a dark ground: no less is seen of them than on paper, and they are the same to the eye."""

from __future__ import annotations

import colorsys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgb

from reports.drawing.dark import DARK_GROUND, contrast, dark, luminance, raised, themed
from reports.explorer.module import asset

COLOURS = st.integers(0, 256**3 - 1).map(lambda number: f"#{number:06x}")
ROUNDED = 1.04
"""A colour has 8 bits of each part: dark ones differ from one to the next by so much of a contrast."""


def test_the_ground_is_that_of_the_page() -> None:
    assert f"--ss-ground: light-dark(#ffffff, {DARK_GROUND});" in asset("palette.css")
    assert dark("#ffffff") == DARK_GROUND
    assert contrast("#000000", "#ffffff") == pytest.approx(21)


@given(COLOURS)
def test_it_stands_out_from_the_ground_as_much_as_from_paper_or_more(colour: str) -> None:
    wanted = min(raised(contrast(colour, "#ffffff")), contrast(DARK_GROUND, "#ffffff"))
    assert wanted * ROUNDED >= contrast(colour, "#ffffff") * 18 / 21
    assert wanted / ROUNDED <= contrast(dark(colour), DARK_GROUND) <= wanted * ROUNDED


@given(COLOURS, COLOURS)
def test_what_is_darker_on_paper_is_brighter_in_the_dark(one: str, other: str) -> None:
    low, high = sorted((one, other), key=luminance)
    assert luminance(dark(high)) <= luminance(dark(low)) * ROUNDED + 0.005


@pytest.mark.parametrize("colour", ["#11538c", "#c00000", "#2e7d4f", "#dd9009", "#b3d4ee", "#fbe3b5"])
def test_the_hue_stays(colour: str) -> None:
    before, after = (360 * colorsys.rgb_to_hls(*to_rgb(it))[0] for it in (colour, dark(colour)))
    assert after == pytest.approx(before, abs=22)


def test_declarations_have_both() -> None:
    assert themed("fill:none;stroke:#ffffff") == f"fill:none;stroke:light-dark(#ffffff,{DARK_GROUND})"
    assert themed("fill:url(#abcdef)") == "fill:url(#abcdef)"
