"""Functions that say one thing of the language each; each with arguments, and run in Python and in C by the tests."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray

COLD = 'it is too cold: "-273"\nat most'
LONG = "it is too cold, " + "much, " * 20
HALF, TABLE = 0.5, np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])


class Pair(NamedTuple):
    a: Any
    b: Any


def precedence(x: float, y: float, z: float) -> float:
    return -(x - (y - z)) * (x + y) / (z * (x / y)) - -x + (x - y - z)


def powers(x: float, y: float) -> float:
    return x**2 + (x - y) ** 2 + abs(x) ** 3 + abs(x) ** 0.5


def whole_division(i: int, j: int) -> int:
    return 100 * (i // j) + i % j + (-i) // 7 - (i - 20) % j


def remainder_of_reals(x: float, y: float) -> float:
    return x % y + (-x) % y + x % -y


def chained(x: float, y: float) -> float:
    return 1.0 if 0.0 < x <= y < np.inf else 2.0


def logic(x: float, y: float, i: int) -> float:
    if not (x > 1.0 and y > 1.0) or i == 3:
        return x if x > y and not i else y
    if i != 2:
        return -1.0
    return 0.0


def extremes(x: float, y: float, i: int) -> float:
    return max(x, y) - min(x, 0.5) + max(i, 2) * min(i, 3) + max(x, i)


def functions(x: float, y: float) -> float:
    return np.sqrt(x) + math.sqrt(y) + abs(x - 9.0) + np.floor(x) + float(3) + math.copysign(2.0, -x) + np.abs(-y)


def questions(x: float) -> float:
    return 1.0 if np.isnan(x) or math.isinf(x) or not np.isfinite(x) else HALF


def flags_are_numbers(x: float, i: int) -> float:
    return (x > 1.0) / 2 + (i > 2) * 3 + abs(i - 4) + -(x < 0.0)


def in_place(x: FloatArray, out: FloatArray) -> None:
    out += x
    out[1:3] *= 2.0
    out -= 0.5


def limit_in_an_array(counts: Any, x: FloatArray) -> float:
    total = 0.0
    for i in range(counts[0]):
        counts[0] = 2
        total += x[i]
    return total


def limit_that_changes(x: FloatArray, n: int) -> float:
    total = 0.0
    for i in range(n):
        n = 1
        total += x[i]
    return total + n


def guarded(x: float) -> float:
    if x < -100.0:
        raise ValueError('it is too cold: "-273"\nat most')
    return np.sqrt(x + 100.0)


def guarded_by_name(x: float) -> float:
    if x < -100.0:
        raise ValueError(COLD)
    return np.sqrt(x + 100.0)


def guarded_at_length(x: float) -> float:
    if x < -100.0:
        raise ValueError(LONG)
    return np.sqrt(x + 100.0)


def _lifted(x: FloatArray, least: float) -> FloatArray:
    if x[0] < least:
        raise ValueError("it is too cold in here")
    return 2.0 * x


def guarded_inside(x: FloatArray, least: float) -> float:
    lifted = _lifted(x, least)
    return lifted[0] + lifted[1]


def round(x: float) -> float:
    return np.floor(x + 0.5)


def named_as_in_c(x: float) -> float:
    remainder = x - round(x)
    return 2.0 * remainder


def negative_indices(x: FloatArray, i: int) -> float:
    return x[-1] + 10.0 * x[i - 2] + 100.0 * x[-2]


def part_of(P: FloatArray, x: FloatArray) -> float:
    top, left, row, tail = P[:2, :2], P[:, 1:], P[1], x[2:]
    top[1, 0] = 7.0
    left[2, 0] += tail[0]
    row[2] = tail[-1]
    return tail[1] + left[0, 1] + P[1:, 1:][1, 1]


def _cleared(block: FloatArray) -> float:
    total = 0.0
    for i in range(block.shape[0]):
        for value in block[i]:
            total += value
        block[i, -1] = 0.0
    block[0] = 0.5
    return total


def block_given_away(P: FloatArray) -> float:
    """Rows of it do not lie side by side."""
    block = P[1:, 1:]
    return _cleared(P[:2, 1:]) + 10.0 * _cleared(block) + 100.0 * _cleared(block[:1, 1:]) + 1000.0 * P[2, 1:][1]


def swapped(x: FloatArray) -> None:
    x[0], x[1] = x[1], x[0]
    a, b = x[2], x[3]
    a, b = b, a + b
    x[2], x[3] = a, b


def widened(n: int) -> float:
    total = 0
    for i in range(n):
        total += 0.5 * i
    return total


def signed(n: int) -> int:
    count = 0
    for i in range(n):
        count -= i
    return count % 5


def loops(x: FloatArray, n: int) -> float:
    total = 0.0
    for i in range(3, -1, -1):
        if i == 1:
            continue
        for j in range(i, n, 2):
            total += x[i] * (j + 1)
            if total > 50.0:
                break
    for value in x:
        total -= value
    while total > 10.0:
        total /= 2.0
    return total


def kept_over_rounds(x: FloatArray) -> float:
    last = 0.0
    for i in range(len(x)):
        now = x[i]
        if i > 0:
            last = last + now * x[i - 1]
    return last


def declared_in_branches(x: float) -> float:
    if x > 0.0:
        sign = 1.0
        root = np.sqrt(x)
    else:
        sign, root = -1.0, np.sqrt(-x)
    return sign * root


def made(x: FloatArray) -> FloatArray:
    A = np.array([[x[0], 1, 0.0], [2.0, x[1], -1]])
    B = np.diag([x[2], 3.0])
    C = np.zeros((2, 3), dtype=np.float64)
    D = np.eye(2, 3)
    out = np.ones((2, 3))
    C[:, :] = 0.25
    for i in range(2):
        for j in range(3):
            out[i, j] = A[i, j] + B[i, 0] * D[i, j] + C[i, j] - np.zeros_like(A)[i, j]
    return out


def made_and_aliased(x: FloatArray) -> FloatArray:
    first = x.copy()
    first[0] = 9.0
    second = first
    second[1] = 8.0
    return second


def whole_arrays(x: FloatArray, out: FloatArray) -> None:
    out[:] = -x * 2.0 + np.sqrt(x) / (1.0 + x)
    out[1:] = out[:-1]
    out[:2] = x[2:4] - 1.0


def record(pair: Pair, x: float) -> Pair:
    first, (second, third) = pair.a, pair.b
    other = Pair(first, x)
    return Pair(other.b + second, Pair(third, pair[0]))


def shapes(P: FloatArray, x: FloatArray) -> int:
    n, m = P.shape
    if P.shape != (3, 3) or np.shape(x) == (2,):
        raise ValueError("never")
    return 100 * n + 10 * m + len(x) + len((1, 2))


def constants(i: int) -> float:
    return TABLE[i, 1] + HALF + TABLE[-1, 0]


def _from_start(A: FloatArray, start: int) -> float:
    return A[start] if start < 2 else _last(A)


def _last(A: FloatArray) -> float:
    return A[len(A) - 1]


def calls(x: FloatArray) -> float:
    return _from_start(x, 1) + 10.0 * _from_start(x, 2)


def _model(scale: float) -> Any:
    def scaled(x: FloatArray) -> FloatArray:
        return np.array([scale * x[0], x[1]])

    return scaled


def given_functions(pair: Pair, x: FloatArray) -> float:
    one = pair.a(x)
    other = pair.b(one)
    return one[0] + 10.0 * other[0]


def one_after_another(pair: Pair, x: FloatArray) -> float:
    """Each call has memory of its own: the second leaves what the first returned."""
    first, second = pair.a(x), pair.a(2.0 * x)
    return first[0] - second[0]


def many_rows(rows: FloatArray, out: FloatArray) -> None:
    for j in range(len(rows)):
        out[rows.shape[0] - 1 - j, 0] = rows[j, 0] - rows[-1, 1]


def whole_among_reals(x: FloatArray, n: int) -> float:
    total = 0.5
    total += n
    x[0] = n - 1
    x[1:] = n
    y = x[0]
    y = n
    return total * n + np.sqrt(n) - n / x[1] + (y if x[3] > n else n) + max(x[2], n) - n % 1.5


def _put(x: FloatArray, value: float) -> int:
    x[0] = value
    return 1


def known_and_done(x: FloatArray) -> float:
    """What is returned is known, and something is done too."""
    where = _put(x, 5.0)
    first, last = _put_at_ends(x, 4.0)
    return x[0] + x[where] + x[_row(2)] + x[first] - 2 * x[last]


def _put_at_ends(x: FloatArray, value: float) -> tuple[int, int]:
    x[0], x[3] = value, 2.0 * value
    return 0, 3


def _row(i: int) -> int:
    return 0 if i >= 0 else 1


def computed(x: FloatArray) -> FloatArray:
    return 2.0 * x + 1.0


def negated(x: FloatArray) -> FloatArray:
    return -x


def computed_and_named(x: FloatArray) -> FloatArray:
    y = 2.0 * x
    y[0] = x[1]
    return y


def part_of_what_is_computed(x: FloatArray) -> FloatArray:
    found: FloatArray = (2.0 * x)[1:3]
    return found


def computed_in_a_record(x: FloatArray) -> Pair:
    return Pair(x[0] * (2.0 * x)[1], 3.0 * x)


def computed_and_passed_on(x: FloatArray) -> float:
    first, second = computed(x), negated(computed(x))
    return first[0] * second[1]


def below_the_diagonal(J: FloatArray) -> float:
    """Of one row nothing is below."""
    total = J[0, 0]
    for k in range(J.shape[0]):
        for i in range(k + 1, J.shape[0]):
            total += J[i, k]
        for i in range(k - 1, -1, -1):
            total -= J[i, k]
    return total


def one_of_numbers(x: FloatArray, n: int) -> float:
    """`or` and `and` give one of their numbers."""
    least = x[0]
    total = (least or 0.5) + (x[1] and 3.0) + (0 or x[2]) + (2 and x[3])
    x[0] = x[3] or 0.5
    x[1] = x[2] and n
    x[2] = n or x[3] or 7
    if x[0] or (n and not x[1]):
        total = total + 100.0
    while n and total > 0.0:
        total = total - 60.0
    return total + (1.0 if n and x[0] else 2.0)


def past_an_int(j: int) -> float:
    """A step by a constant is exact where an int would not hold it."""
    a = j * 1000000000
    b = 0.5 * (j * 400 + 3)
    c = (j * 300) / 7
    d = j * 100 * 5.0 - 3000000000
    e = j + 2000000000
    large = 5000000000 if j > 4 else 7000000000
    total = 0
    for _ in range(2):
        total = total + 4000000000
    return a + b + c + d + e + large + total


def flag_that_is_counted(n: int) -> int:
    m = n > 1
    m = m + 1
    k = n > 2
    k += n
    return 10 * m + k


def parameter_that_is_counted_down(x: FloatArray, n: int) -> float:
    n = n - 6
    n += 1
    return x[n] + n


def inverted(x: FloatArray) -> float:
    return x[~0] + ~2


def without_fraction(x: float) -> int:
    return int(x)


X4, P3 = np.array([3.0, -1.5, 0.25, 8.0]), np.arange(9.0).reshape(3, 3)
MANY = np.random.default_rng(1).normal(size=(100, 2))
SCALED = Pair(_model(2.0), _model(3.0))

CASES: list[tuple[Any, list[tuple[Any, ...]]]] = [
    (precedence, [(1.5, -2.25, 0.7), (-1e10, 3.3, 1e-3)]),
    (powers, [(1.1, -2.3), (-0.7, 0.1)]),
    (whole_division, [(17, 5), (3, 4), (-17, 5), (17, -5), (0, 3)]),
    (remainder_of_reals, [(5.5, 2.0), (-5.5, 2.0), (6.0, 3.0)]),
    (chained, [(1.0, 2.0), (-1.0, 2.0), (1.0, np.inf), (3.0, 2.0), (np.nan, 1.0)]),
    (logic, [(x, y, i) for x in (0.5, 2.0) for y in (1.5, 0.1) for i in range(4)]),
    (one_of_numbers, [(np.array(x), n) for x in ([3.0, 4.0, 5.0, 0.0], [0.0, 0.0, np.nan, 8.0]) for n in (0, 3)]),
    (past_an_int, [(3,), (7,), (2**30,)]),
    (flag_that_is_counted, [(1,), (2,), (3,)]),
    (parameter_that_is_counted_down, [(X4, 4), (X4, 6)]),
    (inverted, [(X4,)]),
    (without_fraction, [(-2.75,), (3.5,), (2147483647.5,), (-2147483648.0,)]),
    (extremes, [(1.0, 2.0, 1), (np.nan, 1.0, 5), (1.0, np.nan, 0)]),
    (functions, [(2.5, 7.0)]),
    (questions, [(1.0,), (np.nan,), (-np.inf,)]),
    (flags_are_numbers, [(2.0, 1), (-0.5, 7)]),
    (in_place, [(X4, np.ones(4))]),
    (limit_in_an_array, [(np.array([4]), X4)]),
    (limit_that_changes, [(X4, 3), (X4, 0)]),
    (guarded, [(1.0,)]),
    (guarded_inside, [(X4, -5.0)]),
    (named_as_in_c, [(3.7,), (-3.2,)]),
    (guarded_by_name, [(1.0,)]),
    (guarded_at_length, [(1.0,)]),
    (negative_indices, [(X4, 0), (X4, 1), (X4, 3)]),
    (part_of, [(P3, X4)]),
    (block_given_away, [(P3,)]),
    (swapped, [(X4,)]),
    (widened, [(4,), (0,)]),
    (signed, [(4,), (0,)]),
    (loops, [(X4, 4), (X4, 9), (X4, 0)]),
    (kept_over_rounds, [(X4,)]),
    (declared_in_branches, [(4.0,), (-9.0,)]),
    (made, [(X4,)]),
    (below_the_diagonal, [(P3,), (P3[:1, :1].copy(),), (P3[:2, :2].copy(),)]),
    (computed, [(X4,)]),
    (negated, [(X4,)]),
    (computed_and_named, [(X4,)]),
    (part_of_what_is_computed, [(X4,)]),
    (computed_in_a_record, [(X4,)]),
    (computed_and_passed_on, [(X4,)]),
    (made_and_aliased, [(X4,)]),
    (whole_arrays, [(abs(X4), np.zeros(4))]),
    (record, [(Pair(1.5, Pair(2.5, 3.5)), 4.0)]),
    (shapes, [(P3, X4)]),
    (constants, [(0,), (2,)]),
    (calls, [(X4,)]),
    (given_functions, [(SCALED, X4[:2].copy())]),
    (one_after_another, [(SCALED, X4[:2].copy())]),
    (known_and_done, [(X4,)]),
    (whole_among_reals, [(X4, 7), (X4, 2)]),
    (many_rows, [(MANY, np.zeros((100, 1)))]),
]
