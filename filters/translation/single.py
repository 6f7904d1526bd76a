"""Numbers that were chosen for double precision, where the program computes in single."""

from __future__ import annotations

import ast
import math
from collections.abc import Mapping
from typing import Any

from filters.translation.body import Body

RESOLUTION, LEAST, LARGEST = 2.0**-23, 2.0**-126, 2.0**128
"""Of a float: it resolves no smaller share of a number; and between these it has all its digits."""

OWN: Mapping[tuple[str, float], float] = {
    ("ROUNDED", 1e-14): 5e-6,  # as many times the resolution
    ("SINGULAR", 1e-14): 5e-6,
    ("ROUNDING", 1e-15): 5e-7,
    ("ROUNDED_BELOW", 1e-8): 3e-4,  # the root of it
    ("ROUNDING", 1e-8): 3e-4,
    ("SYMMETRIC", 1e-9): 3e-4,
    ("MEAN_TOLERANCE", 1e-24): 1e-10,  # the square of some eighty times the resolution
    ("UNDERFLOWN", 1e-290): 1e-29,  # the least number over the resolution, and some
    ("SHORTEST", 1e-200): 1e-29,
}
"""What stands for thresholds of kernels and filters, by their name and their value in double precision."""


def held(body: Body, node: ast.expr, value: Any, name: str = "") -> Any:
    """A constant as the program has it.

    Raises:
        Untranslatable: single precision has no such number.
    """
    if body.unit.precision == "double" or not isinstance(value, float):
        return value
    if (name, value) in OWN:
        return OWN[name, value]
    if value and math.isfinite(value) and not LEAST <= abs(value) < LARGEST:
        raise body.source.refusal(node, f"single precision has no {value:g}; choose double")
    return value


def check_threshold(body: Body, comparison: ast.Compare) -> None:
    """Raises Untranslatable where something is compared with less than single precision resolves."""
    if body.unit.precision == "double":
        return
    for node in ast.walk(comparison):
        name, value = "", None
        if isinstance(node, ast.Constant):
            value = node.value
        elif isinstance(node, ast.Name) and node.id not in body.names:
            name, value = node.id, _outside(body, node.id)
        if isinstance(value, float) and 0.0 < abs(value) < RESOLUTION and (name, value) not in OWN:
            raise body.source.refusal(
                comparison, f"{value:g} is less than single precision resolves; choose double, or a larger threshold"
            )


def _outside(body: Body, name: str) -> Any:
    try:
        return body.source.value(name)
    except KeyError:
        return None
