"""Inputs that differ from set to set are moved into one memory, and nothing else of the arguments is."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.jobs import Job
from filters.modular import ModularFilter, Sensor, extended_corrector, linear_corrector, linear_predictor
from filters.modular.jobs import modular_jobs
from studies.measurement.inputs import LONGEST_PAUSE, inputs_of
from studies.measurement.job_times import ARGUMENT_SETS


class State(NamedTuple):
    x: Any
    P: Any


def arguments(index: int) -> tuple[Any, ...]:
    shared = np.full(4, float(index))
    state = State(np.array([1.0, index]), index * np.ones((2, 3)))
    return state, np.array([index]), np.full(3, 7.0), index * np.ones((2, 3)).T, shared, shared[:2], "text"


def test_what_differs_is_in_one_memory_with_the_values_of_each_set() -> None:
    """Not whole numbers, what is always the same, what lies otherwise in memory, or two views of one."""
    job = Job("job", arguments, arguments)
    inputs = inputs_of([job, job])
    assert inputs.bounds.tolist() == [0, 8, 16]
    assert inputs.values.tolist() == [2 * [1.0, k, *[k] * 6] for k in range(ARGUMENT_SETS)]
    for given, start in zip(inputs.arguments, (0, 8), strict=True):
        assert isinstance(given[0], State)
        inputs.memory[start : start + 8] = range(8)
        assert given[0].x.tolist() == [0, 1]
        assert given[0].P.tolist() == [[2, 3, 4], [5, 6, 7]]
        for mine, first in zip(given[1:6], arguments(0)[1:6], strict=True):
            assert not np.may_share_memory(mine, inputs.memory)
            np.testing.assert_array_equal(mine, first)
        assert given[6] == "text"


def test_an_array_that_is_there_twice_stays() -> None:
    def twice(index: int) -> tuple[Any, ...]:
        array = np.array([float(index)])
        return array, array

    inputs = inputs_of([Job("job", twice, twice)])
    assert inputs.memory.size == 0
    assert inputs.arguments[0][0] is inputs.arguments[0][1]


def test_sets_and_pauses_are_drawn_for_each_execution() -> None:
    inputs = inputs_of([Job("job", arguments, arguments)])
    drawn = inputs.varied(10_000, np.random.default_rng(0))
    assert {*drawn.which.tolist()} == {*range(ARGUMENT_SETS)}
    assert {*drawn.pauses.tolist()} == {*range(LONGEST_PAUSE)}
    again = inputs.varied(10_000, np.random.default_rng(0))
    assert (drawn.which == again.which).all()
    assert (drawn.pauses == again.pauses).all()


def bend(x: Any, out: Any) -> None:
    out[0] = x[0] + x[1] * x[1]


def arrays_of(value: Any) -> list[Any]:
    if isinstance(value, tuple):
        return [array for item in value for array in arrays_of(item)]
    return [value] if isinstance(value, np.ndarray) else []


def test_a_job_does_on_moved_inputs_what_it_does_on_the_set() -> None:
    """So nothing that differs from set to set is left out: all parts of a filter, every array they leave."""
    sensors = [Sensor("g", linear_corrector([[1.0, 0.0]], [[1.0]])), Sensor("b", extended_corrector(bend, [[2.0]]))]
    jobs = modular_jobs(ModularFilter(linear_predictor([[1.0, 0.1], [0.0, 1.0]], np.eye(2)), sensors, 0.1))
    inputs = inputs_of([*jobs.values()])
    for number, job in enumerate(jobs.values()):
        for index in (3, 6):
            inputs.memory[:] = inputs.values[index]
            moved, own = inputs.arguments[number], job.arguments(index)
            job.function(*moved)
            job.function(*own)
            for mine, its in zip(arrays_of(moved), arrays_of(own), strict=True):
                np.testing.assert_array_equal(mine, its)
