"""Path data of lines: what they pass through, and what they leave out."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from tests.reports.explorer.scripts import Ask, asking

Value = float | None
PATH = "const at = (value) => value; return of.linePath(a, b, at, at, c)"
in_browser = settings(deadline=None, max_examples=40)
pixels = st.integers(0, 300).map(float)


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "paths") as ask:
        yield ask


def corners(path: str) -> list[list[tuple[float, float]]]:
    """The pieces of a path, each as the points it passes through."""
    pieces: list[list[tuple[float, float]]] = []
    for letter, numbers in re.findall(r"([MLHVh])([^MLHVh]*)", path):
        values = [float(number) for number in numbers.split()]
        if letter == "M":
            pieces.append([(values[0], values[1])])
            continue
        x, y = pieces[-1][-1]
        if letter == "L":
            x, y = values
        elif letter == "H":
            (x,) = values
        elif letter == "V":
            (y,) = values
        pieces[-1].append((x, y))
    return pieces


@st.composite
def lines(draw: st.DrawFn) -> tuple[list[float], list[Value]]:
    xs = sorted(draw(st.sets(pixels, min_size=1, max_size=30)))
    ys = draw(st.lists(st.one_of(st.none(), pixels), min_size=len(xs), max_size=len(xs)))
    return xs, ys


def pieces_of(xs: Sequence[float], ys: Sequence[Value]) -> list[list[tuple[float, float]]]:
    pieces: list[list[tuple[float, float]]] = [[]]
    for x, y in zip(xs, ys, strict=True):
        if y is None:
            pieces.append([])
        else:
            pieces[-1].append((x, y))
    return [piece for piece in pieces if piece]


@in_browser
@given(line=lines())
def test_a_line_passes_through_its_points_and_has_gaps_where_there_are_none(
    ask: Ask, line: tuple[list[float], list[Value]]
) -> None:
    xs, ys = line
    drawn = corners(ask(PATH, xs, ys, False))
    assert [[*dict.fromkeys(piece)] for piece in drawn] == pieces_of(xs, ys)


@in_browser
@given(line=lines())
def test_a_step_line_holds_each_value_until_the_next_x(ask: Ask, line: tuple[list[float], list[Value]]) -> None:
    xs, ys = line
    drawn = [corner for piece in corners(ask(PATH, xs, ys, True)) for corner in piece]
    for index, (x, y) in enumerate(zip(xs, ys, strict=True)):
        if y is None:
            continue
        assert (x, y) in drawn
        if index + 1 < len(xs):
            assert (xs[index + 1], y) in drawn


@pytest.mark.parametrize("step", [False, True])
def test_of_very_many_points_it_keeps_what_half_a_pixel_can_show(ask: Ask, step: bool) -> None:
    xs = [number / 100 for number in range(30_000)]
    ys = [150.0 + (number * 7919 % 100) for number in range(30_000)]
    (drawn,) = corners(ask(PATH, xs, ys, step))
    assert len(drawn) <= 5 * 2 * 300 + 5
    for pixel in range(1, 299):
        here = [y for x, y in drawn if pixel - 1 <= x <= pixel + 1]
        assert (min(here), max(here)) == (150.0, 249.0)


@in_browser
@given(line=lines(), at=pixels, step=st.booleans())
def test_a_value_is_that_of_the_point_or_that_which_holds(
    ask: Ask, line: tuple[list[float], list[Value]], at: float, step: bool
) -> None:
    xs, ys = line
    index = bisect_right(xs, at) - 1
    holds = index >= 0 and (step or xs[index] == at)
    assert ask("return of.valueAt(...a)", [xs, ys, at, step]) == (ys[index] if holds else None)


@in_browser
@given(line=lines(), apart=st.integers(1, 80), start=st.integers(0, 40), step=st.booleans())
def test_markers_are_apart_and_on_the_line_and_none_that_stands_alone_is_left_out(
    ask: Ask, line: tuple[list[float], list[Value]], apart: int, start: int, step: bool
) -> None:
    xs, ys = line
    scale = "const at = (value) => value; at.invert = at;"
    found = ask(
        f"{scale} return of.markerPlaces(a, {{x: at, y: at}}, ...b)", {"x": xs, "y": ys, "step": step}, [apart, start]
    )
    known = [y is not None for y in ys]
    alone = [
        [x, y] for x, y, before, after in zip(xs, ys, [False, *known], [*known[1:], False], strict=False)
        if y is not None and not before and not after
    ]  # fmt: skip
    assert bool(found) is any(known)
    for x, y in found:
        assert ys[bisect_right(xs, x) - 1] == y
    others = [x for x, y in found if step or [x, y] not in alone]
    assert all(after - before >= apart for before, after in pairwise(others))
    if not step:
        assert all(place in found for place in alone)


@in_browser
@given(line=lines(), step=st.booleans())
def test_points_along_a_line_are_on_it_and_leave_no_room_for_a_label(
    ask: Ask, line: tuple[list[float], list[Value]], step: bool
) -> None:
    xs, ys = line
    body = "const at = (value) => value; return of.pointsAlong({x: a, y: b, step: c}, {x: at, y: at})"
    along = ask(body, xs, ys, step)
    assert all(min(xs) <= x <= max(xs) for x, _ in along)
    if step:
        for (left, y), right in zip(zip(xs, ys, strict=True), xs[1:], strict=False):
            if y is not None and right - left > 16 and ys[xs.index(right)] is not None:
                here = [x for x, down in along if down == y and left <= x <= right]
                assert here


def test_a_step_line_is_held_until_the_end_and_another_is_not(ask: Ask) -> None:
    held = ask("return of.heldUntil({x: [4], y: [0.5], step: true}, 20)")
    assert (held["x"], held["y"]) == ([4, 20], [0.5, 0.5])
    line = {"x": [4], "y": [0.5], "step": False}
    assert ask("return of.heldUntil(a, 20)", line) == line
    assert ask("return of.heldUntil({x: [], y: [], step: true}, 20)")["x"] == []


def test_a_line_that_comes_from_the_right_is_turned_round(ask: Ask) -> None:
    line = {"x": [3, 2, 2, 1], "y": [5, 6, 7, 8], "notes": ["a", "b", "c", "d"]}
    turned = ask("return of.ascending(a)", line)
    assert turned == {"x": [1, 2, 2, 3], "y": [8, 7, 6, 5], "notes": ["d", "c", "b", "a"]}
    assert ask("return of.ascending(a)", turned) == turned
