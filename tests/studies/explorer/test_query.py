"""A link says a design: exactly, in one way alone, and nothing that was not meant."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given as drawn
from hypothesis import strategies as st

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.design.options import Options, choices
from sched_sim.errors import InputError
from studies.explorer.design import Design
from studies.explorer.given import START, Given
from studies.explorer.query import KEYS, design_of, number_text, query_of

numbers = st.fractions(Fraction(1, 10**6), 10**6, max_denominator=10**6) | st.decimals("0.001", "1000", places=3)
options = st.builds(
    Options,
    **{name: st.sampled_from(known) for name, known in choices().items() if known},
    context_switch=st.just(Fraction(0)) | st.fractions(0, 10, max_denominator=1000),
)
designs = st.builds(
    Design,
    **{name: st.none() | st.integers(-5, 1000) for name in "NML"},
    **{name: st.none() | numbers for name in ("hr_hz", "measurement_hz", "delay_ms", "land_within_ms")},
    method=st.sampled_from(DELAYED_METHODS),
    statistic=st.sampled_from(["minimum", "median", "p95"]),
    **{name: st.none() | st.text(min_size=1, max_size=8) for name in ("costs", "processor", "model", "output")},
    speed=st.none() | numbers,
    options=options,
    within=st.none() | numbers,
    metric=st.sampled_from(["worst", "rms"]),
    cycles=st.integers(1, 9),
)


@drawn(designs)
def test_a_query_is_read_back_as_the_very_same_design(design: Design) -> None:
    query = query_of(design)
    assert query.isascii()
    assert design_of(query) == (START if query == "" else design)
    assert query_of(design_of(query)) in (query, query_of(START))


@drawn(st.fractions(-(10**9), 10**9, max_denominator=10**9) | st.decimals(-1000, 1000, places=6).map(Fraction))
def test_a_number_is_written_exactly_as_a_decimal_where_it_is_one(number: Fraction) -> None:
    text = number_text(number)
    assert Fraction(text) == number
    assert ("/" in text) == ((10**40 * number).denominator > 1)


def test_no_query_at_all_is_what_the_explorer_starts_with() -> None:
    assert design_of("") == design_of("?") == Given().start == START
    assert design_of("", Given(start=Design(N=10, M=4))) == Design(N=10, M=4)


def test_what_is_as_by_default_is_left_out() -> None:
    assert query_of(Design(N=10, M=4, L=8)) == "N=10&M=4&L=8"
    assert query_of(Design(hr_hz="400.0", within=0.40, options=Options(cpus=2))) == "hr_hz=400&within=0.4&cpus=2"
    assert design_of("N=10&M=4&cycles=1&method=dual-rate&cpus=1") == Design(N=10, M=4)
    assert query_of(START) == "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps"


def test_a_query_names_each_choice_of_a_design_once() -> None:
    assert len(set(KEYS)) == len(KEYS)
    assert {"N", "hr_hz", "method", "within", "cycles", "cpus", "feedback", "policy"} <= set(KEYS)
    assert "options" not in KEYS


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("N=10&Q=4", "the query's key 'Q' is unknown: choose from N, M, L,"),
        ("N=10&mesurement_hz=4", "did you mean measurement_hz?"),
        ("N=10&N=11", "the query has N twice, '10' and '11': leave one out"),
        ("N=10&M", "the query is 'N=10&M': give key=value pairs"),
        ("N=ten", "N is 'ten': give a whole number"),
        ("N=1.5", "N is '1.5': give a whole number"),
        ("N=", "N is '': give a whole number"),
        ("N=%FF", "give key=value pairs"),
        ("hr_hz=fast", "hr_hz is 'fast': give a finite number"),
        ("hr_hz=400Hz", "give it in Hz, without the unit: 400"),
        ("hr_hz=0", "hr_hz is 0: it must be greater than 0"),
        ("within=-1", "within is -1: it must be greater than 0"),
        ("hr_hz=nan", "hr_hz is "),
        ("hr_hz=1e999999999", "hr_hz is 1e999999999: give a number between"),
        ("feedback=later", "feedback is 'later': choose from next-step, same-step"),
        ("cpus=3", "cpus is 3: choose from 1, 2"),
        ("method=exact", "method 'exact' is unknown: choose from standard,"),
        ("method=dualrate", "did you mean dual-rate?"),
        ("method=multirate", "choose from standard, recalculate, .* what it needs is said by `sched-sim minimum"),
        ("metric=best", "metric 'best' is unknown: give worst or rms"),
        ("statistic=mean", "statistic is 'mean': choose from minimum, median, p95"),
        ("cycles=0", "cycles is 0: give at least 1"),
        ("context_switch=-1", "context_switch is -1: it must be 0 or more"),
        ("N=1&" + "x" * 5000, "the query has 5,004 letters: at most 4,000 are read"),
    ],
)
def test_what_cannot_be_read_is_refused_by_its_name_and_with_a_remedy(query: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        design_of(query)
