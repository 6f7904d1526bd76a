"""Operations of a job by kind."""

from __future__ import annotations

from collections.abc import Mapping

ARITHMETIC = ("multiply", "add", "divide", "sqrt", "function")
"""Kinds of floating-point operation. A subtraction is an add; a function is sin, cos, exp and the like."""
OPERATION_KINDS = (*ARITHMETIC, "logic")
"""logic: what the arithmetic needs around it: loads, stores, index arithmetic, comparisons, branches."""

Counts = Mapping[str, int]
"""How often one job does each kind of operation."""


def arithmetic(counts: Counts) -> int:
    """Floating-point operations in `counts`, each counted once whatever its kind; logic is none."""
    return sum(number for kind, number in counts.items() if kind in ARITHMETIC)
