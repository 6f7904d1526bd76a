"""Unstable plants: what rounding adds to a covariance must not grow. The oracle is SciPy's Riccati equation."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.covariance_forms import COVARIANCE_FORMS, CovarianceFormName
from filters.delayed import standard
from filters.error_covariance import true_covariance
from filters.factored import FACTORED_FORMS, FactoredFormName
from filters.history import History
from filters.registry import DELAYED_METHODS
from filters.system import System
from filters.systems.linear import linear_system
from tests.filters.cases import CASES, Case, each_case, relative_difference
from tests.filters.test_laws import check_laws
from tests.strategies import problem, unstable_system

STEPS = 2000
SEEDS = [0, pytest.param(1, marks=pytest.mark.exhaust)]

each_form = pytest.mark.parametrize("form", COVARIANCE_FORMS)
each_form_in_time = pytest.mark.parametrize(
    "form", [pytest.param(form, marks=() if form == "short" else pytest.mark.exhaust) for form in COVARIANCE_FORMS]
)
each_seed = pytest.mark.parametrize("seed", SEEDS)


def steady_covariance(system: System, N: int) -> FloatArray:
    """P_{k^-} after infinitely many measurements, one every N steps."""
    Phi, _, H, Q, R = (matrices[0] for matrices in system.parameters)
    Phi_N, Q_N = np.eye(len(Phi)), np.zeros_like(Q)
    for _ in range(N):
        Phi_N, Q_N = Phi @ Phi_N, Phi @ Q_N @ Phi.T + Q
    return np.asarray(solve_discrete_are(Phi_N.T, H.T, Q_N, R))


def without_data(system: System, N: int, steps: int = STEPS) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """x0, P0, inputs and measurements of a plant at rest: its covariance does not depend on them."""
    n, m, p = system.states, system.inputs, system.measurements
    return np.zeros(n), np.eye(n), np.zeros((steps, m)), np.zeros((steps // N + 1, p))


def check_steady(found: History, system: System, N: int) -> None:
    P = found.P_reference
    np.testing.assert_array_equal(P, P.transpose(0, 2, 1))
    assert relative_difference(P[-1], steady_covariance(system, N)) <= 1e-10


@each_case
@each_form_in_time
@each_seed
def test_every_method_ends_at_the_steady_covariance(case: Case, form: str, seed: int) -> None:
    system = unstable_system(seed)
    M, L = (3, 3) if case.landing == "at-arrival" else (3, 4)
    run = DELAYED_METHODS[case.method].run
    check_steady(
        run(system, 5, M, L, *without_data(system, 5), **case.options, update=form, backend="numpy"), system, 5
    )


@each_form
@each_seed
def test_a_measurement_in_every_step(form: CovarianceFormName, seed: int) -> None:
    system = unstable_system(seed)
    check_steady(standard.run(system, 1, 0, 0, *without_data(system, 1), update=form, backend="numpy"), system, 1)


@pytest.mark.parametrize("form", FACTORED_FORMS)
def test_every_factored_form(form: FactoredFormName) -> None:
    system = unstable_system(0)
    check_steady(multirate_gain.run(system, 1, *without_data(system, 1), form=form, backend="numpy"), system, 1)


@pytest.mark.exhaust
@pytest.mark.parametrize("backend", ["compiled", "reference"])
@pytest.mark.parametrize("method", [name for name in DELAYED_METHODS if name != "fuse-as-fresh"])
@each_form
def test_other_backends(method: str, form: str, backend: str) -> None:
    for seed in range(20 if backend == "compiled" else 1):
        system = unstable_system(seed)
        data = without_data(system, 5)
        check_steady(DELAYED_METHODS[method].run(system, 5, 3, 4, *data, update=form, backend=backend), system, 5)


@each_case
@each_seed
def test_the_laws_hold(case: Case, seed: int) -> None:
    M, L = (4, 4) if case.landing == "at-arrival" else (4, 8)
    check_laws(case, problem(unstable_system(seed), 10, M, L, 45, seed))


DT = 0.005  # s
PENDULUM = linear_system(  # inverted: angle, rate and the bias of the torque; the angle is measured
    Phi=np.array([[1.0, DT, 0.0], [9.81 * DT, 1.0, DT], [0.0, 0.0, 1.0]]),
    B=np.array([[0.0], [DT], [0.0]]),
    H=np.array([[1.0, 0.0, 0.0]]),
    Q=np.diag([1e-10, 1e-8, 1e-6]),
    R=np.array([[1e-4]]),
)


@pytest.mark.parametrize("case", [Case("standard", {}, "at-arrival"), *CASES], ids=str)
@pytest.mark.parametrize(
    "form", ["short", *(pytest.param(name, marks=pytest.mark.exhaust) for name in ("textbook", "joseph"))]
)
def test_an_inverted_pendulum_of_half_a_minute(case: Case, form: str) -> None:
    """At 200 Hz, its angle measured every 10 steps and 4 steps late."""
    M, L = (4, 4) if case.landing == "at-arrival" else (4, 8)
    data = without_data(PENDULUM, 10, 6000)
    run = DELAYED_METHODS[case.method].run
    check_steady(run(PENDULUM, 10, M, L, *data, **case.options, update=form, backend="numpy"), PENDULUM, 10)


def test_a_covariance_that_is_symmetric_up_to_rounding_starts_symmetric() -> None:
    system = unstable_system(0)
    x0, P0, inputs, measurements = without_data(system, 1, 3)
    P0[0, 1] += 1e-12
    P = standard.run(system, 1, 0, 0, x0, P0, inputs, measurements).P_reference
    np.testing.assert_array_equal(P, P.transpose(0, 2, 1))


@each_seed
def test_the_true_covariance_of_given_gains(seed: int) -> None:
    system = unstable_system(seed)
    x0, P0, inputs, measurements = without_data(system, 1)
    gains = standard.run(system, 1, 0, 0, x0, P0, inputs, measurements, backend="numpy").gains
    P = true_covariance(system, P0, gains).before
    np.testing.assert_array_equal(P, P.transpose(0, 2, 1))
    assert relative_difference(P[-1], steady_covariance(system, 1)) <= 1e-10
