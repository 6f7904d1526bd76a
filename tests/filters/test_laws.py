"""Steffes Sec. IV: all methods give the standard filter's state outside [m, l - 1], and its covariance at every k."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.covariance_forms import COVARIANCE_FORMS
from filters.systems.example import example_system
from tests.filters.cases import Case, each_case, relative_difference, standard_run
from tests.strategies import Problem, problem

RELATIVE = 1e-10
DATA = st.data()


def check_laws(case: Case, problem: Problem) -> None:
    """The oracle is the standard filter, given only the measurements that have landed by step j.

    In [l, k + N - 1] these are all that were taken so far: there it is the standard filter without delay.
    """
    N, M, L = problem.N, problem.M, problem.L
    found = case.run(problem)
    undelayed = standard_run(problem)
    knowing = [standard_run(problem, landed).x for landed in range(len(problem.measurements) + 1)]
    scale = np.abs(undelayed.x).max()
    for j, x in enumerate(found.x):
        in_flight = j >= M and (j - M) % N < L - M  # j in [m, l - 1]
        if not in_flight:
            landed = (j - L) // N + 1 if j >= L else 0
            assert np.abs(x - knowing[landed][j]).max() <= RELATIVE * scale
            if j % N >= L:
                assert np.abs(x - undelayed.x[j]).max() <= RELATIVE * scale
    assert relative_difference(found.P_reference, undelayed.P_reference) <= RELATIVE
    used = len(found.innovations)
    assert used == min(len(problem.measurements), (len(problem.inputs) - M) // N + 1 if len(problem.inputs) >= M else 0)
    assert relative_difference(found.gains, undelayed.gains[:used]) <= RELATIVE
    assert np.abs(found.innovations - undelayed.innovations[:used]).max(initial=0.0) <= RELATIVE * (1 + scale) * 10


@each_case
@settings(max_examples=5)
@given(data=DATA)
def test_state_and_covariance_are_those_of_the_standard_filter(case: Case, data: st.DataObject) -> None:
    check_laws(case, data.draw(case.problems()))


@each_case
@pytest.mark.parametrize("N", [1, 2, 3, *(pytest.param(N, marks=pytest.mark.exhaust) for N in (4, 5))])
def test_every_legal_delay_and_feedback_step_of_short_cycles(case: Case, N: int) -> None:
    system = example_system(4, 2, 2, seed=7)
    for M in range(N + 1):
        for L in range(M, N + 1):
            if case.landing == "at-arrival" and L > M:
                continue
            if case.landing == "next-step" and L == M:
                continue
            if case.landing == "same-step" and N == L:
                continue
            check_laws(case, problem(system, N, M, L, 3 * N + 1, seed=N))


@each_case
@settings(max_examples=5)
@given(data=DATA)
def test_covariances_stay_symmetric_and_positive_definite(case: Case, data: st.DataObject) -> None:
    given_problem = data.draw(case.problems())
    for form in COVARIANCE_FORMS:
        P = case.run(given_problem, update=form).P_reference
        assert relative_difference(P, P.transpose(0, 2, 1)) <= 1e-12
        assert np.linalg.eigvalsh(P).min() > 0


@each_case
@settings(max_examples=5)
@given(data=DATA)
def test_covariance_forms_agree(case: Case, data: st.DataObject) -> None:
    given_problem = data.draw(case.problems())
    textbook, joseph, short = (case.run(given_problem, update=form) for form in COVARIANCE_FORMS)
    for other in (joseph, short):
        for found, expected in zip(other, textbook, strict=True):
            assert np.abs(found - expected).max(initial=0.0) <= 1e-10 * (1 + np.abs(textbook.x).max())


@each_case
@settings(max_examples=5)
@given(data=DATA)
def test_a_measurement_is_not_read_before_it_is_available(case: Case, data: st.DataObject) -> None:
    whole = data.draw(case.problems())
    available = sum(1 for c in range(len(whole.measurements)) if c * whole.N + whole.M <= len(whole.inputs))
    unread = whole.measurements.copy()
    unread[available:] = 1e6
    for found, expected in zip(case.run(whole._replace(measurements=unread)), case.run(whole), strict=True):
        np.testing.assert_array_equal(found, expected)


@each_case
@settings(max_examples=5)
@given(data=DATA)
def test_missing_measurements_leave_the_prediction(case: Case, data: st.DataObject) -> None:
    whole = data.draw(case.problems())
    fewer = whole._replace(measurements=whole.measurements[:1])
    found, expected = case.run(fewer), standard_run(fewer)
    assert relative_difference(found.P_reference, expected.P_reference) <= RELATIVE
    last = len(whole.inputs)
    if last >= whole.L:
        assert np.abs(found.x[last] - expected.x[last]).max() <= RELATIVE * np.abs(expected.x).max()


@pytest.mark.parametrize("form", COVARIANCE_FORMS)
@given(data=DATA)
def test_a_precomputed_gain_changes_nothing(form: str, data: st.DataObject) -> None:
    case = Case("dual-rate", {"update": form}, "next-step")
    whole = data.draw(case.problems())
    for found, expected in zip(case.run(whole, gain="precomputed"), case.run(whole, gain="at-update"), strict=True):
        np.testing.assert_array_equal(found, expected)


@given(data=DATA)
def test_euler_noise_is_exact_for_one_step_and_sum_for_a_model_that_stands_still(data: st.DataObject) -> None:
    case = Case("dual-rate", {}, "next-step")
    whole = data.draw(case.problems())
    one_step = problem(whole.system, 1, 0, 1, 5, seed=1)
    for found, expected in zip(case.run(one_step, low_rate_noise="euler"), case.run(one_step), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)
    still = whole.system._replace(
        parameters=whole.system.parameters._replace(Phi=np.eye(whole.system.states)[np.newaxis])
    )
    for noise in ("sum", "euler"):
        found = case.run(whole._replace(system=still), low_rate_noise=noise)
        assert relative_difference(found.x, case.run(whole._replace(system=still)).x) <= RELATIVE
