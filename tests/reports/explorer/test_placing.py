"""Labels beside one another in the browser, where the printed figures have them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from reports.drawing.placing import spread, worst_shift
from tests.reports.explorer.scripts import Ask, asking


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "placing") as ask:
        yield ask


labels = st.lists(st.tuples(st.floats(0, 1000), st.floats(1, 60)), max_size=12).map(sorted)


@settings(deadline=None, max_examples=60)
@given(labels, st.floats(0, 20))
def test_they_stand_where_the_printed_ones_do(ask: Ask, given: list[tuple[float, float]], gap: float) -> None:
    centres, widths = [centre for centre, _ in given], [width for _, width in given]
    placed = ask("return of.spread(a[0], a[1], 0, 1000, b);", [centres, widths], gap)
    assert placed == pytest.approx(spread(centres, widths, 0, 1000, gap))
    assert ask("return of.worstShift(a, b);", centres, placed) == pytest.approx(worst_shift(centres, placed))
