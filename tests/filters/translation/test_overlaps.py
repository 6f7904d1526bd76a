"""`restrict` stands where arrays never overlap, and only there."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from types import CodeType, FrameType
from typing import Any

import numpy as np
import pytest

from filters.backends.c_arguments import overlapping
from filters.backends.in_c import in_c
from filters.jobs import Job
from filters.translation.kinds import Array, Kind, kind_of
from filters.translation.source import source_of
from filters.translation.translated import Translated
from filters.translation.unit import Unit
from tests.filters.translation.cases import needs_compiler, numbers
from tests.filters.translation.overlapping import (
    OVERLAPPING,
    Pair,
    field_and_record,
    parameter_that_changes,
    spread,
    spread_on,
    table_written,
    vectors,
)
from tests.filters.translation.test_jobs import jobs_of_methods, jobs_of_robust_filters

Make = Callable[[], tuple[Any, ...]]


def unit_of(function: Any, arguments: tuple[Any, ...]) -> Unit:
    unit = Unit(public=frozenset({function}), overlapping=overlapping(source_of(function).parameters, arguments))
    unit.function(function, tuple(map(kind_of, arguments)))
    return unit


def restricted(source: str, name: str) -> set[str]:
    """The parameters of a function that are declared so."""
    (parameters,) = re.findall(rf"\b{name}(?:_\d+)*\(([^()]*)\)\n{{", source)
    return set(re.findall(r"(\w+)\[restrict", parameters))


@pytest.mark.parametrize(("function", "make"), OVERLAPPING, ids=lambda value: value.__name__)
def test_what_overlaps_is_not_said_to_be_apart(function: Any, make: Make) -> None:
    assert restricted(unit_of(function, make()).source(""), "spread") == set()


@needs_compiler
@pytest.mark.parametrize(
    ("function", "make"), [*OVERLAPPING, (parameter_that_changes, vectors), (table_written, lambda: vectors()[:1])]
)
def test_what_overlaps_gives_the_numbers_of_python(function: Any, make: Make) -> None:
    ours, theirs = make(), make()
    in_c(function)(*theirs)
    function(*ours)
    for one, other in zip(numbers(theirs), numbers(ours), strict=True):
        np.testing.assert_array_equal(one, other)


def test_what_is_apart_is_said_to_be_so() -> None:
    assert restricted(unit_of(spread_on, vectors()).source(""), "spread") == {"a", "out"}
    apart = Pair(*vectors()), vectors()[0]
    assert restricted(unit_of(field_and_record, apart).source(""), "spread") == {"a", "out"}


def test_a_parameter_that_gets_another_array_is_not_said_to_be_apart() -> None:
    source = unit_of(parameter_that_changes, vectors()).source("")
    assert restricted(source, "parameter_that_changes") == {"b"}


def test_arguments_that_others_give_may_overlap() -> None:
    unit = Unit(public=frozenset({spread_on}))
    unit.function(spread_on, tuple(map(kind_of, vectors())))
    assert "restrict" not in unit.header("H") + unit.source("")


def test_one_call_that_overlaps_is_enough() -> None:
    unit = Unit(public=frozenset({spread_on, OVERLAPPING[0][0]}), overlapping=frozenset())
    for function in unit.public:
        unit.function(function, tuple(map(kind_of, vectors())))
    assert restricted(unit.source(""), "spread") == set()


@needs_compiler
def test_the_same_function_is_called_with_arrays_apart_and_not() -> None:
    """What was compiled for the ones is not used for the others."""
    for arrays in (vectors(), (each := vectors()[0], each), vectors()):
        expected = [array.copy() for array in arrays] if arrays[0] is not arrays[1] else [arrays[0].copy()] * 2
        spread(*expected)
        in_c(spread)(*arrays)
        np.testing.assert_array_equal(arrays[1], expected[1])


@pytest.mark.parametrize("job", [*jobs_of_methods(), *jobs_of_robust_filters()])
def test_arrays_of_jobs_are_apart_where_it_is_said(job: Job) -> None:
    """At each call while a job runs in Python, what is written shares no memory with what is said to be apart."""
    arguments = job.arguments(1)
    unit = unit_of(job.function, arguments)
    versions: dict[CodeType, list[Translated]] = {}
    for each in unit.functions().values():
        versions.setdefault(each.function.__code__, []).append(each)
    apart, checked = unit.apart(), set()

    def watch(frame: FrameType, event: str, _: Any) -> None:
        if event == "call":
            for each in versions.get(frame.f_code, ()):
                values = tuple(frame.f_locals[name] for name in each.parameters)
                if all(map(has_shape, values, each.kinds)):
                    for pair in overlapping(each.parameters, values):
                        assert not (pair & each.effects.writes and {path[0] for path in pair} & apart[each.name]), each
                    checked.add(each.name)

    sys.setprofile(watch)
    try:
        job.function(*arguments)
    finally:
        sys.setprofile(None)
    assert checked


def has_shape(value: Any, kind: Kind) -> bool:
    return not isinstance(kind, Array) or value.shape == tuple(
        known or length for known, length in zip(kind.shape, value.shape, strict=True)
    )
