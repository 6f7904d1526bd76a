"""Kernels written out: the same bits as with loops, without what is zero, one, or computed twice."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from filters.backends.counted import Operations, count
from filters.kernels.dense import matmul, mirror
from filters.kernels.solve import inverse
from filters.records import new_workspace
from filters.sparse.form import scratch
from filters.sparse.straight_line import Operand, traced
from filters.sparse.structure import full
from filters.sparse.symbols import Symbols
from filters.systems.example import example_system

DIAGONAL = Operand(("*00", "0*0", "001"))
ANY3 = Operand(full(3, 3))


def straight(kernel: Any, arguments: Mapping[str, Operand], *outputs: str) -> Any:
    return traced(kernel, arguments).function("straight", outputs)


def test_products_with_zero_and_one_are_left_out() -> None:
    sparse = straight(matmul, {"A": DIAGONAL, "B": ANY3, "out": ANY3}, "out")
    A, B = np.diag([2.0, 3.0, 1.0]), np.random.default_rng(0).normal(size=(3, 3))
    out = np.zeros((3, 3))
    sparse(A, B, out)
    np.testing.assert_array_equal(out, A @ B)
    assert count(sparse, A, B, out) == Operations(multiply=6)


def test_what_is_mirrored_is_computed_once() -> None:
    def gram(A: Any, out: Any) -> None:
        for i in range(3):
            for j in range(3):
                out[i, j] = A[i, 0] * A[j, 0] + A[i, 1] * A[j, 1] + A[i, 2] * A[j, 2]
        mirror(out)

    sparse = straight(gram, {"A": ANY3, "out": ANY3}, "out")
    A, out, expected = np.random.default_rng(1).normal(size=(3, 3)), np.zeros((3, 3)), np.zeros((3, 3))
    sparse(A, out)
    gram(A, expected)
    np.testing.assert_array_equal(out, expected)
    assert count(sparse, A, out).total == 6 * 5
    assert count(gram, A, out).total == 9 * 5


@pytest.mark.parametrize("size", [1, 2, 5])
def test_an_inverse_has_the_same_bits(size: int) -> None:
    square = Operand(full(size, size))
    sparse = straight(inverse, {"S": square, "out": square, "scratch": square}, "out")
    root = np.random.default_rng(size).normal(size=(size, size))
    S, found, expected, scratch = root @ root.T, np.zeros((size, size)), np.zeros((size, size)), np.zeros((size, size))
    sparse(S, found, scratch)
    inverse(S, expected, scratch)
    np.testing.assert_array_equal(found, expected)


def test_what_is_long_is_in_parts_that_hand_on_what_they_share() -> None:
    def twice(A: Any, B: Any, work: Any, out: Any) -> None:
        matmul(A, B, work.nn1)
        matmul(B, work.nn1, out)

    n = 8
    square = Operand(full(n, n))
    arguments = {"A": square, "B": square, "work": scratch(n, 2), "out": square}
    sparse = traced(twice, arguments).function("straight", ["out"])  # type: ignore[arg-type]
    assert "straight_2(" in inspect.getsource(sparse)
    A, B = np.random.default_rng(2).normal(size=(2, n, n))
    found, expected = np.zeros((n, n)), np.zeros((n, n))
    work = new_workspace(example_system(n, 0, 2))
    sparse(A, B, work, found)
    assert count(sparse, A, B, work, found).total == 2 * n * n * (2 * n - 1)
    twice(A, B, work, expected)
    np.testing.assert_array_equal(found, expected)


def test_signs_are_taken_by_sums() -> None:
    symbols = Symbols()
    a, b = symbols.given("a", 0), symbols.given("b", 0)
    assert a + -b is a - b
    assert -a * b is -(a * b)
    assert a * b is b * a
    assert 0.0 - a is -a
    assert -(0.0 - a) is a
    assert a - 0.0 is a
    assert 1.0 * a is a


def test_a_kernel_that_asks_for_a_number_has_no_straight_line() -> None:
    def pivoted(A: Any, out: Any) -> None:
        out[0, 0] = A[0, 0] if A[0, 0] else 1.0

    with pytest.raises(TypeError, match="no straight line"):
        straight(pivoted, {"A": ANY3, "out": ANY3}, "out")


def test_what_is_too_long_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    big = Operand(full(8, 8))
    monkeypatch.setattr("filters.sparse.straight_line.MOST_LINES", 63)
    with pytest.raises(ValueError, match=r"takes .* lines without loops, and at most 63 are written"):
        straight(matmul, {"A": big, "B": big, "out": big}, "out")
