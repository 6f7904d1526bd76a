"""The ways to fuse a delayed measurement that obey the same laws."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.factored.workspace import FactoredWorkspace
from filters.history import History
from filters.records import Workspace
from filters.registry import DELAYED_METHODS
from tests.strategies import Landing, Problem, problems


class Case(NamedTuple):
    """A method with options, and when its corrections land."""

    method: str
    options: dict[str, str]
    landing: Landing

    def run(self, problem: Problem, **options: Any) -> History:
        """With the numpy backend unless another is given."""
        return DELAYED_METHODS[self.method].run(*problem, **{"backend": "numpy", **self.options, **options})

    def problems(self) -> st.SearchStrategy[Problem]:
        return problems(self.landing)


CASES = [
    Case("recalculate", {}, "at-arrival"),
    Case("larsen", {}, "at-arrival"),
    Case("clone", {}, "at-arrival"),
    Case("clone-split", {}, "at-arrival"),
    Case("carried-gain", {}, "at-arrival"),
    Case("dual-rate", {}, "next-step"),
    Case("dual-rate", {"gain": "precomputed"}, "next-step"),
    Case("dual-rate", {"feedback": "same-step"}, "same-step"),
    Case("dual-rate", {"feedback": "same-step", "gain": "precomputed"}, "same-step"),
    Case("delayed-horizon", {}, "next-step"),
    Case("augmentation", {}, "at-arrival"),
]

each_case = pytest.mark.parametrize("case", CASES, ids=lambda case: "-".join([case.method, *case.options.values()]))


def standard_run(problem: Problem, measurements: int | None = None, **options: Any) -> History:
    """The standard filter, given only so many measurements (all if None)."""
    given = problem._replace(measurements=problem.measurements[:measurements])
    return DELAYED_METHODS["standard"].run(*given, **{"backend": "numpy", **options})


def relative_difference(found: FloatArray, expected: FloatArray) -> float:
    """The largest difference, in units of the largest expected number."""
    return float(np.max(np.abs(found - expected), initial=0.0) / np.max(np.abs(expected), initial=1e-300))


def arrays_in(value: Any) -> list[FloatArray]:
    """All arrays in a tuple, however deep, without scratch memory."""
    if isinstance(value, np.ndarray):
        return [value]
    if isinstance(value, tuple) and not isinstance(value, Workspace | FactoredWorkspace):
        return [array for item in value for array in arrays_in(item)]
    return []
