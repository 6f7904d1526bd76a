"""Where the texts of a plot go."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from tests.reports.explorer.scripts import Ask, asking

Box = dict[str, float]
BOUNDS = {"left": 40, "top": 0, "right": 340, "bottom": 240}
in_browser = settings(deadline=None, max_examples=60)
texts = st.lists(
    st.fixed_dictionaries(
        {"x": st.integers(40, 340), "y": st.integers(0, 240), "width": st.integers(8, 90), "height": st.just(15)}
    ),
    max_size=8,
)


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "beside") as ask:
        yield ask


def overlap(one: Box, other: Box) -> bool:
    across = one["left"] < other["right"] and other["left"] < one["right"]
    return across and one["top"] < other["bottom"] and other["top"] < one["bottom"]


@in_browser
@given(points=texts)
def test_labels_never_lie_on_each_other_nor_outside(ask: Ask, points: list[Box]) -> None:
    taken = {"left": 100, "right": 180, "top": 50, "bottom": 90}
    places = ask("return of.besidePoints(a, b, [c], [])", points, BOUNDS, taken)
    boxes = [place for place in places if place is not None]
    assert not any(overlap(one, other) for one, other in combinations([*boxes, taken], 2))
    for box in boxes:
        assert BOUNDS["left"] <= box["left"]
        assert box["right"] <= BOUNDS["right"]
        assert BOUNDS["top"] <= box["top"]
        assert box["bottom"] <= BOUNDS["bottom"]


def test_one_label_has_always_a_place_beside_its_point(ask: Ask) -> None:
    for x in (40, 190, 340):
        for y in (0, 120, 240):
            (place,) = ask(
                "return of.besidePoints([a], b, [], [])", {"x": x, "y": y, "width": 70, "height": 15}, BOUNDS
            )
            assert place is not None


def test_a_label_goes_where_no_line_is(ask: Ask) -> None:
    point = {"x": 100, "y": 100, "width": 70, "height": 15}
    line = [[x, 92] for x in range(0, 300, 4)]
    (place,) = ask("return of.besidePoints([a], b, [], c)", point, BOUNDS, line)
    assert not place["top"] < 92 < place["bottom"]


@in_browser
@given(steps=st.lists(st.integers(1, 60), min_size=1, max_size=20), width=st.integers(4, 50))
def test_numbers_of_an_axis_never_touch(ask: Ask, steps: list[int], width: int) -> None:
    centres = [sum(steps[: number + 1]) for number in range(len(steps))]
    kept = ask("return of.clearOfNext(a, b)", centres, [width] * len(centres))
    assert kept
    assert all(centres[after] - centres[before] >= width for before, after in pairwise(kept))
