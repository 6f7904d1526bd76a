"""Values of Python as data of a C program."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from filters.translation.data import Data, Kept, number, rounded
from filters.translation.kinds import Record, kind_of
from filters.translation.library import Precision
from filters.translation.prototype import WIDTH
from filters.translation.refusal import Untranslatable
from filters.translation.unit import Unit


class Pair(NamedTuple):
    a: Any
    b: Any


def declared(value: Pair, *, constant: bool = False, without: str = "") -> list[str]:
    data, kind = Data(Unit()), kind_of(value)
    assert isinstance(kind, Record)
    data.record(
        "pair", value, kind, lambda names: None if names[-1] == without else Kept("_".join(names), constant=constant)
    )
    return data.lines


def test_arrays_before_the_record_that_points_at_them() -> None:
    assert declared(Pair(np.array([1.5, -2.0]), 3.0)) == [
        "static real pair_a[2] = {1.5, -2.0};",
        "static const Pair pair = {pair_a, 3.0};",
    ]


def test_one_array_in_two_places_is_one() -> None:
    both = np.zeros((2, 2))
    assert declared(Pair(both, both)) == ["static real pair_a[2][2];", "static const Pair pair = {pair_a, pair_a};"]


def test_constants_are_cast_where_they_are_pointed_at() -> None:
    assert declared(Pair(np.zeros(2), np.eye(2)), constant=True) == [
        "static const real pair_a[2] = {0};",
        "static const real pair_b[2][2] = {",
        "    {1.0, 0.0},",
        "    {0.0, 1.0}",
        "};",
        "static const Pair pair = {(real *)pair_a, (real (*)[2])pair_b};",
    ]


def test_no_two_arrays_have_one_name() -> None:
    class Other(NamedTuple):
        a_b: Any
        a: Any

    data, value = Data(Unit()), Other(np.zeros(1), Pair(np.zeros(2), np.zeros(3)))
    kind = kind_of(value)
    assert isinstance(kind, Record)
    data.record("x", value, kind, lambda names: Kept("_".join(names)))
    assert data.lines[-1] == "static const Other x = {x_a_b, {x_a_a, x_a_b_}};"


def test_what_nothing_needs_takes_no_memory() -> None:
    lines = declared(Pair(np.zeros(2), np.zeros(3)), without="b")
    assert lines == ["static real pair_a[2];", "static const Pair pair = {pair_a, NULL};"]


def test_long_rows_are_broken_between_numbers() -> None:
    data = Data(Unit())
    data.array(Kept("many"), -np.logspace(-20, 20, 50).reshape(2, 25))
    text = "\n".join(data.lines)
    assert max(map(len, text.splitlines())) <= WIDTH
    numbers = text.partition("=")[2].strip(" ;{}").replace("}", "").replace("{", "").split(",")
    assert [float(each) for each in numbers] == list(-np.logspace(-20, 20, 50))
    assert data.sizes == {"many": 50}


@pytest.mark.parametrize(
    ("precision", "value", "text"),
    [
        ("double", 0.1, "0.1"),
        ("double", 1e-300, "1e-300"),
        ("single", 1 / 3, "0.33333334f"),
        ("single", float("inf"), "INFINITY"),
        ("double", -float("inf"), "-(double)INFINITY"),
    ],
)
def test_numbers(precision: Precision, value: float, text: str) -> None:
    assert number(Unit(precision), value, "x") == text


@pytest.mark.parametrize("value", [1e-60, -1e40])
def test_a_number_that_single_precision_does_not_have(value: float) -> None:
    with pytest.raises(Untranslatable, match=r"Q: single precision has no -?1e[-+]\d+; choose double"):
        number(Unit("single"), value, "Q")


def test_what_is_shared_stays_shared_in_single_precision() -> None:
    both = np.array([1 / 3])
    a, b = rounded(Pair(both, both), "single", {})
    assert a is b
    assert a.dtype == np.float32
    assert rounded(both, "double", {}) is both
