"""Numbers that were chosen for double precision, where the program computes in single."""

from __future__ import annotations

import ast
import math
from collections.abc import Collection, Mapping
from typing import Any

from filters.translation.source import Source

RESOLUTION, LEAST, LARGEST = 2.0**-23, 2.0**-126, 2.0**128
"""Of a float: it resolves no smaller share of a number; and between these it has all its digits."""

OWN: Mapping[tuple[str, float], float] = {
    ("ROUNDED", 1e-14): 5e-6,  # as many times the resolution
    ("SINGULAR", 1e-14): 5e-6,
    ("ROUNDING", 1e-15): 5e-7,
    ("ROUNDED_BELOW", 1e-8): 3e-4,  # the root of it
    ("ROUNDING", 1e-8): 3e-4,
    ("SYMMETRIC", 1e-9): 3e-4,
    ("SMALL", 1e-8): 3e-4,  # a squared angle, the square of which is below the resolution
    ("MEAN_TOLERANCE", 1e-24): 1e-10,  # the square of some eighty times the resolution
    ("UNDERFLOWN", 1e-290): 1e-29,  # the least number over the resolution, and some
    ("SHORTEST", 1e-200): 1e-29,
}
"""What stands for thresholds of kernels and filters, by their name and their value in double precision."""


def held(source: Source, node: ast.expr, value: Any, name: str = "") -> Any:
    """A constant as a program of floats has it.

    Raises:
        Untranslatable: there is no such float.
    """
    if not isinstance(value, float):
        return value
    if (name, value) in OWN:
        return OWN[name, value]
    if value and math.isfinite(value) and not LEAST <= abs(value) < LARGEST:
        raise source.refusal(node, f"single precision has no {value:g}; choose double")
    return value


def check_threshold(source: Source, comparison: ast.Compare, local: Collection[str]) -> None:
    """local: the names that are the function's own.

    Raises:
        Untranslatable: something is compared with less than single precision resolves.
    """
    for node in ast.walk(comparison):
        name, value = "", None
        if isinstance(node, ast.Constant):
            value = node.value
        elif isinstance(node, ast.Name) and node.id not in local:
            name, value = node.id, _outside(source, node.id)
        if isinstance(value, float) and 0.0 < abs(value) < RESOLUTION and (name, value) not in OWN:
            raise source.refusal(
                comparison, f"{value:g} is less than single precision resolves; choose double, or a larger threshold"
            )


def _outside(source: Source, name: str) -> Any:
    try:
        return source.value(name)
    except KeyError:
        return None
