"""What backend c makes of arguments, and of what comes back."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.backends.c_arguments import argument, share_memory
from filters.backends.in_c import in_c
from tests.filters.translation.cases import needs_compiler


class Pair(NamedTuple):
    a: FloatArray
    b: FloatArray


class Weighted(NamedTuple):
    pair: Pair
    weight: float


def same(pair: Pair, other: Pair) -> Pair:
    other.a[0] = pair.a[0] + 1.0
    return other


def mixed(pair: Pair, other: Pair) -> Pair:
    return Pair(pair.a, other.b)


def first(a: FloatArray, _b: FloatArray) -> FloatArray:
    return a


def row(A: FloatArray, i: int) -> FloatArray:
    found: FloatArray = A[i]
    return found


def doubled(a: FloatArray) -> FloatArray:
    return 2.0 * a


def total(weighted: Weighted, count: int, negative: bool) -> float:
    sign = -1.0 if negative else 1.0
    return sign * weighted.weight * weighted.pair.a[0] * count


def pair(*numbers: float) -> Pair:
    return Pair(np.array(numbers), np.array(numbers))


@needs_compiler
def test_what_is_returned_as_it_was_given_is_the_same_in_python() -> None:
    one, other = pair(1.0), pair(5.0)
    assert in_c(same)(one, other) is other
    assert other.a[0] == 2.0
    made = in_c(mixed)(one, other)
    assert made.a is one.a
    assert made.b is other.b
    assert in_c(first)(one.a, one.b) is one.a


@needs_compiler
def test_what_is_new_is_new_at_each_call() -> None:
    A, a = np.arange(6.0).reshape(2, 3), np.ones(2)
    np.testing.assert_array_equal(in_c(row)(A, 1), A[1])
    one, other = in_c(doubled)(a), in_c(doubled)(3.0 * a)
    np.testing.assert_array_equal([one, other], [[2.0, 2.0], [6.0, 6.0]])


@needs_compiler
@pytest.mark.parametrize("count", [3, np.int64(3), -3])
@pytest.mark.parametrize("negative", [True, np.bool_(False)])
@pytest.mark.parametrize("weight", [0.5, np.float64(0.25)])
def test_numbers_of_numpy_are_numbers(count: Any, negative: Any, weight: Any) -> None:
    weighted = Weighted(pair(2.0), weight)
    assert in_c(total)(weighted, count, negative) == total(weighted, count, negative)


@needs_compiler
def test_a_record_that_stands_where_another_was_is_another() -> None:
    run = in_c(total)
    for number in range(1000):
        assert run(Weighted(pair(float(number)), 1.0), 1, False) == number


def test_arrays_of_other_numbers_are_refused() -> None:
    with pytest.raises(ValueError, match="float32; backend='c' takes float64"):
        argument(np.zeros(2, dtype=np.float32))
    with pytest.raises(ValueError, match="whose rows lie side by side"):
        argument(np.zeros((2, 2)).T[:1])


def test_only_arrays_that_overlap_share_memory() -> None:
    a = np.arange(8.0)
    assert not share_memory([argument(a[:4]), argument(a[4:]), argument(pair(1.0))])
    assert share_memory([argument(a[:5]), argument(a[4:])])
    assert share_memory([argument(Pair(a, a))])
