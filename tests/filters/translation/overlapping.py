"""Functions whose arrays overlap at some call: what they give differs if a number is not read again once it is written.

spread(a, out) adds a[0] to each number of a: where `out` is `a`, to the others twice what a[0] was.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray

TABLE = np.arange(1.0, 13.0)


class Pair(NamedTuple):
    a: FloatArray
    b: FloatArray


class Nested(NamedTuple):
    pair: Pair
    c: FloatArray


def spread(a: FloatArray, out: FloatArray) -> None:
    for i in range(a.shape[0]):
        out[i] = a[0] + a[i]


def spread_on(a: FloatArray, out: FloatArray) -> None:
    spread(a, out)


def one_array_twice(a: FloatArray, _out: FloatArray) -> None:
    spread(a, a)


def row_of_the_same(A: FloatArray) -> None:
    spread(A[0], A[0])


def some_rows(A: FloatArray, i: int, j: int) -> None:
    spread(A[i], A[j])


def parts_of_one(a: FloatArray) -> None:
    spread(a[0:12], a[1:13])


def row_in_a_loop(A: FloatArray) -> None:
    for row in A:
        spread(row, A[0])


def field_twice(pair: Pair) -> None:
    spread(pair.a, pair.a)


def field_and_record(pair: Pair, a: FloatArray) -> None:
    spread(a, pair.b)


def field_under_two_names(pair: Pair, a: FloatArray) -> None:
    field_and_record(pair, pair.b)
    a[0] = pair.b[1]


def made_record(a: FloatArray, b: FloatArray) -> None:
    crossed(Nested(Pair(a, b), a))


def crossed(nested: Nested) -> None:
    spread(nested.pair.a, nested.c)


def remade_record(pair: Pair) -> None:
    other = Pair(pair.b, pair.a)
    spread(other.a, pair.b)


def changing_variable(a: FloatArray, b: FloatArray) -> None:
    here = a
    for _ in range(2):
        spread(here, b)
        here = b


def swapped(a: FloatArray, b: FloatArray) -> None:
    x, y = a, b
    for _ in range(3):
        spread(x, a)
        x, y = y, x


def parameter_that_changes(a: FloatArray, b: FloatArray) -> None:
    b[0] = 1.0
    a = b
    for i in range(a.shape[0]):
        b[i] = a[0] + a[i]


def either(flag: bool, a: FloatArray, b: FloatArray) -> FloatArray:
    if flag:
        return a
    return b


def returned(a: FloatArray, b: FloatArray) -> None:
    spread(either(False, a, b), b)


def as_pair(a: FloatArray, b: FloatArray) -> Pair:
    return Pair(b, a)


def returned_in_a_record(a: FloatArray, b: FloatArray) -> None:
    pair = as_pair(a, b)
    spread(pair.b, a)


def unpacked(a: FloatArray, b: FloatArray) -> None:
    x, y = as_pair(a, b)
    spread(y, a)
    spread(x, b)


def made_and_passed_twice(a: FloatArray, _b: FloatArray) -> None:
    own = a.copy()
    spread(own, own)
    for i in range(a.shape[0]):
        a[i] = own[i]


def table_written(a: FloatArray) -> None:
    reading_the_table(TABLE, a)


def reading_the_table(table: FloatArray, a: FloatArray) -> None:
    for i in range(a.shape[0]):
        a[i] = table[i] + TABLE[0] + a[0]


def vectors() -> tuple[Any, ...]:
    return np.arange(1.0, 13.0), np.arange(21.0, 33.0)


def matrix() -> FloatArray:
    return np.arange(1.0, 49.0).reshape(4, 12)


def the_same() -> tuple[Any, ...]:
    a = np.arange(1.0, 13.0)
    return a, a


def shifted() -> tuple[Any, ...]:
    a = np.arange(1.0, 14.0)
    return a[:-1], a[1:]


def rows_that_meet() -> tuple[Any, ...]:
    A = matrix()
    return A[1], A[1]


def shared_by_record() -> tuple[Any, ...]:
    a, b = vectors()
    return Pair(a, b), b


def twice_in_a_record() -> tuple[Any, ...]:
    a, _ = vectors()
    return (Nested(Pair(a, a), a),)


OVERLAPPING: list[tuple[Callable[..., Any], Callable[[], tuple[Any, ...]]]] = [
    (one_array_twice, vectors),
    (row_of_the_same, lambda: (matrix(),)),
    (some_rows, lambda: (matrix(), 1, 1)),
    (parts_of_one, lambda: (np.arange(1.0, 14.0),)),
    (row_in_a_loop, lambda: (matrix(),)),
    (field_twice, lambda: (Pair(*vectors()),)),
    (field_under_two_names, lambda: (Pair(*vectors()), np.zeros(1))),
    (made_record, vectors),
    (remade_record, lambda: (Pair(*vectors()),)),
    (changing_variable, vectors),
    (swapped, vectors),
    (returned, vectors),
    (returned_in_a_record, vectors),
    (unpacked, vectors),
    (made_and_passed_twice, vectors),
    (spread_on, the_same),
    (spread_on, shifted),
    (spread_on, rows_that_meet),
    (field_and_record, shared_by_record),
    (crossed, twice_in_a_record),
]
"""Functions in which `spread` is called with arrays that overlap, and arguments."""
