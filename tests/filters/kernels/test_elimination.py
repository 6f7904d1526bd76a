"""The kernels of linear systems, in each version, against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.backends.choose import BACKENDS, BackendName, function_for
from filters.kernels import elimination, faddeev, givens, householder, inversion, place, schur
from tests.filters.few_sizes import few

sizes = st.integers(1, 7)
seeds = st.integers(0, 2**31 - 1)
each_backend = pytest.mark.parametrize(
    "backend", [pytest.param(name, marks=pytest.mark.exhaust if name == "compiled" else ()) for name in BACKENDS]
)


def close(found: Any, expected: Any) -> None:
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8 * np.abs(expected).max(initial=1e-9))


def system(seed: int, N: int, r: int) -> Any:
    """T = [A b] with a third of A's entries zero, some of them on the diagonal, but A regular."""
    random = np.random.default_rng(seed)
    A = np.where(random.random((N, N)) < 1 / 3, 0.0, random.normal(size=(N, N)))
    A[np.arange(N), random.permutation(N)] += 5.0 + N
    return np.hstack([A, random.normal(size=(N, r))])


def positive_definite(seed: int, n: int) -> Any:
    A = np.random.default_rng(seed).normal(size=(n, n))
    return A @ A.T + np.eye(n)


@each_backend
@settings(max_examples=20, deadline=None)
@given(N=sizes, r=st.integers(1, 3), n=sizes, seed=seeds)
def test_last_unknowns(backend: BackendName, N: int, r: int, n: int, seed: int) -> None:
    N, r, n = few(backend, N, r, n)
    T, n = system(seed, N, r), min(n, N)
    expected = np.linalg.solve(T[:, :N], T[:, N:])[N - n :]
    kernels: tuple[Callable[..., Any], ...] = (
        givens.triangularise,
        householder.triangularise_by_reflections,
        elimination.eliminate_dense,
        elimination.eliminate_pivoted,
    )
    for kernel in kernels:
        reduced, out = T.copy(), np.empty((n, r))
        function_for(backend, kernel)(reduced)
        assert not np.tril(reduced[:, :N], -1).any()
        function_for(backend, elimination.back_substitute)(reduced, out)
        close(out, expected)


@each_backend
@settings(max_examples=20, deadline=None)
@given(N=sizes, r=st.integers(1, 3), n=sizes, seed=seeds)
def test_faddeev(backend: BackendName, N: int, r: int, n: int, seed: int) -> None:
    N, r, n = few(backend, N, r, n)
    T, random = system(seed, N, r), np.random.default_rng(seed)
    C, D = random.normal(size=(n, N)), random.normal(size=(n, r))
    expected = D + C @ np.linalg.solve(T[:, :N], T[:, N:])
    function_for(backend, faddeev.faddeev)(T, C, D)
    close(D, expected)


@settings(max_examples=20, deadline=None)
@given(N=sizes, r=st.integers(1, 3), seed=seeds)
def test_reflections_keep_the_length_of_each_column(N: int, r: int, seed: int) -> None:
    T = system(seed, N, r)
    reflected = T.copy()
    householder.triangularise_by_reflections(reflected)
    close(np.linalg.norm(reflected, axis=0), np.linalg.norm(T, axis=0))


@each_backend
@settings(max_examples=10, deadline=None)
@given(N=sizes, seed=seeds)
def test_without_pivoting_where_none_is_needed(backend: BackendName, N: int, seed: int) -> None:
    T, out = np.hstack([positive_definite(seed, N), np.ones((N, 1))]), np.empty((N, 1))
    expected = np.linalg.solve(T[:, :N], T[:, N:])
    function_for(backend, elimination.eliminate_unpivoted)(T)
    function_for(backend, elimination.back_substitute)(T, out)
    close(out, expected)


@each_backend
@settings(max_examples=20, deadline=None)
@given(N=sizes, seed=seeds)
def test_inverses(backend: BackendName, N: int, seed: int) -> None:
    A = system(seed, N, 0)
    swaps, out = np.zeros(N, dtype=np.int64), np.empty((N, N))
    kernels: tuple[Callable[..., Any], ...] = (inversion.invert_dense, inversion.invert_nonzero)
    for kernel in kernels:
        inverted = A.copy()
        function_for(backend, kernel)(inverted, swaps)
        close(inverted, np.linalg.inv(A))
    function_for(backend, inversion.invert_by_columns)(A, np.empty((N, N + 1)), np.empty((N, 1)), out)
    close(out, np.linalg.inv(A))


@each_backend
@given(seed=seeds)
def test_a_rotation(backend: BackendName, seed: int) -> None:
    a, b = np.random.default_rng(seed).normal(size=2)
    rotation = function_for(backend, givens.rotation)
    for x, y in ((a, b), (b, a), (0.0, b), (1e200 * a, 1e200 * b), (a, 1e-300)):
        c, s, r = rotation(x, y)
        np.testing.assert_allclose([c * c + s * s, c * x + s * y], [1.0, r], rtol=1e-14)
        np.testing.assert_allclose((c * y - s * x) / r, 0.0, atol=4e-15)


@each_backend
def test_blocks(backend: BackendName) -> None:
    T, block = np.full((5, 6), np.nan), np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    expected = np.zeros((5, 6))
    function_for(backend, place.clear)(T)
    function_for(backend, place.place_both_ways)(block, 0, 2, T)
    expected[:2, 2:5], expected[2:5, :2] = block, block.T
    np.testing.assert_array_equal(T, expected)
    function_for(backend, place.place)(block, 3, 3, T)
    function_for(backend, place.place_diagonal)(7.0, 2, 0, 0, T)
    expected[3:5, 3:6], expected[0, 0], expected[1, 1] = block, 7.0, 7.0
    np.testing.assert_array_equal(T, expected)


@each_backend
@settings(max_examples=20, deadline=None)
@given(eliminated=st.integers(0, 3), kept=sizes, n=sizes, seed=seeds)
def test_schur_complements(backend: BackendName, eliminated: int, kept: int, n: int, seed: int) -> None:
    eliminated, kept, n = few(backend, eliminated, kept, n)
    total = eliminated + kept
    A, values = system(seed, max(total, n), 1)[:total, :n].copy(), np.linspace(1, 2, total)
    J, S, whole = positive_definite(seed, total), positive_definite(seed, n), positive_definite(seed, total)
    add_outer = function_for(backend, schur.add_outer)
    add_outer(A, S, 0, J, np.empty((total, n)))
    whole += A @ S @ A.T
    close(np.tril(J), np.tril(whole))
    corner = whole[eliminated:, :eliminated] @ np.linalg.inv(whole[:eliminated, :eliminated])
    expected = values[eliminated:] - corner @ values[:eliminated]
    function_for(backend, schur.complement)(eliminated, J, values)
    found = np.tril(J)[eliminated:, eliminated:]
    close(found, np.tril(whole[eliminated:, eliminated:] - corner @ whole[:eliminated, eliminated:]))
    close(values[eliminated:], expected)


@each_backend
@settings(max_examples=20, deadline=None)
@given(first=st.integers(0, 3), others=sizes, seed=seeds)
def test_noise_is_decorrelated(backend: BackendName, first: int, others: int, seed: int) -> None:
    """Rows, values and noise are transformed alike, so that what is estimated from them stays the same."""
    first, others = few(backend, first, others)
    total = first + others
    random = np.random.default_rng(seed)
    noise, rows, values = positive_definite(seed, total), random.normal(size=(total, 2)), random.normal(size=total)
    J, A, b = noise.copy(), rows.copy(), values.copy()
    function_for(backend, schur.decorrelate)(first, J, A, b, np.empty(total))
    after = np.tril(J) + np.tril(J, -1).T
    assert not (after - np.diag(np.diag(after)))[:first].any()
    for left, right in ((rows, A), (values, b)):
        close(right.T @ np.linalg.solve(after, right), left.T @ np.linalg.solve(noise, left))


@each_backend
def test_noise_that_follows_from_another(backend: BackendName) -> None:
    J, rows, values = np.array([[4.0, 9.0], [2.0, 1.0]]), np.array([[1.0, 0.0], [0.0, 1.0]]), np.array([2.0, 3.0])
    function_for(backend, schur.decorrelate)(2, J, rows, values, np.empty(2))
    np.testing.assert_array_equal(np.tril(J), np.diag([4.0, 0.0]))
    np.testing.assert_array_equal(rows, [[1.0, 0.0], [-0.5, 1.0]])
    np.testing.assert_array_equal(values, [2.0, 2.0])
