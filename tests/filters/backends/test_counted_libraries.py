"""Whatever a counted function calls of NumPy, of `math` or of another library: all is counted, or refused."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from math import sin
from typing import Any

import numpy as np
import pytest
import scipy.linalg as sl
from numpy import zeros

from filters.backends.counted import Operations, count
from filters.backends.uncountable import UncountableError

X = np.array([0.3, 0.4])
TABLE = np.diag([1.0, 2.0])


def taylor(x: Any) -> Any:
    A = np.zeros((2, 2))
    A[0, 1], A[1, 0] = x[0], -x[1]
    return A @ A


def of_table(x: Any) -> Any:
    A = TABLE.copy()
    A[0, 1] = x[0]
    return A @ A


def imported_inside(x: Any) -> Any:
    import math as inside

    return inside.sin(x[0])


def filled(A: Any, x: Any) -> Any:
    np.fill_diagonal(A, x[0])
    return A @ A


@pytest.mark.parametrize(
    ("function", "counted"),
    [
        (lambda x: math.sin(x[0]) * sin(x[1]) * sin(1.0), Operations(multiply=2, function=2)),
        (imported_inside, Operations(function=1)),
        (lambda x: float(x[1]) * 2.0 * 3.0, Operations(multiply=2)),
        (lambda x: np.float64(x[0]) * 2.0, Operations(multiply=1)),
        (lambda x: np.float64(x) * 2.0, Operations(multiply=2)),
        (lambda x: x.astype(np.float64) * 2.0, Operations(multiply=2)),
        (lambda x: x.astype(float) * 2.0, Operations(multiply=2)),
        (lambda x: np.array([x[0], 1.0], dtype=float) * 2.0, Operations(multiply=1)),
        (lambda x: np.array([x[0], 1.0], np.float64) * x[0], Operations(multiply=2)),
        (lambda x: zeros(2, dtype="float64") * x, Operations(multiply=2)),
        (lambda x: x[0] * 2.0 if isinstance(x[0], float) else 0.0, Operations(multiply=1)),
        (lambda x: np.linalg.norm(x), Operations(multiply=2, add=1, sqrt=1)),
        (lambda x: np.linalg.inv(TABLE) @ x, Operations(multiply=4, add=2)),
        (lambda x: sl.expm(0.1 * TABLE) @ x, Operations(multiply=4, add=2)),
        (lambda x: np.interp(0.5, [0.0, 1.0], [1.0, 2.0]) * x, Operations(multiply=2)),
        (lambda x: np.finfo(np.float64).eps * x[0], Operations(multiply=1)),
        (taylor, Operations(multiply=6, add=4)),
        (of_table, Operations(multiply=4, add=3)),
        (lambda x: filled(np.zeros((2, 2)), x), Operations(multiply=6, add=4)),
        (lambda x: np.add.reduce(x) + np.multiply.outer(x, x)[0, 0], Operations(multiply=4, add=2)),
        (lambda x: x[~np.isnan(x)] * 2.0, Operations(multiply=2)),
        (lambda x: np.hypot(1.0, x) + np.log1p(x), Operations(add=2, function=4)),
        (lambda x: np.sign(x[0]) * 2.0, Operations(multiply=1)),
    ],
)
def test_all_is_counted(function: Callable[[Any], Any], counted: Operations) -> None:
    assert count(lambda functions, x: functions[0](x), (function,), X) == counted


@pytest.mark.parametrize(
    ("function", "what"),
    [
        (lambda x: 2.0 * np.linalg.inv(np.diag(x)), r"np.linalg.inv\(np.diag\(x\)\)"),
        (lambda x: np.linalg.solve(np.eye(2), x), r"np.linalg.solve\(np.eye\(2\), x\)"),
        (lambda x: np.interp(x[0], [0.0, 1.0], [1.0, 2.0]), "np.interp"),
        (lambda x: sl.expm(TABLE * x[0]), r"sl.expm\(TABLE \* x\[0\]\)"),
        (lambda x: x.astype("f8"), r"x.astype\(.f8.\)"),
        (lambda x: math.fsum(x), r"math.fsum\(x\)"),
        (lambda x: cmath.exp(x[0]), r"cmath.exp\(x\[0\]\)"),
        (lambda x: TABLE[int(x[0])], r"int\(x\[0\]\)"),
        (lambda x: round(x[0], 2), r"round\(x\[0\], 2\)"),
        (lambda x: 1j * x[0], r"1j \* x\[0\]"),
        (lambda x: divmod(x[0], 2.0), r"divmod\(x\[0\], 2.0\)"),
        (lambda x: x[0].item(), r"x\[0\].item"),
    ],
)
def test_the_rest_is_refused_by_name(function: Callable[[Any], Any], what: str) -> None:
    with pytest.raises(
        UncountableError, match=f"^a lambda in test_counted_libraries.py, line .*: {what}.* cannot be counted"
    ):
        count(lambda functions, x: functions[0](x), (function,), X)


def test_nothing_outside_is_touched() -> None:
    count(of_table, X)
    assert TABLE.dtype == np.float64
    assert taylor(X).dtype == np.float64
    assert type(sin(1.0)) is float
