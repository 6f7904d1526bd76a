"""Jobs whose inputs can be given other values while they stay where they are, as those of a filter in use do."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.bind import like
from filters.backends.timed import Varied
from filters.jobs import Job
from filters.kernels.place import IntArray
from studies.measurement.job_times import ARGUMENT_SETS

LONGEST_PAUSE = 32
"""In turns of a loop, of 1 to 2 ns each: longer than the steps of most clocks."""


class Inputs(NamedTuple):
    """arguments: of each job, with its inputs in `memory`; the rest as in `Varied`."""

    arguments: list[tuple[Any, ...]]
    memory: FloatArray
    bounds: IntArray
    values: FloatArray

    def varied(self, executions: int, random: np.random.Generator) -> Varied:
        """With a set and a pause drawn for each of so many executions."""
        which, pauses = (
            random.integers(len(self.values), size=executions),
            random.integers(LONGEST_PAUSE, size=executions),
        )
        return Varied(self.memory, self.bounds, self.values, which, pauses, np.zeros(1))


def inputs_of(jobs: Sequence[Job]) -> Inputs:
    """Inputs are the arrays of floating-point numbers that differ from one set of arguments to another."""
    arguments, values, bounds = [], [np.empty((ARGUMENT_SETS, 0))], [0]
    found = []
    for job in jobs:
        sets = [job.arguments(index) for index in range(ARGUMENT_SETS)]
        alike = list(zip(*map(_arrays, sets), strict=True))
        differing = [arrays for arrays in alike if _differ(arrays) and not _overlaps(arrays[0], alike)]
        found.append((sets[0], [arrays[0] for arrays in differing]))
        values += [np.array([array.ravel() for array in arrays]) for arrays in differing]
        bounds.append(bounds[-1] + sum(arrays[0].size for arrays in differing))
    memory = np.empty(bounds[-1])
    for (first, arrays), start in zip(found, bounds, strict=False):
        moved = {}
        for array in arrays:
            there = memory[start : start + array.size].reshape(array.shape)
            there[...] = array
            moved[id(array)] = there
            start += array.size
        arguments.append(_with(first, moved))
    return Inputs(arguments, memory, np.array(bounds), np.concatenate(values, axis=1))


def _arrays(value: Any) -> Iterator[Any]:
    if isinstance(value, tuple):
        for item in value:
            yield from _arrays(item)
    elif isinstance(value, np.ndarray):
        yield value


def _differ(arrays: Sequence[Any]) -> bool:
    first = arrays[0]
    plain = first.dtype == np.float64 and first.flags.c_contiguous and first.flags.writeable and first.ndim > 0
    return plain and any(not np.array_equal(first, other, equal_nan=True) for other in arrays[1:])


def _overlaps(array: Any, alike: Sequence[Sequence[Any]]) -> bool:
    return sum(np.may_share_memory(array, others[0]) for others in alike) > 1


def _with(value: Any, moved: dict[int, Any]) -> Any:
    if isinstance(value, tuple):
        return like(value, [_with(item, moved) for item in value])
    return moved.get(id(value), value)
