"""Which (N, M, L) of a grid are legal, counted and found by arithmetic: the whole product is never in memory."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.bounds import MOST_IN_FLIGHT
from sched_sim.design.method import Law
from sched_sim.design.steady import LONGEST
from sched_sim.errors import InputError, option

Ints: TypeAlias = npt.NDArray[Any]

SLAB = 256
"""So many values of N are expanded at a time."""

LONGEST_OPEN = 1_000_000
"""The largest N of which every M is looked at."""

MOST_DESIGNS = 1 << 61
"""What is counted, and what is counted with, stays below: no int64 overflows."""


class Designs(NamedTuple):
    """N, M and L of some designs: three arrays of one length."""

    N: Ints
    M: Ints
    L: Ints


class _Pairs(NamedTuple):
    """Legal (N, M), each with the position (in the axis; the value if there is none) of its first L, and how many.

    per_n: how many pairs each N has."""

    N: Ints
    M: Ints
    first: Ints
    choices: Ints
    per_n: Ints


class Legal:
    """The legal designs of an N, an M and an L axis under one law, in order of N, M, L.

    The axes are sorted; None instead of M or L stands for every legal value, with several measurements on their way at
    once for every M with which there need not be, and for every L up to `Law.latest`.
    size: how many there are. left_out: how many combinations of the given values have none.
    simulated: M and L are no more than is simulated to find the least speed.
    Raises InputError for what has too many.
    """

    def __init__(
        self,
        law: Law,
        N: Sequence[int],
        M: Sequence[int] | None,
        L: Sequence[int] | None,
        simulated: bool = False,
    ) -> None:
        _check_size(N, M, L)
        self.law = law
        self.simulated = simulated
        self.N = np.array(N, dtype=np.int64)
        wanted_M = _undelayed(M) if law.undelayed else M
        self.M = None if wanted_M is None else np.array(wanted_M, dtype=np.int64)
        self.L = None if L is None else np.array(L, dtype=np.int64)
        per_n = []
        kept = 0
        for begin in range(0, self.N.size, SLAB):
            pairs = self._pairs(begin, begin + SLAB)
            total = np.concatenate([[0], np.cumsum(pairs.choices)])
            ends = np.cumsum(pairs.per_n)
            per_n.append(total[ends] - total[ends - pairs.per_n])
            kept += self._kept(pairs, self.N[begin : begin + SLAB])
        self._before = np.concatenate([[0], np.cumsum(np.concatenate(per_n))])
        self.size = int(self._before[-1])
        combinations = self.N.size * (1 if M is None else len(M)) * (1 if L is None else len(L))
        self.left_out = combinations - kept

    def designs(self, start: int, stop: int) -> Designs:
        """Those at the positions start .. stop-1, 0 <= start < stop <= size."""
        first = int(np.searchsorted(self._before, start, "right")) - 1
        pairs = self._pairs(first, int(np.searchsorted(self._before, stop, "left")))
        ends = self._before[first] + np.cumsum(pairs.choices)
        p, q = np.searchsorted(ends, [start, stop - 1], "right")
        wanted = slice(p, q + 1)
        begins = ends[wanted] - pairs.choices[wanted]
        repeats = np.minimum(ends[wanted], stop) - np.maximum(begins, start)
        position = np.repeat(pairs.first[wanted] - begins, repeats) + np.arange(start, stop)
        L = position if self.L is None else self.L[position]
        return Designs(np.repeat(pairs.N[wanted], repeats), np.repeat(pairs.M[wanted], repeats), L)

    def _pairs(self, begin: int, end: int) -> _Pairs:
        """The pairs of N[begin:end] that have at least one legal L."""
        after, before, several = self.law.after, self.law.before, self.law.several
        N = self.N[begin:end]
        last = N - before
        if self.L is not None and several:
            last = np.minimum(last, self.L[-1]) if self.M is None else np.full_like(N, self.L[-1])
        elif self.L is not None:
            below = np.searchsorted(self.L, last, "right")
            last = np.where(below > 0, self.L[below - 1], -1)
        elif several and self.M is not None:
            last = np.full_like(N, self.M[-1] + after)
        largest_M = last - after
        per_n = np.maximum(largest_M + 1, 0) if self.M is None else np.searchsorted(self.M, largest_M, "right")
        within = np.arange(per_n.sum()) - np.repeat(np.cumsum(per_n) - per_n, per_n)
        M = within if self.M is None else self.M[within]
        first = M + after
        if self.L is not None:
            first = np.searchsorted(self.L, first, "left")
            up_to = self.L.size if several else np.repeat(np.searchsorted(self.L, last, "right"), per_n)
            count = up_to - first
        elif self.law.only_first:
            count = np.ones_like(first)
        else:
            N_of_pair = np.repeat(N, per_n)
            latest = (M // N_of_pair + 1) * N_of_pair if several else N_of_pair
            count = latest - before - first + 1
        pairs = _Pairs(np.repeat(N, per_n), M, first, count, per_n)
        return self._within(pairs) if self.simulated else pairs

    def _within(self, pairs: _Pairs) -> _Pairs:
        """Those whose M and L are no more than is simulated."""
        most = longest_flight(pairs.N)
        up_to = most + 1 if self.L is None else np.searchsorted(self.L, most, "right")
        choices = np.where(most < pairs.M, 0, np.minimum(pairs.choices, up_to - pairs.first))
        kept = choices > 0
        ends = np.concatenate([[0], np.cumsum(kept)])
        last = np.cumsum(pairs.per_n)
        per_n = ends[last] - ends[last - pairs.per_n]
        return _Pairs(pairs.N[kept], pairs.M[kept], pairs.first[kept], choices[kept], per_n)

    def _kept(self, pairs: _Pairs, N: Ints) -> int:
        """How many combinations of the given values have a legal design."""
        if self.M is not None:
            return int(pairs.choices.sum()) if self.L is not None else pairs.M.size
        if self.L is None:
            return int(np.count_nonzero(pairs.per_n))
        below = np.searchsorted(self.L, N - self.law.before, "right")
        if self.law.several:
            most = np.searchsorted(self.L, longest_flight(N), "right") if self.simulated else self.L.size
            below = np.where(pairs.per_n > 0, most, 0)
        return int(np.maximum(below - np.searchsorted(self.L, self.law.after, "left"), 0).sum())


def longest_flight(N: Ints) -> Ints:
    """The largest M and L of which the least speed is found by simulation (`steady.longest_run`)."""
    most: Ints = np.minimum(np.maximum(LONGEST, N), MOST_IN_FLIGHT * N)
    return most


def _check_size(N: Sequence[int], M: Sequence[int] | None, L: Sequence[int] | None) -> None:
    if M is None and N[-1] > LONGEST_OPEN:
        raise InputError(
            f"N={N[-1]} with every M from 0 to N is too many: give {option('M')}, or N up to {LONGEST_OPEN:,}"
        )
    largest = max(N[-1], *(axis[-1] for axis in (M, L) if axis is not None), 0)
    if largest >= MOST_DESIGNS:
        raise InputError(f"{largest} steps are too many in a grid: give N, M and L below {MOST_DESIGNS:.2g}")
    designs = len(N) * prod(N[-1] + 1 if axis is None else len(axis) for axis in (M, L))
    if designs >= MOST_DESIGNS:
        raise InputError(
            f"a grid of up to {designs:.2g} designs is too large: give fewer values of N, {option('M')} and "
            f"{option('L')}"
        )


def _undelayed(M: Sequence[int] | None) -> Sequence[int]:
    return [0] if M is None or 0 in M else []
