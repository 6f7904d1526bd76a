"""Measurements that are taken before others have arrived, M > N, or whose correction lands after the next is taken,
L > N. The oracle is the joint distribution of all noises, conditioned on the measurements that have landed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from filters.arrays import FloatArray
from filters.covariance_forms import COVARIANCE_FORMS
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from filters.systems.navigation import simulate_drive
from tests.filters.cases import CASES, Case, relative_difference, standard_run
from tests.strategies import Problem, problem, seeds, sizes

RELATIVE = 1e-10
CAN = [case for case in CASES if case.method in ("recalculate", "larsen", "clone", "carried-gain", "dual-rate")]
each_case = pytest.mark.parametrize("case", CAN, ids=lambda case: "-".join([case.method, *case.options.values()]))


class Joint(NamedTuple):
    """Means and covariances of what is drawn, in the order x_0, w_0, w_1, ..., nu_0, nu_1, ..., and the rows that make
    of it each x_j - mean_x[j] and each y_c - mean_y[c]."""

    covariance: FloatArray
    mean_x: FloatArray
    rows_x: FloatArray
    mean_y: FloatArray
    rows_y: FloatArray


def joint(data: Problem) -> Joint:
    system, N, inputs = data.system, data.N, data.inputs
    n, p, steps, cycles = system.states, system.measurements, len(inputs), len(data.measurements)
    matrices = system.parameters

    def at(name: str, j: int) -> FloatArray:
        stack = getattr(matrices, name)
        return stack[j % len(stack)]

    size = n * (steps + 1) + p * cycles
    covariance = np.zeros((size, size))
    mean_x, rows_x = np.zeros((steps + 1, n)), np.zeros((steps + 1, n, size))
    mean_y, rows_y = np.zeros((cycles, p)), np.zeros((cycles, p, size))
    covariance[:n, :n], mean_x[0], rows_x[0, :, :n] = data.P0, data.x0, np.eye(n)
    for j in range(steps):
        w = slice(n * (j + 1), n * (j + 2))
        covariance[w, w] = at("Q", j)
        mean_x[j + 1] = at("Phi", j) @ mean_x[j] + at("B", j) @ inputs[j]
        rows_x[j + 1] = at("Phi", j) @ rows_x[j]
        rows_x[j + 1, :, w] = np.eye(n)
    for c in range(cycles):
        nu = slice(n * (steps + 1) + p * c, n * (steps + 1) + p * (c + 1))
        covariance[nu, nu], H = at("R", c * N), at("H", c * N)
        mean_y[c], rows_y[c] = H @ mean_x[c * N], H @ rows_x[c * N]
        rows_y[c, :, nu] = np.eye(p)
    return Joint(covariance, mean_x, rows_x, mean_y, rows_y)


def conditioned(data: Problem, lands: int, came: NDArray[np.bool_] | None = None) -> FloatArray:
    """E[x_j | what was taken `lands` steps ago or earlier], for each j. came (cycles, p): what was not lost."""
    covariance, mean_x, rows_x, mean_y, rows_y = joint(data)
    present = np.ones(mean_y.shape, dtype=np.bool_) if came is None else came
    found = mean_x.copy()
    for j in range(len(found)):
        known = present.copy()
        known[max((j - lands) // data.N + 1, 0) :] = False
        if known.any():
            rows = rows_y[known]
            S = rows @ covariance @ rows.T
            innovation = (data.measurements - mean_y)[known]
            found[j] += rows_x[j] @ covariance @ rows.T @ np.linalg.solve(S, innovation)
    return found


@st.composite
def several(draw: st.DrawFn, case: Case) -> Problem:
    """M or L beyond N, up to three times as much, with enough steps for some to land."""
    N = draw(st.integers(1, 7))
    M = draw(st.integers(0, 3 * N + 1))
    L = M
    if case.landing != "at-arrival":
        L = draw(st.integers(M + (case.landing == "next-step"), M + 2 * N + 2))
    if L <= N:
        M, L = M + N, L + N
    steps = draw(st.integers(0, L + 2 * N))
    system = example_system(draw(sizes), draw(st.integers(1, 2)), draw(st.integers(1, 2)), draw(seeds))
    return problem(system, N, M, L, steps, draw(seeds))


@each_case
@settings(max_examples=15)
@given(data=st.data())
def test_each_state_is_the_mean_given_what_has_landed(case: Case, data: st.DataObject) -> None:
    given_problem = data.draw(several(case))
    form = data.draw(st.sampled_from(list(COVARIANCE_FORMS)))
    found = case.run(given_problem, update=form)
    scale = np.abs(found.x).max()
    assert np.abs(found.x - conditioned(given_problem, given_problem.L)).max() <= RELATIVE * scale
    undelayed = standard_run(given_problem)
    used = len(found.innovations)
    arrived = (len(given_problem.inputs) - given_problem.M) // given_problem.N + 1
    assert used == min(len(given_problem.measurements), max(arrived, 0))
    assert len(found.P_reference) == min(used + 1, len(undelayed.P_reference))
    assert relative_difference(found.P_reference, undelayed.P_reference[: len(found.P_reference)]) <= RELATIVE
    assert relative_difference(found.gains, undelayed.gains[:used]) <= RELATIVE
    assert np.abs(found.innovations - undelayed.innovations[:used]).max(initial=0.0) <= RELATIVE * (1 + scale) * 10


@each_case
@settings(max_examples=15)
@given(data=st.data())
def test_so_it_is_where_some_were_lost(case: Case, data: st.DataObject) -> None:
    """A lost measurement is a cycle without a correction."""
    given_problem = data.draw(several(case))
    random = np.random.default_rng(data.draw(seeds))
    came = random.random(given_problem.measurements.shape) < 0.6
    record = [
        [float(y) if here else None for y, here in zip(row, present, strict=True)]
        for row, present in zip(given_problem.measurements, came, strict=True)
    ]
    found = case.run(given_problem._replace(measurements=record))
    expected = conditioned(given_problem, given_problem.L, came)
    assert np.abs(found.x - expected).max() <= RELATIVE * np.abs(expected).max()


@each_case
def test_the_last_measurements_may_be_missing(case: Case) -> None:
    L = 9 if case.landing == "at-arrival" else 11
    whole = problem(example_system(3, 1, 2, seed=4), 4, 9, L, 40, seed=5)
    fewer = whole._replace(measurements=whole.measurements[:5])
    found = case.run(fewer)
    assert np.abs(found.x - conditioned(fewer, L)).max() <= RELATIVE * np.abs(found.x).max()
    assert len(found.P_reference) == 11
    assert relative_difference(found.P_reference, standard_run(fewer).P_reference) <= RELATIVE


@each_case
@pytest.mark.parametrize("N", [1, 2, pytest.param(3, marks=pytest.mark.exhaust)])
def test_every_delay_of_short_cycles(case: Case, N: int) -> None:
    system = example_system(3, 1, 1, seed=7)
    for M in range(3 * N + 2):
        for L in [M] if case.landing == "at-arrival" else range(M + (case.landing == "next-step"), M + 2 * N + 1):
            given_problem = problem(system, N, M, L, L + N + 1, seed=N)
            found = case.run(given_problem).x
            assert np.abs(found - conditioned(given_problem, L)).max() <= RELATIVE * np.abs(found).max()


@pytest.mark.parametrize("case", CAN, ids=lambda case: "-".join([case.method, *case.options.values()]))
def test_compiled_and_plain_give_the_same(case: Case) -> None:
    L = 7 if case.landing == "at-arrival" else 9
    data = problem(example_system(3, 1, 2, seed=1), 3, 7, L, 21, seed=2)
    for found, expected in zip(case.run(data, backend="reference"), case.run(data), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-12)


N, M, L = 10, 4, 14


class Settled(NamedTuple):
    """P before and after a measurement once they no longer change, and K."""

    before: FloatArray
    after: FloatArray
    K: FloatArray


def constant_velocity() -> System:
    """A point of nearly constant velocity, whose position is measured with unit noise."""
    Q = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
    return linear_system(np.array([[1.0, 1.0], [0.0, 1.0]]), np.zeros((2, 1)), np.array([[1.0, 0.0]]), Q, np.eye(1))


def over(steps: int, P: FloatArray) -> FloatArray:
    Phi, Q = (constant_velocity().parameters.Phi[0], constant_velocity().parameters.Q[0])
    for _ in range(steps):
        P = Phi @ P @ Phi.T + Q
    return P


def settled() -> Settled:
    P, H, K = np.eye(2), np.array([[1.0, 0.0]]), np.empty((2, 1))
    for _ in range(1000):
        before = over(N, P)
        K = before @ H.T / (H @ before @ H.T + 1)
        P = (np.eye(2) - K @ H) @ before @ (np.eye(2) - K @ H).T + K @ K.T
    return Settled(before, P, K)


def test_the_worst_error_of_a_correction_that_lands_after_the_next_measurement() -> None:
    """8.5345602732, the root of the largest (Phi_a P^+ Phi_a' + Q_a)[0, 0] of the ages a = 14 .. 23, is that of the
    filter as it runs: its errors are linear in all that is drawn, so a run for each of these tells their covariance."""
    P = settled()
    ages = [float(over(a, P.after)[0, 0]) for a in range(L, L + N)]
    assert np.sqrt(max(ages)) == pytest.approx(8.5345602732, rel=1e-10)

    steps = 64
    nothing = Problem(constant_velocity(), N, M, L, np.zeros(2), P.before, np.zeros((steps, 1)), np.zeros((7, 1)))
    covariance, _, rows_x, _, rows_y = joint(nothing)
    case = Case("dual-rate", {}, "next-step")
    runs = [case.run(nothing._replace(measurements=rows_y[:, :, b])).x for b in range(len(covariance))]
    errors = np.array(runs).transpose(1, 2, 0) - rows_x
    variances = np.array([(error @ covariance @ error.T)[0, 0] for error in errors[L:]])
    np.testing.assert_allclose(variances[: 5 * N], np.tile(ages, 5), rtol=1e-9)
    assert np.sqrt(variances.max()) == pytest.approx(8.5345602732, rel=1e-9)


def test_without_compensation_the_same_would_be_unstable() -> None:
    """Errors before measurements: e_{k+N} = Phi_N e_k - Phi_2N K H e_{k-N}, for the correction of k-N lands after k."""
    K, Phi = settled().K, np.linalg.matrix_power(constant_velocity().parameters.Phi[0], N)
    two_cycles = np.block([[Phi, -Phi @ Phi @ K @ np.array([[1.0, 0.0]])], [np.eye(2), np.zeros((2, 2))]])
    assert np.abs(np.linalg.eigvals(two_cycles)).max() == pytest.approx(1.6911191479, rel=1e-9)


@each_case
def test_covariances_of_a_nonlinear_model_are_nearly_those_without_delay(case: Case) -> None:
    """They are linearised at other estimates."""
    drive = simulate_drive(steps=60, N=10, seed=0)
    L = 14 if case.landing == "at-arrival" else 17
    fixes, inputs = drive.truth.measurements, drive.inputs
    data = Problem(drive.system, 10, 14, L, drive.x0, drive.P0, inputs, fixes)
    found, undelayed = case.run(data), standard_run(data)
    assert np.isfinite(found.x).all()
    assert relative_difference(found.P_reference, undelayed.P_reference[: len(found.P_reference)]) <= 0.05
