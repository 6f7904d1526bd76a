"""What a schedule of rotations costs on P processors.

The unit of time is that of one 2 x 1 column pair of a rotation: 6 floating-point operations. Cosine and sine of a
rotation take 8 units: a square root and divisions take longer than multiplies and adds.
"""

from __future__ import annotations

from collections.abc import Iterable

from filters.robust.parallel import Schedule

OPERATIONS_PER_UNIT = 6
UNITS_PER_ROTATION = 8


def time_units(schedule: Schedule, P: int) -> int:
    """T_P: in every stage, first all rotations are found, then all column pairs updated, P at a time.

    Raises:
        ValueError: P < 1.
    """
    _check_processors(P)
    return sum(
        UNITS_PER_ROTATION * _rounds(len(stage), P) + _rounds(pairs, P)
        for stage, pairs in zip(schedule.stages, schedule.updates, strict=True)
    )


def span_units(schedule: Schedule) -> int:
    """T_inf: the time when there is a processor for everything.

    max(T_1 / P, T_inf) <= T_P <= T_1 / P + T_inf (Brent 1974).
    """
    return len(schedule.stages) * (UNITS_PER_ROTATION + 1)


def flops(schedule: Schedule, P: int) -> int:
    """T_P as a number of operations that one processor does in the same time.

    Raises:
        ValueError: P < 1.
    """
    return OPERATIONS_PER_UNIT * time_units(schedule, P)


def back_substitution_flops(n: int, P: int) -> int:
    """Operations in sequence for the last n unknowns with n + 1 right-hand sides: one unknown after the other.

    An unknown of all right-hand sides is divided by its pivot, then multiplied and taken from the rows above.

    Raises:
        ValueError: P < 1.
    """
    _check_processors(P)
    sides = n + 1
    return sum(_rounds(sides, P) + 2 * _rounds(above * sides, P) for above in range(n))


def step_flops(schedule: Schedule, n: int, processors: Iterable[int]) -> dict[int, int]:
    """By number of processors P: operations in sequence of a robust step with n states, a number for a cost table.

    Rotations and back substitution; the time to move data between processors is left out.

    Raises:
        ValueError: a P < 1.
    """
    return {P: flops(schedule, P) + back_substitution_flops(n, P) for P in processors}


def _rounds(tasks: int, P: int) -> int:
    return -(-tasks // P)


def _check_processors(P: int) -> None:
    if P < 1:
        raise ValueError(f"P={P} must be at least 1: it is a number of processors")
