"""Which entries of the matrices of a model are always zero, or always one, and what that says of their products."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

ZERO, ONE, ANY = "0", "1", "*"

Pattern: TypeAlias = tuple[str, ...]
"""A row of characters for each row of a matrix: "0" is always zero, "1" always one, "*" may be any number."""


class Structure(NamedTuple):
    """What is the same at all states, inputs and steps: patterns of F (n, n), H (p, n), Q (n, n) and R (p, p).

    A pattern is a row of characters for each row of the matrix: "0" is always zero, "1" always one, "*" may be any
    number. Of a pendulum whose angle is measured: Structure(F=("1*", "*1"), H=("10",), Q=("*0", "0*"), R=("*",)).
    """

    F: Pattern
    H: Pattern
    Q: Pattern
    R: Pattern


def check_structure(name: str, structure: object, states: int, measurements: int) -> Structure:
    """The structure, its rows as strings.

    Raises:
        ValueError: it is none, a pattern has another shape than its matrix, or that of a covariance is not symmetric.
    """
    if not isinstance(structure, Structure):
        raise ValueError(f"{name} is {structure!r:.60}; give a Structure of patterns, or None")
    n, p = states, measurements
    shapes = {"F": (n, n), "H": (p, n), "Q": (n, n), "R": (p, p)}
    for which, (rows, columns) in shapes.items():
        pattern = getattr(structure, which)
        said = f"{which} of {name}"
        if isinstance(pattern, str) or not isinstance(pattern, Sequence) or len(pattern) != rows:
            raise ValueError(f"{said} has not {rows} rows; give a string of {columns} characters for each")
        for i, row in enumerate(pattern):
            if not isinstance(row, str) or len(row) != columns or not set(row) <= {ZERO, ONE, ANY}:
                raise ValueError(f"{said}, row {i}, is {row!r:.60}; give {columns} of the characters 0, 1 and *")
        if which in "QR" and (pattern := tuple(pattern)) != transposed(pattern):
            raise ValueError(f"{said} is not symmetric, and a covariance is")
    return Structure(*(tuple(pattern) for pattern in structure))


def with_losses(structure: Structure) -> Structure:
    """Of the same model where numbers of a measurement may be lost, which leaves rows of zeros in H, see `lossy`."""
    R = (
        "".join(ANY if entry == ONE and i != j else entry for j, entry in enumerate(row))
        for i, row in enumerate(structure.R)
    )
    return structure._replace(H=tuple(row.replace(ONE, ANY) for row in structure.H), R=tuple(R))


def full(rows: int, columns: int) -> Pattern:
    """Of a matrix of which nothing is known."""
    return (ANY * columns,) * rows


def transposed(A: Pattern) -> Pattern:
    return tuple("".join(column) for column in zip(*A, strict=True))


def product(A: Pattern, B: Pattern) -> Pattern:
    """Of A B; sums are not taken to cancel."""
    columns = transposed(B)
    return tuple(
        "".join(_sum([_times(a, b) for a, b in zip(row, column, strict=True)]) for column in columns) for row in A
    )


def total(A: Pattern, B: Pattern) -> Pattern:
    """Of A + B."""
    return tuple("".join(_sum([a, b]) for a, b in zip(*rows, strict=True)) for rows in zip(A, B, strict=True))


def either(A: Pattern, B: Pattern) -> Pattern:
    """Of what may be A or B."""
    return tuple("".join(a if a == b else ANY for a, b in zip(*rows, strict=True)) for rows in zip(A, B, strict=True))


def transition(F: Pattern) -> Pattern:
    """Of Phi_{k->j}, a product of any number of F, Eq. (16)."""
    found, before = F, None
    while found != before:
        found, before = either(found, product(F, found)), found
    return found


def transition_noise(F: Pattern, Q: Pattern) -> Pattern:
    """Of Q_{k->j}, Eq. (18)."""
    found, before = Q, None
    while found != before:
        found, before = either(found, total(product(product(F, found), transposed(F)), Q)), found
    return found


def left_out(pattern: Pattern) -> tuple[int, int]:
    """How many entries are zero, and how many one."""
    return sum(row.count(ZERO) for row in pattern), sum(row.count(ONE) for row in pattern)


def shown(structure: Structure) -> str:
    """The structure as Python, a line for each row."""
    patterns = (
        f"    {name}=(\n" + "".join(f'        "{row}",\n' for row in pattern) + "    ),\n"
        for name, pattern in structure._asdict().items()
    )
    return f"Structure(\n{''.join(patterns)})"


def _times(a: str, b: str) -> str:
    if ZERO in (a, b):
        return ZERO
    return b if a == ONE else a if b == ONE else ANY


def _sum(terms: Sequence[str]) -> str:
    left = [term for term in terms if term != ZERO]
    return ZERO if not left else left[0] if len(left) == 1 else ANY
