"""The spread of 4,000 runs of the project's own filters is what the closed form says, in every step."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.accuracy.gains import halved_noise, summed_noise, with_assumed
from filters.arrays import FloatArray
from filters.delayed import dual_rate, larsen, recalculate, standard
from filters.systems.linear import linear_system
from tests.filters.accuracy.cases import CV
from tests.filters.accuracy.chi_square import assert_spread

N, CYCLES = 10, 3
SIDE_BY_SIDE, RECORDS = 50, 80  # 4,000 vehicles, 50 of them in the state of one filter, for speed


def every(matrix: FloatArray) -> FloatArray:
    return np.kron(np.eye(SIDE_BY_SIDE), matrix)


def errors(run: Any, L: int, believed: FloatArray, true: FloatArray, **options: Any) -> FloatArray:
    """Of the position in each step (steps + 1, runs). The filter starts in the periodic regime, just before a
    measurement: its P is the one that it believes, its error has the true covariance."""
    random = np.random.default_rng(0)
    system = linear_system(every(CV.Phi), np.zeros((2 * SIDE_BY_SIDE, 1)), every(CV.H), every(CV.Q), every(CV.R))
    steps = CYCLES * N + N - 1
    inputs, found = np.zeros((steps, 1)), []
    for _ in range(RECORDS):
        x = np.empty((steps + 1, SIDE_BY_SIDE, 2))
        x[0] = random.multivariate_normal(np.zeros(2), true, SIDE_BY_SIDE)
        for j in range(steps):
            x[j + 1] = x[j] @ CV.Phi.T + random.multivariate_normal(np.zeros(2), CV.Q, SIDE_BY_SIDE)
        y = x[::N, :, 0] + random.normal(size=(CYCLES + 1, SIDE_BY_SIDE))
        start = np.zeros(2 * SIDE_BY_SIDE), every(believed)
        history = run(system, N, min(4, L), L, *start, inputs, y, backend="numpy", **options)
        found.append(history.x[:, ::2] - x[:, :, 0])
    return np.concatenate(found, axis=1)


@pytest.mark.exhaust
@pytest.mark.slow
@pytest.mark.parametrize(
    ("run", "L", "options"),
    [
        (dual_rate.run, 10, {"low_rate_noise": "euler"}),
        *(
            pytest.param(*case, marks=pytest.mark.exhaust)
            for case in (
                (standard.run, 0, {}),
                (recalculate.run, 4, {}),
                (larsen.run, 4, {}),
                (dual_rate.run, 8, {}),
                (dual_rate.run, 10, {}),
                (dual_rate.run, 8, {"low_rate_noise": "sum"}),
            )
        ),
    ],
)
def test_the_spread_of_runs_is_what_the_age_says(run: Any, L: int, options: dict[str, str]) -> None:
    noise = {"sum": summed_noise, "euler": halved_noise}.get(options.get("low_rate_noise", ""))
    start = with_assumed(CV, np.eye(2), N, 0, noise)
    variances = with_assumed(CV, np.eye(2)[:1], N, N + L, noise).variances
    seen = errors(run, L, start.believed_before, start.before, **options)
    ages = L + (np.arange(len(seen)) - L) % N
    assert seen.shape[1] == 4000
    assert_spread(seen, variances[ages])
