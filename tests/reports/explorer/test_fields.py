"""Which control a refusal is shown at, and in which words."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from sched_sim.costs.methods import DELAYED_METHODS
from tests.reports.explorer.scripts import Ask, asking

KEYS = ["hr_hz", "delay_ms", "N", "M", "within", "model", "method", "L", "speed", "cpus"]
ABOUT = "return of.fieldRefused(a, b, c.map((key) => ({key})))?.key ?? null;"


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "fields") as ask:
        yield ask


@pytest.mark.parametrize(
    ("text", "changed", "key"),
    [
        ("the least speed takes a search by simulation over 56,160 HR periods: ask", ["delay_ms"], "delay_ms"),
        ("no model has an output of that speed: choose another", ["delay_ms"], "delay_ms"),
        ("L=8 is less than M=12: give L from 13 on", ["M"], "M"),
        ("L=8 is less than M=12: give L from 13 on", ["N"], "L"),
        ("speed is 'abc': give a finite number", ["speed"], "speed"),
        ("unknown method 'kalman': choose from larsen", [], "method"),
        ("policy edf with cpus 2 needs an offset: give one", ["delay_ms"], "cpus"),
    ],
)
def test_a_refusal_is_shown_at_the_control_that_it_is_about(
    text: str, changed: list[str], key: str | None, ask: Ask
) -> None:
    """A key that is an ordinary word, too, may stand in it without being meant."""
    assert ask(ABOUT, text, changed, KEYS) == key


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("within is '40 cm': give a number", "Needed accuracy is '40 cm': give a number"),
        ("speed is 0: it must be greater than 0", "Speed is 0: it must be greater than 0"),
        ("L is 'abc': give a whole number", "Land by is 'abc': give a whole number"),
        ("delay_ms 300: see `sched-sim minimum delay_ms`", "Delay 300: see `sched-sim minimum delay_ms`"),
        ("the least speed is 3 within the cycles", "the least speed is 3 within the cycles"),
    ],
)
def test_a_refusal_names_the_control_as_the_page_does(text: str, words: str, ask: Ask) -> None:
    assert ask("return of.inPageWords(a);", text) == words


def test_of_every_method_it_is_said_what_it_does(browser: Browser) -> None:
    with asking(browser, "methodwords") as ask:
        assert set(ask("return Object.keys(of.METHOD_WORDS);")) == set(DELAYED_METHODS)
