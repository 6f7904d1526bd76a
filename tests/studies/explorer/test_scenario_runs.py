"""The answers of a scenario's page."""

from __future__ import annotations

import json
from urllib.parse import urlencode

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.errors import InputError
from studies.explorer.scenario import explore_scenario
from studies.explorer.scenario_asked import ScenarioAsked
from studies.explorer.scenario_runs import Runs
from studies.explorer.scenario_trace import Trace
from studies.explorer.scenario_window import window
from tests.random_scenarios import random_scenario
from tests.scenarios import BY_HAND, scenario, sensor

LATE = scenario(10, BY_HAND | {"correct.gps": [2] * 9 + [60]}, sensor("gps", 20, 8, land_by=10), steps=2_000)


def test_a_view_is_that_of_the_scenario() -> None:
    assert Runs(LATE).view("?seed=3") == explore_scenario(LATE, ScenarioAsked(seed=3)).document()


def test_a_window_is_that_of_the_trace() -> None:
    trace = Trace(LATE)
    trace.learn(40, LATE.steps)
    assert Runs(LATE).schedule("first=20&until=40")["schedule"] == window(trace, 20, 40)


def test_a_late_window_is_asked_for_until_it_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.explorer.scenario_runs.AT_ONCE", 1_000)
    runs = Runs(LATE)
    first = runs.schedule("first=1900&until=1920")
    assert (first["schedule"], first["simulated"], first["steps"]) == (None, 1_000, 2_000)
    assert runs.schedule("first=1900&until=1920")["schedule"]["origin"] == 1900


@pytest.mark.parametrize(("of", "kinds"), [("miss", {"predict", "correct gps"}), ("landing", {"correct gps"})])
def test_going_from_miss_to_miss_finds_all(of: str, kinds: set[str]) -> None:
    runs, found, after = Runs(LATE), [], 0.0
    while (miss := runs.next(f"after={after}&of={of}")["found"]) is not None:
        found.append(miss["deadline"])
        after = miss["deadline"]
    trace = Trace(LATE)
    trace.learn(LATE.steps, LATE.steps)
    names = list(trace.kinds)
    missed = zip(trace.misses.deadline, trace.misses.job, strict=True)
    wanted = sorted({due for due, job in missed if names[trace.jobs.kind[job]] in kinds})
    assert found == wanted
    assert found


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("", "first is missing"),
        ("first=3&until=3", "give 0 <= first < until <= 2000"),
        ("first=0&until=2001", "give 0 <= first < until <= 2000"),
        ("first=0&until=2001&steps=9000", "until is 2,001 steps after first: give at most 2,000"),
        ("first=0&until=5&shown=x", "shown is 'x': choose from predict, correct gps"),
    ],
)
def test_what_cannot_be_shown_is_refused(query: str, said: str) -> None:
    with pytest.raises(InputError) as refused:
        Runs(LATE).schedule(query)
    assert said in str(refused.value)


def test_there_are_misses_and_late_landings_only() -> None:
    with pytest.raises(InputError, match="of is 'x': choose from miss, landing"):
        Runs(LATE).next("of=x")


@given(
    st.integers(0, 10**6),
    st.fixed_dictionaries(
        {},
        optional={
            "seed": st.integers(0, 9).map(str),
            "steps": st.integers(1, 90).map(str),
            "times_slower": st.sampled_from(["0.01", "1/3", "2.5", "40"]),
            "exact": st.sampled_from(["yes", "no"]),
            "shown": st.sampled_from(["predict", "correct s0", "nothing"]),
            "at": st.integers(0, 99).map(str),
            "span": st.integers(1, 99).map(str),
        },
    ),
)
def test_any_query_is_answered_or_refused(seed: int, keys: dict[str, str]) -> None:
    runs, query = Runs(random_scenario(seed)), urlencode(keys)
    try:
        view = runs.view(query)
    except InputError:
        return
    at, until = view["trace"]["at"], view["trace"]["at"] + view["trace"]["span"]
    shown = runs.schedule(f"{query}{query and '&'}first={at}&until={until}")["schedule"]
    assert json.loads(json.dumps(shown, allow_nan=False)) == shown
    assert (shown["origin"], shown["steps"]) == (at, until)
    assert json.dumps(view, allow_nan=False)
