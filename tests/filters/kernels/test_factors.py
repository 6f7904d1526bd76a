"""Each kernel of `triangular`, `u_d` and `sequential`, in each version, against NumPy's algebra; and its operations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.backends.choose import BACKENDS, BackendName, function_for
from filters.backends.counted import Operations, count
from filters.kernels import sequential, triangular, u_d
from tests.filters.few_sizes import few

lengths = st.integers(1, 7)
seeds = st.integers(0, 2**31 - 1)
each_backend = pytest.mark.parametrize(
    "backend", [pytest.param(name, marks=pytest.mark.exhaust if name == "compiled" else ()) for name in BACKENDS]
)


def close(found: Any, expected: Any) -> None:
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def normal(seed: int, *shapes: tuple[int, ...]) -> list[Any]:
    random = np.random.default_rng(seed)
    return [random.normal(size=shape) for shape in shapes]


def positive_definite(seed: int, n: int) -> Any:
    (A,) = normal(seed, (n, n))
    return A @ A.T + np.eye(n)


def rubbish_below(A: Any) -> Any:
    """Of what is below the diagonal nothing is to be read."""
    below = np.tri(len(A), A.shape[1], -1, dtype=bool)
    return np.where(below, np.nan, A)


def rubbish_above(A: Any) -> Any:
    """Of the diagonal and what is above it nothing is to be read."""
    return np.where(np.tri(len(A), k=-1, dtype=bool), A, np.nan)


def u_and_d(factors: Any) -> tuple[Any, Any]:
    return np.triu(factors, 1) + np.eye(len(factors)), np.diag(np.diag(factors))


def joint(P: Any, H: Any, noise: Any) -> tuple[Any, Any]:
    """The gain for measurements with uncorrelated noise of these variances, and the covariance after them."""
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + np.diag(noise))
    return K, P - K @ H @ P


@each_backend
@settings(max_examples=20)
@given(n=lengths, seed=seeds)
def test_factors_of_a_matrix(backend: BackendName, n: int, seed: int) -> None:
    P = positive_definite(seed, n)
    wide, product = np.full((n, 2 * n), 7.0), np.empty((n, n))
    function_for(backend, u_d.u_d_factors)(np.where(np.tri(n), P, P if backend == "numpy" else np.nan), wide)
    U, D = u_and_d(wide[:, :n])
    close(U @ D @ U.T, P)
    close(wide[:, n:], 7.0)
    function_for(backend, u_d.u_d_product)(wide[:, :n].copy(), product)
    close(product, P)
    function_for(backend, triangular.root)(P, wide)
    S = np.triu(wide[:, :n])
    close(S @ S.T, P)
    close(wide[:, n:], 7.0)
    function_for(backend, triangular.root_product)(rubbish_below(S), product)
    close(product, P)


@each_backend
@settings(max_examples=20)
@given(n=lengths, seed=seeds)
def test_triangularisations(backend: BackendName, n: int, seed: int) -> None:
    Phi, A, B = normal(seed, (n, n), (n, n), (n, n))
    S, noise = np.triu(A), np.triu(B)
    expected = Phi @ S @ S.T @ Phi.T + noise @ noise.T
    V, out = rubbish_below(np.hstack([noise, np.empty((n, n))])), np.full((n, n), np.nan)
    function_for(backend, triangular.append_root_product)(Phi, rubbish_below(S), V)
    close(V[:, n:], Phi @ S)
    function_for(backend, triangular.householder)(V, out)
    close(np.triu(out) @ np.triu(out).T, expected)

    factors, noise_factors = A.copy(), B.copy()
    np.fill_diagonal(factors, np.diag(A) ** 2)
    np.fill_diagonal(noise_factors, np.diag(B) ** 2)
    (U, D), (U_noise, D_noise) = u_and_d(factors), u_and_d(noise_factors)
    expected = Phi @ U @ D @ U.T @ Phi.T + U_noise @ D_noise @ U_noise.T
    V, weights = rubbish_below(np.hstack([noise_factors, np.empty((n, n))])), np.empty(2 * n)
    function_for(backend, u_d.append_unit_product)(Phi, rubbish_below(factors), V, weights)
    close(V[:, n:], Phi @ U)
    function_for(backend, u_d.gram_schmidt)(V, weights, out, np.empty(2 * n))
    U, D = u_and_d(out)
    close(U @ D @ U.T / np.abs(expected).max(), expected / np.abs(expected).max())


@each_backend
@settings(max_examples=20)
@given(n=lengths, p=st.integers(1, 4), seed=seeds)
def test_scalar_updates_make_up_the_joint_one(backend: BackendName, n: int, p: int, seed: int) -> None:
    n, p = few(backend, n, p)
    P = positive_definite(seed, n)
    (H,) = normal(seed, (p, n))
    noise = np.random.default_rng(seed).uniform(0.1, 10, p)
    K, after = joint(P, H, noise)
    factors, S, by_bierman, by_carlson = np.empty((n, n)), np.empty((n, n)), np.empty((p, n)), np.empty((p, n))
    u_d.u_d_factors(P, factors)
    triangular.root(P, S)
    for row in range(p):
        function_for(backend, u_d.bierman_update)(factors, H, noise, row, by_bierman)
        function_for(backend, triangular.carlson_update)(S, H, noise, row, by_carlson)
        function_for(backend, sequential.join_gain)(H, row, by_bierman)
        function_for(backend, sequential.join_gain)(H, row, by_carlson)
    U, D = u_and_d(factors)
    close(U @ D @ U.T, after)
    close(np.triu(S) @ np.triu(S).T, after)
    close(by_bierman.T, K)
    close(by_carlson.T, K)


@each_backend
@settings(max_examples=20)
@given(p=lengths, n=lengths, seed=seeds)
def test_measurements_are_decorrelated_by_unit_triangular_solves(
    backend: BackendName, p: int, n: int, seed: int
) -> None:
    p, n = few(backend, p, n)
    R = positive_definite(seed, p)
    (B,) = normal(seed, (p, n))
    kept, variances = rubbish_above(np.zeros((p, p))), np.empty(p)
    function_for(backend, sequential.unit_lower_factors)(R, kept, variances)
    L = np.tril(kept, -1) + np.eye(p)
    close(L * variances @ L.T, R)
    for kernel, expected in (
        (sequential.solve_unit_lower, np.linalg.solve(L, B)),
        (sequential.solve_unit_lower_transposed, np.linalg.solve(L.T, B)),
    ):
        out, over = np.empty((p, n)), B.copy()
        function_for(backend, kernel)(kept, B, out)
        close(out, expected)
        function_for(backend, kernel)(kept, over, over)
        close(over, expected)
    (b,) = normal(seed, (p,))
    function_for(backend, sequential.solve_unit_lower_vector)(kept, b, vector := b.copy())
    close(vector, np.linalg.solve(L, b))


@given(n=lengths)
def test_operations_of_factors(n: int) -> None:
    P, out = np.eye(n) + 0.1, np.zeros((n, n))
    pairs = n * (n - 1) // 2
    inner = sum(j + 1 for i in range(n) for j in range(i))
    factors = Operations(multiply=2 * n + pairs + inner, add=inner, divide=n)
    assert count(u_d.u_d_factors, P, out) == factors
    assert count(triangular.root, P, out) == factors + Operations(multiply=pairs, sqrt=n)


@given(n=lengths)
def test_operations_of_a_time_update(n: int) -> None:
    Phi, S, V, w, out = np.ones((n, n)), np.eye(n) + 0.1, np.ones((n, 2 * n)), np.ones(2 * n), np.ones((n, n))
    pairs = n * (n - 1) // 2
    assert count(triangular.append_root_product, Phi, S, V) == Operations(multiply=n * (pairs + n), add=n * pairs)
    assert count(u_d.append_unit_product, Phi, S, V, w) == Operations(multiply=n * pairs, add=n * pairs)

    V = np.hstack([np.eye(n), np.eye(n) + 0.1])
    own, other = Operations(multiply=n + 1, add=n + 1, divide=2, sqrt=1), Operations(multiply=2 * n + 3, add=2 * n + 1)
    assert count(triangular.householder, V, out) == times(n, own) + times(pairs, other)

    expected = Operations()
    for i in range(n):
        length = 2 * n - i
        expected += Operations(multiply=2 * length, add=length, divide=1)
        expected += times(i, Operations(multiply=2 * length + 1, add=2 * length - 1))
    assert count(u_d.gram_schmidt, V, w, out, w) == expected


@given(n=lengths, row=st.integers(0, 3))
def test_operations_of_a_scalar_update(n: int, row: int) -> None:
    """Of the 1.5 n^2 multiplies of Bierman's a third makes f = U^T h, a third the new U, a third the gain."""
    factors, H, gains = np.eye(n) + 0.1, np.ones((4, n)), np.ones((4, n))
    pairs = n * (n - 1) // 2
    assert count(u_d.bierman_update, factors, H, np.ones(4), row, gains) == Operations(
        multiply=3 * pairs + 6 * n, add=3 * pairs + n, divide=n
    )
    assert count(triangular.carlson_update, factors, H, np.ones(4), row, gains) == Operations(
        multiply=4 * pairs + 8 * n, add=3 * pairs + n, divide=n + 1, sqrt=n + 1
    )
    assert count(sequential.join_gain, H, row, gains) == Operations(multiply=2 * n * row, add=(2 * n - 1) * row)


@given(p=lengths, n=lengths)
def test_operations_of_decorrelation(p: int, n: int) -> None:
    L, B, variances = np.eye(p) + 0.1, np.ones((p, n)), np.ones(p)
    below = p * (p - 1) // 2
    inner = sum(j for i in range(p) for j in range(i))
    assert count(sequential.unit_lower_factors, np.eye(p) + 0.1, L, variances) == Operations(
        multiply=inner + below, add=inner + below, divide=below
    )
    for kernel in (sequential.solve_unit_lower, sequential.solve_unit_lower_transposed):
        assert count(kernel, L, B, B.copy()) == Operations(multiply=n * below, add=n * below)
    assert count(sequential.solve_unit_lower_vector, L, variances, np.ones(p)) == Operations(below, below)


def times(number: int, operations: Operations) -> Operations:
    return Operations(*(number * each for each in operations))
