"""Each kernel, in each version, against NumPy's own algebra; and its operation count against the formula."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.backends.choose import BACKENDS, BackendName, function_for
from filters.backends.counted import Operations, count
from filters.kernels import dense, solve
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


@each_backend
@given(n=lengths, m=lengths, p=lengths, seed=seeds)
def test_products(backend: BackendName, n: int, m: int, p: int, seed: int) -> None:
    n, m, p = few(backend, n, m, p)
    A, B, x, y = normal(seed, (n, m), (m, p), (m,), (n,))
    out, scratch = np.empty((n, p)), np.empty((m, p))
    transposed = np.ascontiguousarray(B.T)
    for kernel in (dense.matmul, dense.matmul_narrow, dense.matmul_blocked):
        function_for(backend, kernel)(A, B, out)
        close(out, A @ B)
    function_for(backend, dense.matmul_transposed)(A, transposed, out, scratch)
    close(out, A @ B)
    function_for(backend, dense.matmul_transposed_narrow)(A, transposed, out)
    close(out, A @ B)
    (P,) = normal(seed + 1, (n, p))
    function_for(backend, dense.add_matmul_blocked)(P, A, B, out)
    close(out, P + A @ B)
    vector = np.empty(n)
    function_for(backend, dense.matvec)(A, x, vector)
    close(vector, A @ x)
    vector[:] = y
    function_for(backend, dense.add_matvec)(A, x, vector)
    close(vector, y + A @ x)


@each_backend
@given(n=lengths, m=lengths, seed=seeds)
def test_sums_and_copies(backend: BackendName, n: int, m: int, seed: int) -> None:
    n, m = few(backend, n, m)
    A, B, a, b = normal(seed, (n, m), (n, m), (n,), (n,))
    out, vector, turned = np.empty((n, m)), np.empty(n), np.empty((m, n))
    for kernel, expected in ((dense.add, A + B), (dense.subtract, A - B)):
        function_for(backend, kernel)(A, B, out)
        close(out, expected)
    for kernel, expected in ((dense.add_vectors, a + b), (dense.subtract_vectors, a - b)):
        function_for(backend, kernel)(a, b, vector)
        close(vector, expected)
    function_for(backend, dense.negate)(A, out)
    close(out, -A)
    function_for(backend, dense.transpose)(A, turned)
    close(turned, A.T)
    function_for(backend, dense.copy)(A, out)
    close(out, A)
    function_for(backend, dense.copy_vector)(a, vector)
    close(vector, a)
    stack, rows = np.zeros((3, n, m)), np.zeros((3, n))
    function_for(backend, dense.store)(A, stack, 1)
    function_for(backend, dense.store_vector)(a, rows, 2)
    close(stack, np.array([0 * A, A, 0 * A]))
    close(rows, np.array([0 * a, 0 * a, a]))


@each_backend
@given(n=lengths, m=lengths, seed=seeds)
def test_what_an_update_by_terms_takes(backend: BackendName, n: int, m: int, seed: int) -> None:
    n, m = few(backend, n, m)
    P, A, B, d = normal(seed, (n, n), (m, n), (m, n), (m,))
    out = P.copy()
    function_for(backend, dense.subtract_lower_product)(out, A, B, out)
    close(np.tril(out), np.tril(P - A.T @ B))
    D, divided = np.ones((m, m)), A.copy()
    function_for(backend, dense.place_diagonal)(d, D)
    close(D, np.where(np.eye(m, dtype=bool), d, 1.0))
    function_for(backend, dense.divide_rows)(divided, D, divided)
    close(divided, A / d[:, np.newaxis])


@each_backend
@given(p=lengths, n=lengths, seed=seeds)
def test_solves(backend: BackendName, p: int, n: int, seed: int) -> None:
    p, n = few(backend, p, n)
    S = positive_definite(seed, p)
    (B,) = normal(seed, (p, n))
    inverse, scratch, C, solved = np.empty((p, p)), np.empty((p, p)), np.zeros((p, p)), np.empty((p, n))
    function_for(backend, solve.inverse)(S, inverse, scratch)
    close(inverse, np.linalg.inv(S))
    function_for(backend, solve.cholesky)(S, C)
    close(C, np.linalg.cholesky(S))
    function_for(backend, solve.solve_cholesky)(C, B, solved)
    close(solved, np.linalg.solve(S, B))


@given(n=lengths, m=lengths, seed=seeds)
def test_a_product_may_be_added_in_place(n: int, m: int, seed: int) -> None:
    A, B, P = normal(seed, (n, m), (m, n), (n, n))
    expected = P + A @ B
    dense.add_matmul_blocked(P, A, B, P)
    close(P, expected)


@pytest.mark.parametrize("kernel", [dense.add, dense.subtract])
def test_a_sum_may_be_written_over_its_terms(kernel: Callable[..., None]) -> None:
    A, B = normal(0, (3, 4), (3, 4))
    expected, over_A, over_B = np.empty((3, 4)), A.copy(), B.copy()
    kernel(A, B, expected)
    kernel(over_A, B, over_A)
    kernel(A, over_B, over_B)
    close(over_A, expected)
    close(over_B, expected)


@given(n=lengths, m=lengths, p=lengths)
def test_operations_of_products(n: int, m: int, p: int) -> None:
    A, B, x = np.ones((n, m)), np.ones((m, p)), np.ones(m)
    product = Operations(multiply=n * m * p, add=n * (m - 1) * p)
    out, turned = np.ones((n, p)), np.ones((p, m))
    assert count(dense.matmul, A, B, out) == product
    assert count(dense.matmul_narrow, A, B, out) == product
    assert count(dense.matmul_blocked, A, B, out) == product
    assert count(dense.add_matmul_blocked, out, A, B, out) == product + Operations(add=n * p)
    assert count(dense.matmul_transposed, A, turned, out, np.ones((m, p))) == product
    assert count(dense.matmul_transposed_narrow, A, turned, out) == product
    assert count(dense.matvec, A, x, np.ones(n)) == Operations(multiply=n * m, add=n * (m - 1))
    assert count(dense.add_matvec, A, x, np.ones(n)) == Operations(multiply=n * m, add=n * m)
    assert count(dense.add, A, A, A) == count(dense.subtract, A, A, A) == Operations(add=n * m)
    assert count(dense.add_vectors, x, x, x) == count(dense.subtract_vectors, x, x, x) == Operations(add=m)
    for kernel in (dense.copy, dense.negate):
        assert count(kernel, A, A) == Operations()
    assert count(dense.transpose, A, np.ones((m, n))) == Operations()
    half = m * (m + 1) // 2 * n
    assert count(dense.subtract_lower_product, np.ones((m, m)), A, A, np.ones((m, m))) == Operations(half, half)
    assert count(dense.divide_rows, B, np.eye(m), B) == Operations(multiply=m * p, divide=m)


@given(p=lengths, n=lengths)
def test_operations_of_solves(p: int, n: int) -> None:
    S, B = np.eye(p) + 0.1, np.ones((p, n))
    eliminations = p * (p - 1) * 2 * p
    assert count(solve.inverse, S, S.copy(), S.copy()) == Operations(
        multiply=2 * p * p + eliminations, add=eliminations, divide=p
    )
    below = p * (p - 1) // 2
    inner = sum(j for i in range(p) for j in range(i + 1))
    assert count(solve.cholesky, S, S.copy()) == Operations(inner, inner, divide=below, sqrt=p)
    assert count(solve.solve_cholesky, S, B, B.copy()) == Operations(
        multiply=2 * n * (below + p), add=2 * n * below, divide=2 * p
    )
