"""When measurements are taken and land, of a filter that may have any number of them on their way."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol, TypeVar

from filters.arrays import FloatArray
from filters.history import HistoryRecorder
from filters.problem import Problem
from filters.records import Correction, Estimate


class Filter(Protocol):
    """What it does at k and at m, and from one step to the next."""

    def propagate(self, j: int, u: FloatArray) -> None:
        """From j to j + 1."""

    def take(self, k: int) -> None:
        """A measurement is taken."""

    def land(self, y: FloatArray) -> Correction:
        """The first of those on their way arrives."""

    def reference(self) -> Estimate:
        """The estimate, and its covariance once all on its way has landed."""


F = TypeVar("F", bound=Filter)


def steps(filtered: F, problem: Problem, N: int, M: int, recorder: HistoryRecorder) -> Iterator[F]:
    """The filter at the end of every step; references and corrections are recorded.

    What arrives is used before the filter propagates from the step before; what is not late, after it was taken.
    """
    moves, y = problem.inputs, problem.measured.y
    for j in range(len(moves) + 1):
        k = j - M
        arrives = k >= 0 and k % N == 0 and k // N < len(y)
        if arrives and M > 0:
            recorder.correction(filtered.land(y[k // N]))
        if j > 0:
            filtered.propagate(j - 1, moves[j - 1])
        if j % N == 0:
            recorder.reference(*filtered.reference())
            if j // N < len(y):
                filtered.take(j)
        if arrives and M == 0:
            recorder.correction(filtered.land(y[k // N]))
        yield filtered
    recorder.keep_known(len(y))
