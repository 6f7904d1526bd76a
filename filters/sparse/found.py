"""What the structure of a system is: known of a linear one, whose matrices are there; of others what probing finds."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.sparse.structure import ANY, ONE, ZERO, Pattern, Structure, either, transposed
from filters.system import System
from filters.systems.linear import is_linear

PROBES = 200
"""States at which a system is probed."""

SCALES = 0.01, 1.0, 30.0
"""How far from the typical state, as shares of each of its numbers and one."""

STEPS = 1000


def linear_structure(system: System) -> Structure | None:
    """What the matrices of a `linear_system` are in all steps; None of another system."""
    if not is_linear(system):
        return None
    matrices = system.parameters
    F, H, Q, R = (_common(getattr(matrices, name)) for name in ("Phi", "H", "Q", "R"))
    return Structure(F, H, _of_noise(Q), _of_noise(R))


def probed(system: System, x0: FloatArray, seed: int = 0) -> Structure:
    """What is zero, or one, at all of many states and inputs around x0 (n,), drawn at random, and in as many steps.

    That is no proof: what is zero at these may be none elsewhere. States at which a function fails, or gives what is
    not finite, are passed over.

    Raises:
        ValueError: they fail at most of them.
    """
    random = np.random.default_rng(seed)
    seen: list[Structure] = []
    for number in range(PROBES):
        scale = SCALES[number % len(SCALES)]
        x = x0 + scale * (1.0 + np.abs(x0)) * random.normal(size=system.states)
        u = scale * random.normal(size=system.inputs)
        if (found := _at(system, int(random.integers(STEPS)), x, u)) is not None:
            seen.append(found)
    if len(seen) < PROBES // 2:
        raise ValueError(
            f"of {PROBES} states around the typical one the functions of the system fail at {PROBES - len(seen)}, or "
            f"are not finite: its zeros cannot be found by probing; state its structure"
        )
    F, H, Q, R = seen[0]
    for other in seen[1:]:
        F, H, Q, R = either(F, other.F), either(H, other.H), either(Q, other.Q), either(R, other.R)
    return Structure(F, H, _of_noise(Q), _of_noise(R))


def contradiction(stated: Structure, found: Structure) -> str | None:
    """An entry that was found to be another number than is stated, in words; None if there is none."""
    for name, pattern, other in zip(Structure._fields, stated, found, strict=True):
        for i, rows in enumerate(zip(pattern, other, strict=True)):
            for j, (entry, seen) in enumerate(zip(*rows, strict=True)):
                if entry not in (ANY, seen):
                    return f"{name}[{i}, {j}] is not always {entry}"
    return None


def _at(system: System, j: int, x: FloatArray, u: FloatArray) -> Structure | None:
    parameters = system.parameters
    try:
        with np.errstate(all="ignore"):
            matrices = [
                np.array(matrix, dtype=np.float64)
                for matrix in (
                    system.F(j, x, u, parameters),
                    system.H(j, x, parameters),
                    system.Q(j, parameters),
                    system.R(j, parameters),
                )
            ]
    except (ArithmeticError, LookupError, ValueError):
        return None
    if not all(np.isfinite(matrix).all() for matrix in matrices):
        return None
    return Structure(*(_common(matrix[np.newaxis]) for matrix in matrices))


def _common(matrices: FloatArray) -> Pattern:
    """Of matrices (any, rows, columns)."""
    zero, one = (matrices == 0.0).all(axis=0), (matrices == 1.0).all(axis=0)
    return tuple(
        "".join(ZERO if is_zero else ONE if is_one else ANY for is_zero, is_one in zip(*row, strict=True))
        for row in zip(zero, one, strict=True)
    )


def _of_noise(pattern: Pattern) -> Pattern:
    """Symmetric, and a variance of one is any other: it is only added, so that nothing is saved."""
    return tuple(row.replace(ONE, ANY) for row in either(pattern, transposed(pattern)))
