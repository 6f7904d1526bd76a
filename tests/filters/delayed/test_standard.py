"""The standard filter against oracles of other kinds: textbook NumPy, conditioning of a joint Gaussian, FilterPy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.covariance_forms import COVARIANCE_FORMS
from filters.delayed import standard
from filters.systems.example import example_system
from tests.filters.oracle import textbook_kalman_filter
from tests.strategies import Problem, problem, systems

each_form = pytest.mark.parametrize("form", COVARIANCE_FORMS)
problems = st.builds(
    problem, systems(), st.integers(1, 5), st.just(0), st.just(0), st.integers(0, 12), st.integers(0, 99)
)


@each_form
@given(given_problem=problems)
def test_equals_the_textbook(form: str, given_problem: Problem) -> None:
    found = standard.run(*given_problem, update=form)
    states, references = textbook_kalman_filter(given_problem)
    np.testing.assert_allclose(found.x, states, rtol=1e-10, atol=1e-10)
    np.testing.assert_allclose(found.P_reference, references, rtol=1e-10, atol=1e-10)


@each_form
def test_equals_the_conditional_mean_of_the_joint_gaussian(form: str) -> None:
    """No recursion: x_T and all y are written as one linear map of x_0, w and nu, and x_T is conditioned on y."""
    steps, n, p = 7, 3, 2
    given_problem = problem(example_system(n, 1, p, seed=3), 2, 0, 0, steps, seed=4)
    matrices = given_problem.system.parameters
    mean = np.concatenate([given_problem.x0, np.zeros(n * steps)])  # of x_0, w_0, w_1, ...
    covariance = np.zeros((len(mean), len(mean)))
    covariance[:n, :n] = given_problem.P0
    x_map, x_offset = np.eye(n, len(mean)), np.zeros(n)
    rows, offsets, noises = [], [], []
    for j in range(steps + 1):
        if j % 2 == 0:
            H = matrices.H[j % len(matrices.H)]
            rows.append(H @ x_map)
            offsets.append(H @ x_offset)
            noises.append(matrices.R[j % len(matrices.R)])
        if j < steps:
            first = n * (j + 1)
            Phi = matrices.Phi[j % len(matrices.Phi)]
            x_map, x_offset = Phi @ x_map, Phi @ x_offset + matrices.B[j % len(matrices.B)] @ given_problem.inputs[j]
            x_map[:, first : first + n] += np.eye(n)
            covariance[first : first + n, first : first + n] = matrices.Q[j % len(matrices.Q)]
    y_map, y_offset = np.vstack(rows), np.concatenate(offsets)
    S = y_map @ covariance @ y_map.T
    for index, R in enumerate(noises):
        S[p * index : p * (index + 1), p * index : p * (index + 1)] += R
    residual = given_problem.measurements.ravel() - y_map @ mean - y_offset
    expected = x_map @ mean + x_offset + x_map @ covariance @ y_map.T @ np.linalg.solve(S, residual)
    found = standard.run(*given_problem, update=form)
    np.testing.assert_allclose(found.x[-1], expected, rtol=1e-10)


@pytest.mark.filterwarnings("ignore")
@each_form
def test_equals_filterpy(form: str) -> None:
    kalman = pytest.importorskip("filterpy.kalman")
    given_problem = problem(example_system(), 1, 0, 0, 30, seed=1)
    matrices = given_problem.system.parameters
    rival = kalman.KalmanFilter(9, 3, 3)
    rival.x, rival.P = given_problem.x0[:, np.newaxis], given_problem.P0
    found = standard.run(*given_problem, update=form)
    for j in range(31):
        if j > 0:
            Phi, B, Q = (matrix[(j - 1) % len(matrix)] for matrix in (matrices.Phi, matrices.B, matrices.Q))
            rival.predict(u=given_problem.inputs[j - 1][:, np.newaxis], F=Phi, B=B, Q=Q)
        np.testing.assert_allclose(found.P_reference[j], rival.P, rtol=1e-10, atol=1e-12)
        H, R = matrices.H[j % len(matrices.H)], matrices.R[j % len(matrices.R)]
        rival.update(given_problem.measurements[j][:, np.newaxis], H=H, R=R)
        np.testing.assert_allclose(found.x[j], rival.x[:, 0], rtol=1e-10, atol=1e-12)
        np.testing.assert_allclose(found.gains[j], rival.K, rtol=1e-10, atol=1e-12)
        np.testing.assert_allclose(found.innovations[j], rival.y[:, 0], rtol=1e-10, atol=1e-12)
