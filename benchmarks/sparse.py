"""A propagation without the zeros of its model against the dense one, as C and compiled by numba.

15 states, the error state of an inertial unit with the biases of its sensors; form `short`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from benchmarks.timing import REPETITIONS, Result, repeated, seconds
from filters.backends.in_c import in_c
from filters.covariance_forms import covariance_form
from filters.records import new_workspace
from filters.systems.example import example_system
from studies.measurement.published_jobs import ERROR_STATE

ROUNDS = 61


def results() -> Iterator[Result]:
    n = len(ERROR_STATE.F)
    random = np.random.default_rng(0)
    Phi, Q = (
        np.array([[random.normal() if entry == "*" else float(entry) for entry in row] for row in pattern])
        for pattern in (ERROR_STATE.F, ERROR_STATE.Q)
    )
    root = random.normal(size=(n, n))
    arguments = Phi, root @ root.T, Q, np.zeros((n, n)), new_workspace(example_system(n, 0, 1))
    kernels = [covariance_form("short", structure).propagation for structure in (ERROR_STATE, None)]
    in_c_times = [partial(in_c(kernel).loop(*arguments), REPETITIONS) for kernel in kernels]
    numbas = [repeated(kernel, *arguments) for kernel in kernels]
    for name, (sparse, dense) in (("C", in_c_times), ("numba", numbas)):
        least = {run: min(seconds(run, 1) for _ in range(ROUNDS)) for run in (sparse, dense)}
        yield Result(
            f"15 states without zeros: time beside dense, {name}", least[sparse] / least[dense], 0.25, higher=False
        )
