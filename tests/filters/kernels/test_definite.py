"""A covariance is told from what is none by its eigenvalues, with its diagonal scaled to one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.backends.choose import BACKENDS, BackendName, function_for
from filters.kernels.definite import ROUNDING, SYMMETRIC, covariance_root, is_covariance, is_semidefinite


def found(P: object) -> bool:
    matrix = np.array(P, dtype=np.float64)
    return is_semidefinite(matrix, np.empty_like(matrix))


@given(n=st.integers(1, 6), lost=st.floats(-10.0, 10.0), seed=st.integers(0, 10_000))
def test_it_is_the_least_eigenvalue_of_the_correlations(n: int, lost: float, seed: int) -> None:
    """Moved to `lost` times the limit, save for what is too near it to tell; whatever the units of the states."""
    random = np.random.default_rng(seed)
    half = random.normal(size=(n, n))
    P = half @ half.T + np.eye(n)
    correlations = P / np.sqrt(np.outer(np.diag(P), np.diag(P)))
    least = np.linalg.eigvalsh(correlations)[0]
    moved = correlations - (least - lost * ROUNDING) * np.eye(n)
    scaled = moved / np.sqrt(np.outer(np.diag(moved), np.diag(moved))) if n > 1 else correlations
    units = 10.0 ** random.uniform(-20, 20, size=n)
    expected = np.linalg.eigvalsh(scaled)[0] / ROUNDING
    if abs(expected + 1.0) > 1e-3:
        assert found(scaled * np.outer(units, units)) == (expected > -1.0)


@pytest.mark.parametrize(
    ("P", "expected"),
    [
        ([[0.0]], True),
        ([[0.0, 0.0], [0.0, 1.0]], True),
        ([[1.0, 1.0], [1.0, 1.0]], True),
        ([[4.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 0.0]], True),
        ([[-1e-300]], False),
        ([[0.0, 1e-9], [1e-9, 1.0]], False),
        ([[1.0, 1e-9], [1e-9, 0.0]], False),
        ([[1.0, 1.1], [1.1, 1.0]], False),
        ([[1.0, 0.9, -0.9], [0.9, 1.0, 0.9], [-0.9, 0.9, 1.0]], False),
    ],
)
def test_by_hand(P: list[list[float]], expected: bool) -> None:
    assert found(P) == expected


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("place", [(0, 0), (2, 2), (1, 0), (2, 1)])
def test_a_number_that_is_none_is_found_wherever_it_is(value: float, place: tuple[int, int]) -> None:
    P = np.eye(3)
    P[place] = P[place[::-1]] = value
    with np.errstate(invalid="ignore"):
        assert not found(P)


@given(n=st.integers(1, 6), rank=st.integers(0, 6), seed=st.integers(0, 10_000))
def test_the_root_of_a_singular_covariance(n: int, rank: int, seed: int) -> None:
    """Whatever its rank; of one that is not singular it is Cholesky's factor."""
    random = np.random.default_rng(seed)
    half = random.normal(size=(n, rank))
    P = half @ half.T
    root = np.zeros((n, n))
    with np.errstate(all="ignore"):
        covariance_root(P, root)
    deviations = np.sqrt(np.diag(P))
    assert (np.abs(root @ root.T - P) <= 1e-7 * np.outer(deviations, deviations)).all()
    if rank == n:
        np.testing.assert_allclose(root, np.linalg.cholesky(P), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize(
    ("P", "expected"),
    [
        ([[0.0]], True),
        ([[1.0, 1.0], [1.0, 1.0]], True),
        ([[1.0, 0.5 + 0.9 * SYMMETRIC], [0.5, 1.0]], True),
        ([[1.0, 0.5 + 1.1 * SYMMETRIC], [0.5, 1.0]], False),
        ([[1.0, 0.5], [0.5 + 1.1 * SYMMETRIC, 1.0]], False),
        ([[0.0, 0.0, 0.0], [0.0, 4.0, 2.0], [0.0, 2.0, 1.0]], True),
        ([[1.0, 2.0], [2.0, 1.0]], False),
        ([[np.nan]], False),
        ([[np.inf]], False),
        ([[1.0, np.nan], [0.0, 1.0]], False),
        ([[1.0, np.inf], [0.0, 1.0]], False),
        ([[1.0, np.inf], [np.inf, 1.0]], False),
    ],
)
def test_a_covariance_is_symmetric_finite_and_nowhere_negative(backend: BackendName, P: object, expected: bool) -> None:
    matrix = np.array(P, dtype=np.float64)
    with np.errstate(all="ignore"):
        assert function_for(backend, is_covariance)(matrix, np.empty_like(matrix)) == expected
