"""Numbers that are not finite, and covariances that are none: a named error in every filter, form and backend."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters import multirate_gain
from filters.covariance_forms import COVARIANCE_FORMS
from filters.error_covariance import true_covariance
from filters.factored import FACTORED_FORMS
from filters.kernels.definite import is_semidefinite
from filters.registry import DELAYED_METHODS
from filters.robust.records import Predicted
from filters.robust.run import run as run_robust
from filters.robust.step import WAYS, WayName, step
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from tests.filters.cases import Case, each_case
from tests.filters.robust.cases import random_model
from tests.filters.test_unstable import without_data
from tests.strategies import Problem, problem, seeds

each_method = pytest.mark.parametrize("method", DELAYED_METHODS)
each_form = pytest.mark.parametrize("form", COVARIANCE_FORMS)
each_backend = pytest.mark.parametrize("backend", ["reference", "numpy"])
each_value = pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])

GOOD = problem(example_system(4, 2, 2, seed=5), 5, 2, 4, 17, seed=2)


def changed(name: str, value: float) -> Problem:
    """The third row of an argument, or its third entry, is no longer finite."""
    array = np.array(getattr(GOOD, name))
    array[(2,) * array.ndim if name == "P0" else (2, *[1] * (array.ndim - 1))] = value
    return GOOD._replace(**{name: array})


# -------------------- what is given


@each_method
@each_value
@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("x0", r"x0 holds a value that is not finite, at \[2\]"),
        ("P0", r"P0 holds a value that is not finite, at \[2, 2\]"),
        ("inputs", r"inputs holds a value that is not finite, at \[2, 1\]"),
        ("measurements", r"the measurement of step 10 is .*(nan|inf).*, which is not finite; give None"),
    ],
)
def test_what_is_given_must_be_finite(method: str, name: str, message: str, value: float) -> None:
    with pytest.raises(ValueError, match=message):
        DELAYED_METHODS[method].run(*changed(name, value))


@pytest.mark.parametrize("form", FACTORED_FORMS)
@pytest.mark.parametrize("name", ["x0", "P0", "inputs", "measurements"])
def test_what_is_given_to_a_multirate_gain(form: str, name: str) -> None:
    system, *_ = data = problem(example_system(4, 2, 2, seed=5), 1, 0, 0, 17, seed=2)
    start = {"x0": data.x0, "P0": data.P0, "inputs": data.inputs, "measurements": data.measurements}
    start[name] = start[name].copy()
    start[name][0] = np.nan
    with pytest.raises(ValueError, match="not finite"):
        multirate_gain.run(system, 1, **start, form=form)


@pytest.mark.parametrize(
    ("measurements", "message"),
    [
        ([[1.0, 2.0], [1.0]], r"the measurement of step 5 has shape \(1,\), the system needs \(2,\)"),
        ([[1.0, 2.0], 3.0], r"the measurement of step 5 has shape \(\), the system needs \(2,\)"),
        ([[1.0, "two"]], "measurements holds a value that is no number"),
        ([[1.0, None], [None, np.nan]], r"the measurement of step 5 is \[ *0. *nan\], which is not finite"),
    ],
)
def test_a_row_that_is_no_measurement(measurements: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        DELAYED_METHODS["larsen"].run(*GOOD._replace(measurements=measurements))


@each_value
def test_what_is_given_to_the_true_covariance(value: float) -> None:
    gains = np.zeros((3, 4, 2))
    with pytest.raises(ValueError, match="P0 holds a value that is not finite"):
        true_covariance(GOOD.system, np.full((4, 4), value), gains)
    gains[1, 0, 0] = value
    with pytest.raises(ValueError, match="gains holds a value that is not finite"):
        true_covariance(GOOD.system, np.eye(4), gains)


# -------------------- what the system gives


def broken_system(name: str, value: float) -> System:
    """GOOD's, but for one function of it in step 10."""
    system = GOOD.system
    whole: Callable[..., Any] = getattr(system, name)

    def filling(j: int, *rest: Any) -> None:
        whole(j, *rest)
        rest[-1][0] = value if j == 10 else rest[-1][0]

    def giving(j: int, *rest: Any) -> Any:
        matrix = whole(j, *rest).copy()
        matrix[0, 0] = value if j == 10 else matrix[0, 0]
        return matrix

    return system._replace(**{name: filling if name in "fh" else giving})


@each_method
@each_backend
@pytest.mark.parametrize("name", ["f", "F", "Q", "h", "H", "R"])
def test_the_function_of_the_system_is_named(method: str, backend: str, name: str) -> None:
    for value in (np.nan, np.inf):
        data = GOOD._replace(system=broken_system(name, value))
        if method == "fuse-as-fresh":  # h and H are those of m
            data = data._replace(M=0)
        with pytest.raises(ValueError, match=rf"step 10: {name} of the system gives a value that is not finite"):
            DELAYED_METHODS[method].run(*data, backend=backend)


@pytest.mark.parametrize("name", ["f", "F", "Q", "h", "H", "R"])
def test_the_function_of_a_multirate_gains_system_is_named(name: str) -> None:
    data = problem(GOOD.system, 1, 0, 0, 17, seed=2)
    start = data.x0, data.P0, data.inputs, data.measurements
    for n in (1, 5):
        broken = broken_system(name, np.nan)
        coarse = GOOD.system if name in "fh" else broken
        with pytest.raises(ValueError, match=rf"step 10: {name} of the system gives"):
            multirate_gain.run(broken, n, *start, coarse=coarse)


@each_method
def test_a_process_noise_that_is_no_covariance_is_named(method: str) -> None:
    with pytest.raises(ValueError, match="step 10: Q of the system is no covariance"):
        DELAYED_METHODS[method].run(*GOOD._replace(system=broken_system("Q", -1e3)))


@each_method
def test_an_estimate_without_bounds(method: str) -> None:
    """The plant grows by 1e30 a step, and nobody measures it. An update in step 7 makes nan of what is infinite."""
    step = 7 if method in ("augmentation", "fuse-as-fresh") else 10
    system = linear_system([[1e30]], [[1.0]], [[0.0]], [[1.0]], [[1.0]])
    data = Problem(system, 5, 2, 4, np.ones(1), np.eye(1), np.zeros((40, 1)), np.zeros((9, 1)))
    with pytest.raises(
        ValueError, match=rf"step {step}: (f of the system gives a value that is not|the covariance is no)"
    ):
        DELAYED_METHODS[method].run(*data)
    at_zero = data._replace(x0=np.zeros(1))
    with pytest.raises(
        ValueError, match=rf"step {step}: the covariance is no longer positive semidefinite, or a value no"
    ):
        DELAYED_METHODS[method].run(*at_zero)


def test_a_true_covariance_without_bounds() -> None:
    system = linear_system([[1e30]], [[1.0]], [[0.0]], [[1.0]], [[1.0]])
    with np.errstate(all="ignore"), pytest.raises(ValueError, match=r"true_covariance, step 6: .* no longer finite"):
        true_covariance(system, np.eye(1), np.zeros((40, 1, 1)))


@pytest.mark.parametrize("way", WAYS)
def test_a_robust_estimate_without_bounds(way: WayName) -> None:
    model = random_model(0, 2, 2, 1, 0, 0)
    grown = model._replace(F=1e120 * model.F, H=0.0 * model.H)
    with pytest.raises(ValueError, match=r"step 1: the covariance is no longer positive semidefinite, or a value no"):
        run_robust(grown, np.ones(2), np.eye(2), np.zeros((5, 1)), way=way)
    with pytest.raises(ValueError, match="the step leaves a P that is no covariance, or a value that is not finite"):
        step(grown, Predicted(np.ones(2), 1e100 * np.eye(2)), np.zeros(1), np.zeros(2), way=way)


@each_value
def test_what_is_given_to_the_robust_filter(value: float) -> None:
    model = random_model(0, 2, 2, 1, 0, 0)
    with pytest.raises(ValueError, match=r"the measurement of step 2 is .* not finite; give None"):
        run_robust(model, np.ones(2), np.eye(2), [[0.0], [0.0], [value]])


# -------------------- covariances


def ill_conditioned(R: float) -> System:
    """Position and speed at 100 Hz."""
    return linear_system([[1, 0.01], [0, 1]], [[0], [0.01]], [[1, 0]], 1e-12 * np.eye(2), [[R]])


def run_ill_conditioned(method: str, form: str, P0: float, R: float, backend: str = "reference") -> Any:
    x0, _, inputs, measurements = without_data(ill_conditioned(R), 10, 300)
    run = DELAYED_METHODS[method].run
    start = ill_conditioned(R), 10, 4, 8, x0, P0 * np.eye(2), inputs, measurements
    return run(*start, update=form, backend=backend)


@pytest.mark.parametrize("method", [name for name in DELAYED_METHODS if name not in ("augmentation", "fuse-as-fresh")])
def test_short_breaks_down_where_joseph_does_not(method: str) -> None:
    """But for cloning, which subtracts its terms from P_{m^-}: the first of them leaves a covariance here."""
    if not method.startswith("clone"):
        broken = r"step 20: the covariance is no longer positive .* give update='joseph', or"
        with pytest.raises(ValueError, match=broken):
            run_ill_conditioned(method, "short", 1e10, 1e-8)
    assert np.linalg.eigvalsh(run_ill_conditioned(method, "joseph", 1e10, 1e-8).P_reference[2:]).min() > 0


def test_augmentation_has_one_form_and_names_a_method_that_has_others() -> None:
    for form in COVARIANCE_FORMS:
        with pytest.raises(ValueError, match=r"step 20: rounding errors .*; run filters.larsen with update='joseph'"):
            run_ill_conditioned("augmentation", form, 1e12, 1e-8)


@each_method
@each_form
@pytest.mark.parametrize(
    "P0", [1.0, 1e8, 1e10, *(pytest.param(P0, marks=pytest.mark.exhaust) for P0 in (1e4, 1e7, 1e9, 1e12))]
)
@pytest.mark.parametrize("R", [1e-8, pytest.param(1e-4, marks=pytest.mark.exhaust)])
def test_no_covariance_is_returned_that_is_none(method: str, form: str, P0: float, R: float) -> None:
    """A breakdown, or no eigenvalue below zero but by rounding, where the diagonal is scaled to one."""
    try:
        P = run_ill_conditioned(method, form, P0, R).P_reference
    except ValueError as error:
        assert re.search("no longer positive semidefinite|rounding errors", str(error))  # noqa: PT017 - either may be
        return
    deviations = np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    assert np.linalg.eigvalsh(P / (deviations[:, :, np.newaxis] * deviations[:, np.newaxis, :])).min() > -1e-7


@pytest.mark.exhaust
def test_compiled_breaks_down_too() -> None:
    with pytest.raises(ValueError, match=r"step 20: the covariance is no longer positive"):
        run_ill_conditioned("standard", "short", 1e10, 1e-8, "compiled")


@each_case
@each_form
@settings(max_examples=5)
@given(data=st.data())
def test_a_singular_covariance_is_one(case: Case, form: str, data: st.DataObject) -> None:
    """States that are known exactly, that go together, and that no noise moves."""
    whole = data.draw(case.problems())
    n = whole.system.states
    random = np.random.default_rng(data.draw(seeds))
    rank = data.draw(st.integers(0, n))
    root = random.normal(size=(n, rank))
    root[random.random(n) < 0.3] = 0.0
    parameters = whole.system.parameters
    still = parameters._replace(Q=0.0 * parameters.Q)
    for system in (whole.system, whole.system._replace(parameters=still)):
        found = case.run(whole._replace(system=system, P0=root @ root.T), update=form)
        assert np.isfinite(found.x).all()
    if rank == 0:
        assert not found.P_reference.any()


@pytest.mark.parametrize("form", FACTORED_FORMS)
@pytest.mark.parametrize("rank", range(4))
def test_a_singular_covariance_of_a_multirate_gain_is_one(form: str, rank: int) -> None:
    data = problem(example_system(4, 2, 2, seed=5), 1, 0, 0, 17, seed=2)
    root = np.random.default_rng(0).normal(size=(4, rank))
    still = data.system.parameters._replace(Q=0.0 * data.system.parameters.Q)
    system = data.system._replace(parameters=still)
    found = multirate_gain.run(system, 1, data.x0, root @ root.T, data.inputs, data.measurements, form=form)
    assert np.isfinite(found.x).all()


@given(seed=seeds, size=st.integers(1, 6), below=st.sampled_from([1e-6, 1e-3, 1.0]))
def test_an_eigenvalue_below_zero_is_found_where_the_diagonal_is_positive(seed: int, size: int, below: float) -> None:
    random = np.random.default_rng(seed)
    units = 10.0 ** random.integers(-8, 8, size=size)
    root = random.normal(size=(size, size))
    correlation = root @ root.T / np.outer(*[np.sqrt(np.diag(root @ root.T))] * 2)
    lowest = np.linalg.eigvalsh(correlation)[0]
    for shift, expected in ((1e-5, True), (-below, False)):
        matrix = correlation + (shift - lowest) * np.eye(size)
        found = is_semidefinite(matrix * np.outer(units, units), np.empty((size, size)))
        assert found == expected
