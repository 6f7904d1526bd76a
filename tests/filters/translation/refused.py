"""Functions that are refused, each with why; the line that is to blame says so."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray


def product(A: FloatArray) -> FloatArray:
    return A @ A  # call matmul or matvec


def recursive(n: int) -> int:
    return recursive(n - 1) if n > 0 else 0  # recursive calls itself; write a loop


def behind_its_loop(x: FloatArray) -> float:
    for i in range(len(x)):
        x[i] = 0.0
    return x[i]  # is used behind its loop


def list_of_numbers(x: FloatArray) -> float:
    return sum([2.0 * value for value in x])  # a list comprehension is not translated; write a loop


def shape_not_known(n: int) -> FloatArray:
    return np.zeros(n)  # the shape of an array must be known


def out_of_range(x: FloatArray) -> float:
    return x[4]  # the index is 4, of an axis of 4


def changed_shape(x: FloatArray) -> float:
    y = x
    y = x[1:]  # another shape
    return y[0]


def maybe_never_assigned(x: FloatArray) -> float:
    if x[0] > 0.0:
        return y  # noqa: F821  # y is not known
    return 0.0


def kept_from_round_to_round(x: FloatArray) -> float:
    before = x
    for _ in range(3):
        total = before[0]
        before = np.array([total, 1.0, 2.0, 3.0])  # kept from one round of the loop to the next
    return before[0]


def by_name(x: float) -> float:
    return helper(x, scale=2.0)  # by position


def helper(x: float, scale: float) -> float:
    return x * scale


def caught(x: float) -> float:
    try:  # try is not translated; ask with if
        return 1.0 / x
    except ZeroDivisionError:
        return 0.0


def strings(x: float) -> str:
    return f"{x}"  # an f-string is not translated


def with_step(x: FloatArray) -> float:
    return x[::2][0]  # slices without a step


def sorted_numbers(x: FloatArray) -> FloatArray:
    return np.sort(x)  # this call is not translated


def part_of_its_own(x: FloatArray) -> FloatArray:
    own = 2.0 * x
    part = own[1:]
    part[0] = x[0]
    return part  # returns part of an array of its own; return a copy of the part


def one_of_flag_and_number(x: float) -> float:
    return x > 0.0 and x  # and, or of numbers and other things; use if and else


def one_of_computed(x: float) -> float:
    return np.sqrt(x) or 0.5  # must have a name; give it one first


def number_then_array(x: FloatArray) -> float:
    y: Any = 0.0
    if x[0] > 1.0:
        y = x  # y gets another kind of value, or another shape, than before
    return y + 1.0  # type: ignore[no-any-return]


def parameter_made_real(n: float) -> float:
    n = n * 0.5  # n is a parameter; give the new value another name
    return n + 1.0


def known_parameter_changed(x: float) -> float:
    return changed(x, 3)


def changed(x: float, n: int) -> float:
    n = n - 1
    return x * n


def clipped(x: float) -> float:
    return np.clip(x, 0.0, 1.0)  # write min(max(x, least), most)


def rounded(x: float) -> int:
    return round(x)  # int(np.rint(x))


def one_or_other(x: float) -> float:
    return np.where(x > 0.0, x, 1.0)  # write a if condition else b


def largest_of_three(x: float) -> float:
    return max(x, 1.0, 2.0)  # write max(a, max(b, c))


def assigned_within(x: float) -> float:
    return (y := x) + y  # :=, is not translated; assign in a line of its own


def one_too_many(x: float) -> float:
    return helper(x, x, x)  # helper has 2 parameters


class Scale(NamedTuple):
    by: float

    def times(self, x: float) -> float:
        return self.by * x


SCALE = Scale(2.0)


def by_method(x: float) -> float:
    return SCALE.times(x)  # Scale.times is a method; write a def outside the class


X = np.array([1.0, 2.0, 3.0, 4.0])
P = np.eye(3)

REFUSED: list[tuple[Any, tuple[Any, ...]]] = [
    (product, (P,)),
    (behind_its_loop, (X,)),
    (list_of_numbers, (X,)),
    (shape_not_known, (3,)),
    (out_of_range, (X,)),
    (changed_shape, (X,)),
    (maybe_never_assigned, (X,)),
    (kept_from_round_to_round, (X,)),
    (by_name, (1.0,)),
    (caught, (1.0,)),
    (strings, (1.0,)),
    (with_step, (X,)),
    (sorted_numbers, (X,)),
    (part_of_its_own, (X,)),
    (one_of_flag_and_number, (1.0,)),
    (one_of_computed, (1.0,)),
    (recursive, (3,)),
    (one_too_many, (1.0,)),
    (by_method, (1.0,)),
    (number_then_array, (X,)),
    (parameter_made_real, (3,)),
    (clipped, (1.0,)),
    (rounded, (1.0,)),
    (one_or_other, (1.0,)),
    (largest_of_three, (1.0,)),
    (assigned_within, (1.0,)),
]
