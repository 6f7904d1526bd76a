"""Where a slider stops: within its limits, in order, at values that people write."""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal
from itertools import pairwise

import pytest
from playwright.sync_api import Browser

from tests.reports.explorer.scripts import Ask, asking

WHOLE = [(1, 1), (45, 80), (1, 100_000)]
BROKEN = [(44.1, 44.7), (0.2, 8.88), (1, 0.5)]
KINDS = [("wholeStops", WHOLE), ("roundStops", WHOLE + BROKEN), ("evenStops", WHOLE + BROKEN)]


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "stops") as ask:
        yield ask


@pytest.mark.parametrize(("kind", "limits"), [(kind, limits) for kind, all_of_it in KINDS for limits in all_of_it])
def test_stops_are_within_the_limits_and_ascend(ask: Ask, kind: str, limits: tuple[float, float]) -> None:
    first, last = limits
    stops = ask(f"return of.{kind}(a, b);", first, last)
    assert stops[0] == first
    assert stops[-1] == max(first, last)
    assert all(one < other for one, other in pairwise(stops))
    assert len(stops) < 1000
    inner = stops[1:-1]
    assert all(len(Decimal(str(stop)).normalize().as_tuple().digits) <= 5 for stop in inner)


def test_a_stop_is_nearest(ask: Ask) -> None:
    assert [ask("return of.stopNear([1, 2, 4, 8], a);", value) for value in (-3, 2.9, 3.1, 100)] == [0, 1, 2, 3]


def test_a_limit_is_rounded_to_its_own_side(ask: Ask) -> None:
    assert ask("return [of.roundedTo(a, 2, Math.floor), of.roundedTo(a, 2, Math.ceil)];", 400 / 45) == [8.88, 8.89]
    assert ask("return [of.roundedTo(a, 2, Math.floor), of.roundedTo(a, 2, Math.ceil)];", 0.29) == [0.29, 0.29]
