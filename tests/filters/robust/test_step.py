"""All ways of the step give the solution of the block system, in every backend and over many steps."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from filters.backends.choose import BACKENDS, BackendName
from filters.robust.blocks import NATURAL, RECOMMENDED
from filters.robust.model import prepared, weights
from filters.robust.records import Predicted, RobustModel
from filters.robust.run import run
from filters.robust.step import JOBS, STUDIED, WAYS, WayName, step
from tests.filters.robust.cases import (
    VECTOR_CASES,
    Array,
    attitude_model,
    block_system,
    close,
    position_model,
    prediction_model,
    random_model,
    start,
)
from tests.filters.translation.cases import HAS_COMPILER

models = st.builds(
    random_model,
    seed=st.integers(0, 2**31 - 1),
    n=st.integers(1, 4),
    m=st.integers(1, 3),
    p=st.integers(0, 3),
    t1=st.integers(0, 1),
    t2=st.integers(0, 1),
)
penalties = st.sampled_from([np.inf, 1.0, 1e4])
FAST: BackendName = "c" if HAS_COMPILER else "compiled"
WORKING = {**JOBS, **{name: job for name, job in STUDIED.items() if name != "lu without pivoting"}}
REAL_CASES: dict[str, tuple[RobustModel, float]] = {
    "attitude, gyro": (attitude_model("gyro"), 1e5),
    "attitude, bias": (attitude_model("bias"), np.inf),
    "position": (position_model("bias"), np.inf),
    "position, finite mu": (position_model("accelerometer"), 1e8),
    "between fixes": (prediction_model(), np.inf),
}


@pytest.mark.parametrize("name", WORKING)
@pytest.mark.parametrize("backend", ["reference", "numpy"])
@settings(max_examples=12, deadline=None)
@given(model=models, mu=penalties)
def test_the_block_system_is_solved(name: str, backend: BackendName, model: RobustModel, mu: float) -> None:
    n, p = len(model.F), len(model.H)
    before, y, c = start(n), np.linspace(-1, 1, p), np.linspace(1, 2, n)
    try:
        A, b = block_system(model, before, y, c, mu)
    except ValueError:
        assume(False)
    assume(np.linalg.cond(A) < 1e6)
    expected = np.linalg.solve(A, b)[-n:]
    found = one_step(name, model, before, y, c, mu, backend)
    close(found.x, expected[:, 0])
    close(found.P, expected[:, 1:])
    np.testing.assert_array_equal(found.P, found.P.T)


def one_step(
    name: str,
    model: RobustModel,
    before: Predicted,
    y: Array,
    c: Array,
    mu: float,
    backend: BackendName = "reference",
) -> Predicted:
    if name in JOBS:
        return step(model, before, y, c, mu=mu, way=name, backend=backend)
    ready, n = prepared(model, mu), len(before.x)
    after, job = Predicted(np.full(n, np.nan), np.full((n, n), np.nan)), STUDIED[name]
    BACKENDS[backend].function(job.function)(ready, weights(ready, mu), before, y, c, after, job.workspace(ready))
    return after


@pytest.mark.parametrize("mu", [np.inf, 1e5])
def test_the_order_of_blocks_changes_nothing_but_the_order(mu: float) -> None:
    model, before, y, c = random_model(2, 4, 3, 2, 1, 1), start(4), np.ones(2), np.ones(4)
    (A, b), (B, d) = (block_system(model, before, y, c, mu, order) for order in (NATURAL, RECOMMENDED))
    np.testing.assert_array_equal(np.sort(A, axis=None), np.sort(B, axis=None))
    close(np.linalg.solve(A, b)[-4:], np.linalg.solve(B, d)[-4:], 1e-11)


@pytest.mark.parametrize("case", ["attitude, bias", "position"])
def test_lu_without_pivoting_fails_where_mu_is_infinite(case: str) -> None:
    model, mu = REAL_CASES[case]
    n, p = len(model.F), len(model.H)
    before, y, c = Predicted(np.zeros(n), np.eye(n)), np.ones(p), np.zeros(n)
    with np.errstate(all="ignore"):
        after = one_step("lu without pivoting", model, before, y, c, mu)
        finite = one_step("lu without pivoting", model, before, y, c, 1e5)
    assert not np.isfinite(after.P).any()
    close(finite.P, step(model, before, y, c, mu=1e5).P, 1e-6)


@pytest.mark.exhaust
@pytest.mark.parametrize("case", [*VECTOR_CASES, *REAL_CASES])
def test_all_ways_agree_over_2000_steps(case: str) -> None:
    """To 1e-10, relative: P, each singular value of it, and x; and P stays positive definite."""
    model, mu = {**VECTOR_CASES, **REAL_CASES}[case]
    random = np.random.default_rng(3)
    measurements = random.normal(size=(2000, len(model.H)))
    x0 = np.ones(len(model.F))
    expected, *others = (
        run(model, x0, np.eye(len(x0)), measurements, mu=mu, way=way, backend=FAST) for way in ("closed", *WAYS)
    )
    singular_values = np.linalg.svd(expected.P, compute_uv=False)
    assert np.linalg.eigvalsh(expected.P).min() > 0
    for found in others:
        close_at_each_step(found.x, expected.x)
        close_at_each_step(found.P, expected.P)
        np.testing.assert_allclose(np.linalg.svd(found.P, compute_uv=False), singular_values, rtol=1e-10)


@pytest.mark.exhaust
@pytest.mark.parametrize("mu", [np.inf, 1e5])
def test_exact_measurements_cost_digits(mu: float) -> None:
    """With E_D = D / 2 the yaw's noise cancels in the limit, and its P falls by six digits in the first step."""
    model = attitude_model("all")
    measurements = np.random.default_rng(3).normal(size=(2000, 3))
    expected, *others = (
        run(model, np.ones(6), np.eye(6), measurements, mu=mu, way=way, backend=FAST) for way in ("lu", *WAYS)
    )
    for found in others:
        close_at_each_step(found.P, expected.P, 1e-10)
        close_at_each_step(found.x, expected.x, 1e-8)


def close_at_each_step(found: Array, expected: Array, tolerance: float = 1e-10) -> None:
    axes = tuple(range(1, found.ndim))
    error = np.abs(found - expected).max(axis=axes)
    assert np.max(error / np.abs(expected).max(axis=axes)) < tolerance


def test_a_model_per_step() -> None:
    rows = [random_model(seed, 3, 2, 2, 1, 0) for seed in range(4)]
    measurements, added = np.arange(8.0).reshape(4, 2), np.ones((4, 3))
    history = run(rows, np.zeros(3), np.eye(3), measurements, added, mu=5.0, way="givens")
    at = Predicted(np.zeros(3), np.eye(3))
    for i, model in enumerate(rows):
        at = step(model, at, measurements[i], added[i], mu=5.0, way="givens")
        np.testing.assert_array_equal(history.x[i + 1], at.x)
        np.testing.assert_array_equal(history.P[i + 1], at.P)


def test_inputs_are_left_as_they_are() -> None:
    model, before, y, c = random_model(2, 4, 3, 2, 1, 1), start(4), np.ones(2), np.ones(4)
    copies = [array.copy() for array in (*model, *before, y, c)]
    for way in WAYS:
        step(model, before, y, c, way=way)
    for array, copy in zip((*model, *before, y, c), copies, strict=True):
        np.testing.assert_array_equal(array, copy)


def test_names() -> None:
    assert get_args(WayName) == WAYS == ("inverse", "givens", "lu", "closed")
    with pytest.raises(ValueError, match="way='qr' is unknown; give one of inverse, givens, lu, closed"):
        step(random_model(2, 2, 1, 1, 0, 0), start(2), [0.0], [0.0, 0.0], way="qr")
