"""Stochastic cloning with several measurements on their way: one filter with the others, and an honest covariance."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.covariance_forms import COVARIANCE_FORMS, covariance_form
from filters.delayed import carried_gain, clone, clone_split, larsen, recalculate
from filters.delayed.cloning import Cloning, Jobs
from filters.delayed.flights import steps
from filters.history import HistoryRecorder
from filters.problem import check_problem
from filters.systems.example import example_system
from tests.filters.cases import relative_difference
from tests.filters.delayed.test_carried_gain import RELATIVE, problems_in_flight
from tests.strategies import Problem, problem, seeds, systems


@settings(max_examples=40)
@given(data=st.data())
def test_it_is_larsens_filter_and_recalculate_in_every_step(data: st.DataObject) -> None:
    """M from 1 to 3 N: estimates, covariances before a measurement, gains and innovations."""
    N = data.draw(st.integers(1, 7))
    M = data.draw(st.integers(1, 3 * N))
    of = problem(data.draw(systems()), N, M, M, data.draw(st.integers(0, M + 3 * N)), data.draw(seeds))
    found = clone.run(*of, backend="numpy")
    for other in (larsen.run(*of, backend="numpy"), recalculate.run(*of, backend="numpy")):
        for array, expected in zip(found, other, strict=True):
            assert array.shape == expected.shape
            assert np.abs(array - expected).max(initial=0.0) <= RELATIVE * (1 + np.abs(expected).max(initial=0.0))


@pytest.mark.parametrize("form", COVARIANCE_FORMS)
@settings(max_examples=25)
@given(of=problems_in_flight())
def test_its_covariance_is_that_of_its_error_in_every_step(form: str, of: Problem) -> None:
    """Which the carried gain knows from what is on its way, and a test holds to the joint distribution."""
    checked = check_problem(*of, several=True)
    jobs, recorder = Jobs(clone.start, clone.cloned_update), HistoryRecorder(of.system)
    cloning = Cloning(checked, of.system, covariance_form(form), jobs, "numpy")
    run = steps(cloning, checked, of.N, of.M, recorder)
    system, N, M, _, *data = of
    expected = carried_gain.error_covariances(system, N, M, *data, backend="numpy")
    for filtered, P in zip(run, expected, strict=True):
        assert relative_difference(filtered.now.P, P) <= RELATIVE


@pytest.mark.slow
@pytest.mark.exhaust
@pytest.mark.parametrize("form", COVARIANCE_FORMS)
def test_compiled_it_is_the_same(form: str) -> None:
    of = problem(example_system(4, 2, 2, seed=5), 2, 5, 5, 17, seed=2)
    compiled, plain = (clone.run(*of, update=form, backend=backend) for backend in ("compiled", "reference"))
    for found, value in zip(compiled, plain, strict=True):
        np.testing.assert_allclose(found, value, rtol=1e-11, atol=1e-12)


def test_split_it_has_one_on_its_way() -> None:
    of = problem(example_system(2, 1, 1), 2, 3, 3, 9, seed=2)
    with pytest.raises(ValueError, match=r"M=3, L=3, N=2 must satisfy .* use recalculate, larsen, clone,"):
        clone_split.run(*of)
