"""Within the limits of a view no design is refused; a step beyond what a method can have one is."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.errors import InputError
from studies.explorer.design import Design
from studies.explorer.given import Given
from studies.explorer.limits import limits
from studies.explorer.query import design_of
from studies.explorer.resolved import resolved
from studies.explorer.view import explore
from tests.studies.explorer.drawn import designs_in_steps, designs_in_time


@given(designs_in_steps(), st.sampled_from("NML"), st.floats(0, 1))
def test_each_may_be_moved_alone_from_end_to_end(design: Design, name: str, share: float) -> None:
    _check_moves(design, name, share)


@settings(max_examples=3)
@given(designs_in_time(), st.sampled_from("NML"), st.floats(0, 1))
def test_also_where_the_design_was_said_in_times(design: Design, name: str, share: float) -> None:
    _check_moves(replace(design, within=None), name, share)


@pytest.mark.exhaust
@pytest.mark.parametrize("query", ["N=5&M=12", "N=10&M=100", "N=10&M=4&L=13", "N=3&M=3", "N=4&M=3&L=30"])
@pytest.mark.parametrize("name", "NML")
def test_also_with_several_on_their_way(query: str, name: str) -> None:
    for share in (0.0, 0.5, 1.0):
        _check_moves(design_of(f"{query}&costs=counted-9-3-3"), name, share)


def _check_moves(design: Design, name: str, share: float) -> None:
    view = explore(design)
    first, last = getattr(view.limits, name)
    assert first <= view.design[name] <= last
    for value in {first, last, round(first + share * (last - first) ** share)}:
        if value <= 500:
            moved = explore(_moved(design, view.design, name, value))
            assert moved.design[name] == value
            assert moved.limits.N[0] <= moved.design["N"] <= moved.limits.N[1]


def _moved(design: Design, said: dict[str, int], name: str, value: int) -> Design:
    """In steps: L only where it was said."""
    in_steps = replace(
        design,
        N=said["N"],
        M=said["M"],
        L=said["L"] if design.L is not None or design.land_within_ms is not None else None,
        measurement_hz=None,
        delay_ms=None,
        land_within_ms=None,
    )
    return replace(in_steps, **{name: value})


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("N=10&M=4&L=8", ((8, 100), (0, 7), (5, 10))),
        ("N=10&M=4", ((5, 100), (0, 9), (5, 10))),
        ("N=10&M=4&L=8&feedback=same-step", ((9, 100), (0, 8), (4, 9))),
        ("N=10&M=4&method=larsen", ((4, 100), (0, 10), (4, 10))),
        ("N=80&M=44", ((45, 200), (0, 79), (45, 80))),
        ("N=5&M=12&costs=counted-9-3-3", ((1, 100), (0, 12), (13, 15))),
        ("N=10&M=4&L=13&costs=counted-9-3-3", ((1, 100), (0, 12), (5, 13))),
        ("N=10&M=100&costs=counted-9-3-3", ((3, 200), (0, 100), (101, 110))),
        ("N=400&M=4&policy=edf", ((5, 1000), (0, 399), (5, 400))),
    ],
)
def test_limits_are_these(query: str, expected: tuple[tuple[int, int], ...]) -> None:
    found = limits(resolved(design_of(query), Given()))
    assert expected == (found.N, found.M, found.L)


@pytest.mark.parametrize(
    "name", ["N=7&M=4&L=8&method=delayed-horizon&costs=counted-9-3-3", "N=10&M=8&L=8", "N=10&M=4&L=4"]
)
def test_a_step_beyond_them_is_refused(name: str) -> None:
    with pytest.raises(InputError):
        explore(design_of(name))
