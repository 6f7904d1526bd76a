"""Schedules of Givens rotations: which may be done at the same time.

A schedule is made of stages; no two rotations of one stage touch the same row, so that they may all be done at once.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray

Pattern: TypeAlias = NDArray[np.bool_]
"""(N, N + r): True where a matrix of N rows, or one of its r right-hand sides, may differ from zero."""


class Rotation(NamedTuple):
    """Rows `upper` and `lower` are rotated so that `lower` becomes zero in `column`."""

    upper: int
    lower: int
    column: int


class Schedule(NamedTuple):
    """stages: the rotations of each; updates: how many 2 x 1 column pairs the rotations of each stage change.

    rows (N,): after the last stage, row rows[k] of the matrix is row k of the upper triangle.
    """

    stages: tuple[tuple[Rotation, ...], ...]
    updates: tuple[int, ...]
    rows: tuple[int, ...]


def sameh_kuck(N: int, right_hand_sides: int = 0) -> Schedule:
    """2 N - 3 stages for a dense matrix (N, N): neighbouring rows are rotated (Sameh and Kuck 1978).

    The entry in row i and column j < i, both from 0, is annihilated by rows i - 1 and i in stage N - 1 - i + 2 j.

    Raises:
        ValueError: N < 1 or right_hand_sides < 0.
    """
    if N < 1 or right_hand_sides < 0:
        raise ValueError(f"N={N} must be at least 1 and right_hand_sides={right_hand_sides} at least 0")
    stages: list[list[Rotation]] = [[] for _ in range(2 * N - 3)]
    for j in range(N - 1):
        for i in range(j + 1, N):
            stages[N - 1 - i + 2 * j].append(Rotation(i - 1, i, j))
    return Schedule(
        tuple(tuple(stage) for stage in stages),
        tuple(sum(N - rotation.column + right_hand_sides for rotation in stage) for stage in stages),
        tuple(range(N)),
    )


def greedy(pattern: Pattern) -> Schedule:
    """All pairs of rows with the same leading column that there are in every stage, for a pattern (N, N + r).

    Among the rows with the same leading column, the one with fewest entries is paired with the one with most, the
    second with the last but one, and so on; the one with fewer keeps the column. Among equals, the upper row is first.
    Both rows of a pair then have the entries of either. (Greedy schedules of a dense matrix: Modi and Clarke 1984;
    Cosnard, Muller and Robert 1986. The rule of pairing is this project's.)

    Raises:
        ValueError: the pattern has fewer columns than rows.
    """
    entries, N = _checked(pattern)
    stages: list[tuple[Rotation, ...]] = []
    updates: list[int] = []
    while stage := _pairs(entries, _leading(entries, N)):
        stages.append(stage)
        updates.append(sum(_merge(entries, rotation) for rotation in stage))
    rows = np.argsort(_leading(entries, N), kind="stable")
    return Schedule(tuple(stages), tuple(updates), tuple(rows.tolist()))


def pivot_order(pattern: Pattern) -> Schedule:
    """The rotations of the sequential algorithm, each as early as its two rows allow, for a pattern (N, N + r).

    Column by column, every entry below the diagonal is annihilated with the diagonal's row, unless it is zero anyway.
    A row whose pivot is zero changes places with the other. The number of stages is the critical path.

    Raises:
        ValueError: the pattern has fewer columns than rows.
    """
    entries, N = _checked(pattern)
    ready = [0] * N
    stages: list[list[Rotation]] = []
    updates: list[int] = []
    for j in range(N - 1):
        for i in range(j + 1, N):
            if not entries[i, j]:
                continue
            stage = max(ready[i], ready[j])
            ready[i] = ready[j] = stage + 1
            if stage == len(stages):
                stages.append([])
                updates.append(0)
            stages[stage].append(Rotation(j, i, j))
            updates[stage] += _merge(entries, stages[stage][-1])
    return Schedule(tuple(tuple(stage) for stage in stages), tuple(updates), tuple(range(N)))


def execute(schedule: Schedule, A: FloatArray) -> FloatArray:
    """R (N, N + r), upper triangular: A (N, N + r) after all rotations, stage by stage; A is left as it is.

    Every stage reads all its rows before it writes any.

    Raises:
        ValueError: A has another number of rows, is not finite, or has entries that the schedule does not expect.
    """
    N = len(schedule.rows)
    if A.ndim != 2 or len(A) != N or A.shape[1] < N:
        raise ValueError(f"A has shape {A.shape}, the schedule needs ({N}, {N} or more)")
    if not np.isfinite(A).all():
        raise ValueError("A holds a value that is not finite")
    R = np.array(A, dtype=np.float64)
    for stage in schedule.stages:
        _rotate(R, np.array(stage))
    R = R[list(schedule.rows)]
    if np.tril(R, -1).any():
        raise ValueError("A is not made triangular: it has entries where the pattern of the schedule has none")
    return R


def _checked(pattern: Pattern) -> tuple[Pattern, int]:
    """A copy of the pattern, and its number of rows."""
    entries = np.array(pattern, dtype=np.bool_)
    if entries.ndim != 2 or entries.shape[1] < len(entries):
        raise ValueError(f"the pattern has shape {entries.shape}; it needs at least as many columns as rows")
    return entries, len(entries)


def _leading(entries: Pattern, N: int) -> NDArray[np.intp]:
    """The column of the first entry of each row, N for a row without any in the matrix."""
    return np.where(entries[:, :N].any(axis=1), entries[:, :N].argmax(axis=1), N) if N else np.zeros(0, np.intp)


def _pairs(entries: Pattern, leading: NDArray[np.intp]) -> tuple[Rotation, ...]:
    """The rotations of one greedy stage."""
    rows_by_column: dict[int, list[int]] = {}
    for row in np.argsort(entries.sum(axis=1), kind="stable").tolist():
        rows_by_column.setdefault(int(leading[row]), []).append(row)
    rows_by_column.pop(len(entries), None)
    return tuple(
        Rotation(rows[k], rows[-1 - k], column)
        for column, rows in sorted(rows_by_column.items())
        for k in range(len(rows) // 2)
    )


def _merge(entries: Pattern, rotation: Rotation) -> int:
    """Follow one rotation on the pattern, in place; how many column pairs it changes."""
    upper, lower, column = rotation
    either = entries[upper] | entries[lower]
    if entries[upper, column]:
        entries[upper] = entries[lower] = either
    else:
        entries[[upper, lower]] = entries[[lower, upper]]
    entries[lower, column] = False
    return int(either.sum())


def _rotate(R: FloatArray, stage: NDArray[np.intp]) -> None:
    """All rotations (rotations, 3) of a stage, in place. A zero pivot makes the rows change places."""
    upper, lower, column = stage.T
    a, b = R[upper, column], R[lower, column]
    r = np.hypot(a, b)
    c = np.divide(a, r, out=np.zeros_like(a), where=r > 0)[:, np.newaxis]
    s = np.divide(b, r, out=np.ones_like(b), where=r > 0)[:, np.newaxis]
    R[upper], R[lower] = c * R[upper] + s * R[lower], c * R[lower] - s * R[upper]
    R[upper, column], R[lower, column] = r, 0.0
