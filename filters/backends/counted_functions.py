"""What functions of single numbers count as, NumPy's and those of `math`."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any, Literal, TypeAlias

import numpy as np

from filters.backends.counted_scalar import Scalar, plain

Kind: TypeAlias = Literal["function", "sqrt", "multiply", "nothing", "question"]
"""question: its answer is a truth value, which is not counted."""

_OTHER_THAN_FUNCTIONS: dict[str, Kind] = {
    "sqrt": "sqrt",
    **dict.fromkeys(("degrees", "radians", "deg2rad", "rad2deg"), "multiply"),
    **dict.fromkeys(("floor", "ceil", "trunc", "rint", "fabs", "sign", "copysign", "heaviside"), "nothing"),
    **dict.fromkeys(("isnan", "isinf", "isfinite", "signbit"), "question"),
}
_BY_OPERATORS = frozenset(
    {
        *(
            "absolute",
            "add",
            "subtract",
            "multiply",
            "divide",
            "floor_divide",
            "remainder",
            "divmod",
            "power",
            "square",
        ),
        *("reciprocal", "negative", "positive", "conjugate", "maximum", "minimum", "fmax", "fmin"),
        *("equal", "not_equal", "less", "less_equal", "greater", "greater_equal"),
        *("logical_and", "logical_or", "logical_xor", "logical_not"),
    }
)
_OF_MATH = (
    *("acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cos", "cosh", "sin", "sinh", "tan", "tanh", "hypot"),
    *("exp", "exp2", "expm1", "log10", "log1p", "log2", "sqrt", "cbrt", "erf", "erfc", "gamma", "lgamma"),
    *("fmod", "remainder", "degrees", "radians", "ceil", "floor", "trunc", "fabs", "copysign"),
    *("isfinite", "isinf", "isnan"),
)


@cache
def elementwise(function: np.ufunc) -> Callable[..., Any] | None:
    """The version of a NumPy function of single numbers that counts, also for arrays with some that count.

    None if it is no such function of floats, or one that NumPy puts down to operators where numbers are objects.
    """
    of_floats = any("d" in types for types in function.types)
    if function.nout != 1 or function.signature or not of_floats or function.__name__ in _BY_OPERATORS:
        return None
    kind = _kind(function.__name__)
    each = np.frompyfunc(_counted(function, kind), function.nin, 1)
    return _asking(each) if kind == "question" else each


def _kind(name: str) -> Kind:
    return _OTHER_THAN_FUNCTIONS.get(name, "function")


def _counted(function: Callable[..., Any], kind: Kind) -> Callable[..., Any]:
    """The function of numbers of which some may count."""

    def version(*arguments: Any) -> Any:
        with np.errstate(all="ignore"):
            result = function(*map(plain, arguments))
        tally = next((each.tally for each in arguments if isinstance(each, Scalar)), None)
        if tally is None or kind == "question":
            return result
        if kind != "nothing":
            setattr(tally, kind, getattr(tally, kind) + 1)
        return Scalar(float(result), tally)

    return version


def _asking(each: Callable[..., Any]) -> Callable[..., Any]:
    def version(*arguments: Any, **options: Any) -> Any:
        answers = each(*arguments, **options)
        return answers.astype(bool) if isinstance(answers, np.ndarray) else answers

    return version


def _log(x: Any, base: Any = None) -> Any:
    """With a base it is log(x) / log(base)."""
    log = _counted(math.log, "function")
    return log(x) if base is None else log(x) / log(base)


OF_MATH: dict[Any, Callable[..., Any]] = {
    **{function: _counted(function, _kind(name)) for name in _OF_MATH for function in [getattr(math, name)]},
    math.log: _log,
    math.pow: lambda base, exponent: base**exponent,
}

# NumPy's functions call the methods of their own name where numbers are objects: in code that is not cloned too.
for _name in dir(np):
    _function = getattr(np, _name)
    if isinstance(_function, np.ufunc) and _function.__name__ == _name and elementwise(_function) is not None:
        setattr(Scalar, _name, _counted(_function, _kind(_name)))
