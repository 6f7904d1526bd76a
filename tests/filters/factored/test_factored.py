"""All forms keep the same covariance and find the same gain, whichever backend runs them."""

from __future__ import annotations

from typing import Any, TypeAlias, get_args

import numpy as np
import pytest
from hypothesis import given, settings

from filters.backends.choose import BACKENDS, BackendName, function_for
from filters.backends.counted import count
from filters.covariance_forms import COVARIANCE_FORMS, CovarianceFormName, covariance_form
from filters.factored import FACTORED_FORMS, FactoredFormName, factored_form
from filters.factored.form import FactoredForm
from filters.factored.workspace import new_factored_workspace
from tests.filters.factored.problems import Problem, close, numbers, problem, problems
from tests.filters.few_sizes import few

Numbers: TypeAlias = tuple[int, int, int, int]

each_form = pytest.mark.parametrize(
    "form", [pytest.param(factored_form(name, "short"), id=name) for name in FACTORED_FORMS]
)
each_backend = pytest.mark.parametrize(
    "backend", [pytest.param(name, marks=pytest.mark.exhaust if name == "compiled" else ()) for name in BACKENDS]
)


def dirty(n: int, m: int) -> Any:
    """Memory that nobody has cleared."""
    return np.full((n, m), np.nan)


def factors_of(form: FactoredForm, P: Any, backend: BackendName = "reference") -> Any:
    factors = dirty(*P.shape)
    function_for(backend, form.factor)(P, factors)
    return factors


def covariance_of(form: FactoredForm, factors: Any, backend: BackendName = "reference") -> Any:
    P = dirty(*factors.shape)
    function_for(backend, form.covariance)(factors, P)
    return P


def drawn_problem(backend: BackendName, drawn: Numbers) -> Problem:
    n, p, sources, seed = drawn
    n, p = few(backend, n, p)
    return problem(n, p, sources, seed)


def propagated(form: FactoredForm, given: Problem, backend: BackendName = "reference") -> Any:
    factors, out = factors_of(form, given.P, backend), dirty(*given.P.shape)
    work = new_factored_workspace(given.system)
    function_for(backend, form.propagation)(given.Phi, factors, given.Q, out, work)
    return covariance_of(form, out, backend)


def updated(form: FactoredForm, given: Problem, backend: BackendName = "reference") -> tuple[Any, Any]:
    factors, K, out = factors_of(form, given.P, backend), dirty(*given.H.T.shape), dirty(*given.P.shape)
    work = new_factored_workspace(given.system)
    function_for(backend, form.update)(factors, given.H, given.R, K, out, work)
    return K, covariance_of(form, out, backend)


@each_form
@each_backend
@settings(max_examples=30)
@given(drawn=numbers)
def test_a_covariance_comes_back_from_its_factors(form: FactoredForm, backend: BackendName, drawn: Numbers) -> None:
    given = drawn_problem(backend, drawn)
    for P in (given.P, given.Q):
        close(covariance_of(form, factors_of(form, P, backend), backend), P)


@each_form
@each_backend
@settings(max_examples=30)
@given(drawn=numbers)
def test_the_covariance_is_propagated(form: FactoredForm, backend: BackendName, drawn: Numbers) -> None:
    given = drawn_problem(backend, drawn)
    close(propagated(form, given, backend), given.propagated)


@each_form
@each_backend
@settings(max_examples=30)
@given(drawn=numbers)
def test_the_gain_and_the_covariance_after_it(form: FactoredForm, backend: BackendName, drawn: Numbers) -> None:
    given = drawn_problem(backend, drawn)
    K, P = updated(form, given, backend)
    close(K, given.gain)
    close(P, given.updated)


@each_form
def test_noise_sources_fewer_than_states_and_none(form: FactoredForm) -> None:
    for sources in (4, 1, 0):
        given = problem(n=8, p=4, sources=sources, seed=sources)
        assert np.linalg.matrix_rank(given.Q) == sources
        close(propagated(form, given), given.propagated)


@each_form
@settings(max_examples=30)
@given(given=problems)
def test_a_state_known_exactly_and_never_disturbed(form: FactoredForm, given: Problem) -> None:
    """The last state is zero before and after, and any state may become zero in the middle of a triangle."""
    n = len(given.P)
    for known in range(n):
        P, Q, Phi = given.P.copy(), given.Q.copy(), given.Phi.copy()
        P[known], P[:, known], Q[known], Q[:, known] = 0.0, 0.0, 0.0, 0.0
        Phi[known] = np.eye(n)[known]
        certain = given._replace(P=P, Q=Q, Phi=Phi)
        close(propagated(form, certain), certain.propagated)
        K, after = updated(form, certain)
        close(K, certain.gain)
        close(after, certain.updated)


@each_form
@settings(max_examples=30)
@given(given=problems)
def test_a_transition_that_forgets_states(form: FactoredForm, given: Problem) -> None:
    n = len(given.P)
    Phi = given.Phi.copy()
    Phi[: n // 2 + 1] = 0.0
    undisturbed = given._replace(Phi=Phi, Q=np.zeros((n, n)))
    close(propagated(form, undisturbed), undisturbed.propagated)


@each_form
def test_many_steps_in_the_same_memory(form: FactoredForm) -> None:
    given = problem(n=6, p=2, sources=3, seed=5)
    given = given._replace(Phi=given.Phi / np.abs(np.linalg.eigvals(given.Phi)).max())
    work, factors, out = new_factored_workspace(given.system), factors_of(form, given.P), dirty(6, 6)
    K = dirty(6, 2)
    expected = given
    for _ in range(200):
        form.propagation(given.Phi, factors, given.Q, out, work)
        form.update(out, given.H, given.R, K, factors, work)
        expected = expected._replace(P=expected.propagated)
        close(K, expected.gain)
        expected = expected._replace(P=(expected.updated + expected.updated.T) / 2)
        close(covariance_of(form, factors), expected.P)


@each_form
def test_inputs_are_left_as_they_are(form: FactoredForm) -> None:
    given = problem(n=5, p=2, sources=5, seed=1)
    before = [matrix.copy() for matrix in given]
    factors, work = factors_of(form, given.P), new_factored_workspace(given.system)
    kept, K, out = factors.copy(), dirty(5, 2), dirty(5, 5)
    form.propagation(given.Phi, factors, given.Q, out, work)
    form.update(factors, given.H, given.R, K, out, work)
    np.testing.assert_array_equal(factors, kept)
    for matrix, copy in zip(given, before, strict=True):
        np.testing.assert_array_equal(matrix, copy)


@pytest.mark.parametrize("name", COVARIANCE_FORMS)
def test_the_conventional_form_multiplies_as_the_covariance_form_does(name: CovarianceFormName) -> None:
    given = problem(n=5, p=2, sources=5, seed=2)
    form, model, work = factored_form("conventional", name), covariance_form(name), new_factored_workspace(given.system)
    K, out = given.H.T.copy(), given.P.copy()
    propagation = (given.Phi, given.P, given.Q, out)
    gain = (given.P, given.H, given.R, K)
    assert count(form.propagation, *propagation, work) == count(model.propagation, *propagation, work.dense)
    assert count(form.update, *gain, out, work) == count(model.gain, *gain, work.dense) + count(
        model.covariance, *gain, out, work.dense
    )


@pytest.mark.parametrize("name", ["square-root", "u-d"])
def test_an_indefinite_matrix_is_not_taken_for_a_covariance(name: FactoredFormName) -> None:
    factors = dirty(2, 2)
    with np.errstate(invalid="ignore"):
        factored_form(name).factor(np.array([[1.0, 2.0], [2.0, 1.0]]), factors)
    assert not np.all(np.diag(factors) >= 0)


def test_names() -> None:
    assert get_args(FactoredFormName) == FACTORED_FORMS
    with pytest.raises(ValueError, match="form='sqrt' is unknown; give one of conventional, square-root, u-d"):
        factored_form("sqrt")
    with pytest.raises(ValueError, match="update='shrot' is unknown"):
        factored_form("conventional", "shrot")
