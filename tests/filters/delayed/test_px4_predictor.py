"""PX4's output predictor: the filter behind it is exact, the outputs follow it, and their errors are those of the
linear system that they are."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.covariance_forms import COVARIANCE_FORMS
from filters.delayed import px4_predictor, standard
from filters.delayed.px4_predictor import pull_gains
from filters.history import History
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from tests.filters.cases import relative_difference, standard_run
from tests.strategies import Problem, problem, problems

PHI = np.array([[1.0, 1.0], [0.0, 1.0]])
Q = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
H, R = np.array([[1.0, 0.0]]), np.eye(1)
CONSTANT_VELOCITY = linear_system(PHI, np.zeros((2, 0)), H, Q, R)


@settings(max_examples=25)
@given(problems("at-arrival"), st.sampled_from([*COVARIANCE_FORMS]))
def test_the_filter_at_the_horizon_is_the_standard_one(whole: Problem, form: str) -> None:
    found, expected = px4_predictor.run(*whole, update=form, backend="numpy"), standard_run(whole)
    assert relative_difference(found.P_reference, expected.P_reference) <= 1e-10
    used = len(found.innovations)
    last = len(whole.inputs) - whole.M
    assert used == (min(len(whole.measurements), last // whole.N + 1) if last >= 0 else 0)
    assert relative_difference(found.gains, expected.gains[:used]) <= 1e-10
    scale = 1 + np.abs(expected.x).max()
    assert np.abs(found.innovations - expected.innovations[:used]).max(initial=0.0) <= 1e-9 * scale


@pytest.mark.parametrize("M", [1, 4, 10])
def test_where_nothing_more_is_learnt_the_outputs_come_to_the_filter_carried_forward(M: int) -> None:
    """A body at rest, or at constant speed, that is measured once."""
    steps = 900
    start = CONSTANT_VELOCITY, 10, M, M, np.zeros(2), np.eye(2), np.empty((steps, 0)), [[5.0]]
    found, expected = px4_predictor.run(*start, tau_s=0.05, backend="numpy"), standard.run(*start, backend="numpy")
    assert np.abs(found.x[M] - expected.x[M]).max() > 0.1
    np.testing.assert_allclose(found.x[-20:], expected.x[-20:], rtol=1e-6)


def run(system: System, N: int, M: int, measurements: FloatArray, steps: int, x0: FloatArray) -> History:
    start = x0, np.eye(2), np.empty((steps, 0))
    return px4_predictor.run(system, N, M, M, *start, measurements, tau_s=0.1, step_s=0.02, backend="numpy")


@pytest.mark.parametrize(("N", "M"), [(5, 3), (4, 4), (3, 0)])
def test_the_errors_are_those_of_its_linear_system(N: int, M: int) -> None:
    """The real filter is linear in x_0, w and nu: a run for each tells how far each reaches, and so the covariance of
    the output's error, exactly. The other way: the blocks of filter, buffer, sum and noises under way as one system."""
    steps, rng = 23, range(23)
    cycles = steps // N + 1
    reaches, of_noise = [], []
    for i in range(2):  # x_0 - x0
        truth = np.array([np.linalg.matrix_power(PHI, j)[:, i] for j in range(steps + 1)])
        reaches.append(run(CONSTANT_VELOCITY, N, M, truth[::N, :1], steps, np.zeros(2)).x - truth)
    roots = np.linalg.cholesky(Q)
    for at in rng:
        for i in range(2):
            truth = np.zeros((steps + 1, 2))
            for j in range(at + 1, steps + 1):
                truth[j] = np.linalg.matrix_power(PHI, j - at - 1) @ roots[:, i]
            reaches.append(run(CONSTANT_VELOCITY, N, M, truth[::N, :1], steps, np.zeros(2)).x - truth)
    for cycle in range(cycles):
        of_noise = np.eye(cycles)[:, cycle : cycle + 1]
        reaches.append(run(CONSTANT_VELOCITY, N, M, of_noise, steps, np.zeros(2)).x)
    found = np.einsum("rji,rjk->jik", np.array(reaches), np.array(reaches))
    np.testing.assert_allclose(found, stacked_covariances(N, M, steps), rtol=1e-9, atol=1e-12)


def stacked_covariances(N: int, M: int, steps: int) -> FloatArray:
    """Covariance of o_j - x_j in every step.

    Stacked: the filter's error at j - M, the errors of the outputs of j, j - 1, ... j - M, the sum, and the noises
    w_{j-1}, ... w_{j-M}, which the filter meets later. No error is defined before step 0, and none is used.
    """
    gains = pull_gains(0.1, 0.02)
    size = 2 * (1 + (M + 1) + 1 + M)
    filter_, outputs, total = (
        slice(0, 2),
        [slice(2 + 2 * i, 4 + 2 * i) for i in range(M + 1)],
        slice(4 + 2 * M, 6 + 2 * M),
    )
    noises = [slice(6 + 2 * M + 2 * i, 8 + 2 * M + 2 * i) for i in range(M)]
    X = np.zeros((size, size))
    for block in (filter_, outputs[0]):
        for other in (filter_, outputs[0]):
            X[block, other] = np.eye(2)  # both start from x0
    P, found = np.eye(2), []
    for j in range(steps + 1):
        if j > 0:
            A, B = np.eye(size), np.zeros((size, 2))
            A[outputs[0], outputs[0]], B[outputs[0]] = PHI, -np.eye(2)
            for i in range(1, M + 1):
                A[outputs[i]] = 0.0
                A[outputs[i], outputs[i - 1]] = np.eye(2)
            for i in range(M):
                A[noises[i]] = 0.0
                if i > 0:
                    A[noises[i], noises[i - 1]] = np.eye(2)
                else:
                    B[noises[0]] = np.eye(2)
            if j > M:
                A[filter_, filter_] = PHI
                if M:
                    A[filter_, noises[-1]] = -np.eye(2)
                else:
                    B[filter_] = -np.eye(2)
                P = PHI @ P @ PHI.T + Q
            X = A @ X @ A.T + B @ Q @ B.T
        if j >= M and (j - M) % N == 0:
            K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
            A = np.eye(size)
            A[filter_, filter_] -= K @ H
            X = A @ X @ A.T
            X[filter_, filter_] += K @ R @ K.T
            P = P - K @ H @ P
        if j >= M:
            A = np.eye(size)
            A[total, filter_], A[total, outputs[M]] = np.eye(2), -np.eye(2)
            X = A @ X @ A.T
            A = np.eye(size)
            error, summed = gains.error * np.eye(2), gains.total * np.eye(2)
            for output in outputs:
                A[output, filter_] += error
                A[output, outputs[M]] -= error
                A[output, total] += summed
            X = A @ X @ A.T
        found.append(X[outputs[0], outputs[0]])
    return np.array(found)


@pytest.mark.parametrize(
    ("given_times", "said"), [({"tau_s": 0.0}, "tau_s=0.0 must be"), ({"step_s": float("nan")}, "step_s=nan must be")]
)
def test_times_that_cannot_be(given_times: dict[str, float], said: str) -> None:
    data = problem(example_system(2, 1, 1), 5, 2, 2, 7, seed=0)
    with pytest.raises(ValueError, match=said):
        px4_predictor.run(*data, **given_times)
