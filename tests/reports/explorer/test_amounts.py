"""Figures of the tables, which are those of the sentence that answers: a need never looks smaller than it is."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from sched_sim.rounding import no_less, percent_up, written
from tests.reports.explorer.scripts import Ask, asking


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "amounts") as ask:
        yield ask


@settings(max_examples=10)
@given(st.lists(st.floats(1e-4, 9e6), min_size=50, max_size=50))
def test_an_accuracy_is_rounded_as_in_the_answer(ask: Ask, values: list[float]) -> None:
    texts = ask("return a.map(of.accuracyText);", values)
    assert [float(text) for text in texts] == [float(no_less(written(value), 4)) for value in values]


@pytest.mark.parametrize(
    ("speed", "short", "text"),
    [
        (4782.35, "speed", "4782.4"),
        (140152.2, "speed", "140,153"),
        (0.77, "speed", "0.77"),
        (float(Fraction(118, 150)), "speed", "0.78667"),
        (7.635, "% of cortex-m4f", "7.64"),
        (78.44, "% of rp2040", "78.5"),
        (14592.1, "% of rp2040", "14,593"),
        (1234.5, "% of rp2040", "1235"),
        (None, "speed", "–"),
    ],
)
def test_a_speed_has_the_digits_of_the_answer(speed: float | None, short: str, text: str, ask: Ask) -> None:
    assert ask("return of.powerText(a, b);", speed, {"short": short}) == text


def test_a_share_in_percent_is_rounded_as_in_the_answer(ask: Ask) -> None:
    shares = [Fraction(thousandths, 1000) for thousandths in range(1, 2000)]
    shares += [Fraction("0.0000003121"), Fraction("9.990001"), Fraction("158.6301"), Fraction("99.995")]
    texts = ask("return a.map(of.percentText);", [float(share) for share in shares])
    assert texts == [percent_up(share) for share in shares]
