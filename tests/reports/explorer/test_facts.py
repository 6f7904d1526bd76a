"""What is said of jobs and schedules in words."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from tests.reports.explorer.drawn import by_hand
from tests.reports.explorer.scripts import Ask, asking

SAID = """const facts = of.jobFacts({...b, schedule: a}, 0); return facts.verdict;"""


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "facts") as ask:
        yield ask


@pytest.mark.parametrize(
    ("job", "verdict"),
    [
        ((0, 0.75, 1), "meets its deadline, 0.25 steps (0.5 ms) to spare"),
        ((0, 1, 2), "meets its deadline, 1 step (2 ms) to spare"),
        ((0, 1, 1), "meets its deadline, with nothing to spare"),
        ((0, 1.5, 1), "misses its deadline by 0.5 steps (1 ms)"),
        ((0, None, 1), "misses its deadline: it never finishes"),
        ((0, None, 5), "is not finished, and not yet due"),
    ],
)
def test_a_job_meets_its_deadline_or_misses_it(job: tuple[float, float | None, float], verdict: str, ask: Ask) -> None:
    line = {"periodMs": 2, "rows": [{"cpu": ""}], "pieces": [[0]]}
    assert ask(SAID, by_hand(3, [job]), line) == verdict


def test_a_miss_of_less_than_floats_tell_apart_is_a_miss(ask: Ask) -> None:
    schedule = by_hand(3, [(0, 1, 1)])
    schedule["jobs"]["missed"] = [True]
    line = {"periodMs": 2, "rows": [{"cpu": ""}], "pieces": [[0]]}
    assert ask(SAID, schedule, line) == "misses its deadline, by less than is shown"


def test_a_job_that_never_ran_is_said_to_have_never_got_the_processor(ask: Ask) -> None:
    schedule = by_hand(3, [(0, None, 1)])
    schedule["jobs"]["start"] = [None]
    line = {"periodMs": None, "rows": [{"cpu": ""}], "pieces": [[]]}
    assert ask(SAID, schedule, line) == "misses its deadline: it never gets the processor"
    assert ask("return of.missesSentence(a);", schedule) == "1 of 1 jobs misses its deadline, 1 never got the processor"


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("hr", "high-rate job"),
        ("lr_gain", "covariance and gain"),
        ("task:control law", "task control law"),
        ("correct gps", "correct gps"),
    ],
)
def test_kinds_of_jobs_are_said_in_words(kind: str, words: str, ask: Ask) -> None:
    assert ask("return of.kindWords(a);", kind) == words


@pytest.mark.parametrize(
    ("steps", "text"),
    [
        (0, "0"),
        (1 / 3, "0.3333"),
        (12345.678, "12,345.678"),
        (0.00012345, "1.23·10⁻⁴"),
        (-0.5, "−0.5"),
        (None, "never"),
    ],
)
def test_times_have_four_places_or_three_digits(steps: float | None, text: str, ask: Ask) -> None:
    assert ask("return of.inSteps(a);", steps) == text


@pytest.mark.parametrize(
    ("busy", "said"),
    [(0.87, "87"), (0.0996, "10"), (0.0414, "4.1"), (0.000412, "0.041"), (1e-6, "under 0.001"), (0, "0"), (1, "100")],
)
def test_a_processor_that_does_little_does_not_do_nothing(busy: float, said: str, ask: Ask) -> None:
    assert ask("return of.busyShare(a);", {"busy": busy}) == f"{said}\xa0%\xa0busy"
