"""What a link to a scenario's page says."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.errors import InputError
from studies.explorer.scenario_asked import AS_IT_IS, MOST_SPAN, ScenarioAsked, asked_of, query_of_asked

ASKED = st.builds(
    ScenarioAsked,
    seed=st.none() | st.integers(0, 2**63),
    steps=st.none() | st.integers(1, 1_000_000),
    times_slower=st.fractions(Fraction(1, 100), 100, max_denominator=1000),
    exact=st.booleans(),
    accuracy=st.booleans(),
    shown=st.none() | st.text(st.characters(codec="utf-8"), min_size=1, max_size=20),
    at=st.none() | st.integers(0, 1_000_000),
    span=st.none() | st.integers(1, MOST_SPAN),
)


@given(ASKED)
def test_its_query_is_read_back(asked: ScenarioAsked) -> None:
    assert asked_of(query_of_asked(asked)) == (asked, {})


def test_no_query_is_the_scenario_as_it_is() -> None:
    assert asked_of("") == (AS_IT_IS, {})
    assert query_of_asked(AS_IT_IS) == ""


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("file=/etc/passwd", "the query's key 'file' is unknown"),
        ("seed=1&seed=2", "seed twice"),
        ("seed=-1", "seed is -1: give at least 0"),
        ("seed=a", "seed is 'a': give a whole number"),
        ("steps=0", "steps is 0: give at least 1"),
        ("steps=99999999", "steps is 99999999: give at most 1,000,000"),
        ("span=0", "span is 0: give at least 1"),
        ("times_slower=0", "times_slower"),
        ("times_slower=1e6", "give a number from 0.001 to 1000"),
        ("exact=1", "exact is '1': choose from yes, no"),
        ("first=3", "the query's key 'first' is unknown"),
    ],
)
def test_what_cannot_be_is_refused(query: str, said: str) -> None:
    with pytest.raises(InputError) as refused:
        asked_of(query)
    assert said in str(refused.value)
