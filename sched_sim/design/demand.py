"""Demand of the dual-rate filter over windows of a cycle, as exact quotients over whole arrays.

A window of c steps offers c HR periods of processor time; the work that must be done in it, divided by c, is the
HR period (in ticks) that it takes at least.
"""

from __future__ import annotations

from operator import index
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.design.pieces import DualRateCosts

Ints: TypeAlias = npt.NDArray[np.int64]
"""An array of integers: int64, or (dtype=object, which types do not tell apart) Python's, which cannot overflow."""

Flags: TypeAlias = npt.NDArray[np.bool_]


class Quotient(NamedTuple):
    """Elementwise numerator / denominator (denominators positive), with a code that says where it comes from."""

    numerator: Ints
    denominator: Ints
    code: Ints

    def exceeds(self, other: Quotient) -> Flags:
        return self.numerator * other.denominator > other.numerator * self.denominator


def quotient(numerator: Ints, denominator: Ints | int, code: int) -> Quotient:
    """An array over an array or a number."""
    return Quotient(numerator, 0 * numerator + denominator, np.full(numerator.shape, code))


def whole_numbers(values: npt.ArrayLike) -> Ints:
    """An array of some integer type, or of Python's integers. Raises TypeError for what is no whole number."""
    array = np.asarray(values)
    if array.dtype.kind not in "iu":
        array = np.asarray(np.frompyfunc(index, 1, 1)(array), dtype=object)
    return array


def choose(condition: Flags, yes: Quotient, no: Quotient) -> Quotient:
    """`yes` where the condition holds, else `no`."""
    return Quotient(*(np.where(condition, a, b) for a, b in zip(yes, no, strict=True)))


def largest(*quotients: Quotient) -> Quotient:
    """The elementwise maximum; the first of equals."""
    result = quotients[0]
    for quotient in quotients[1:]:
        result = choose(quotient.exceeds(result), quotient, result)
    return result


def smaller(first: Quotient, second: Quotient) -> Quotient:
    return choose(first.exceeds(second), second, first)


class DualRateDemand(NamedTuple):
    """Work of the HR and LR jobs of one cycle. Steps are counted from k; costs in ticks.

    separate: LR jobs have a processor of their own.
    """

    costs: DualRateCosts[int]
    N: Ints
    M: Ints
    separate: bool

    @property
    def _zero(self) -> Ints:
        """Zeros of the arrays' own type, so that what is added to them cannot overflow if they cannot."""
        return 0 * self.N

    @property
    def _restart_or_hr(self) -> tuple[Ints, Ints]:
        return self._zero + self.costs.hr_restart, self._zero + self.costs.hr

    def hr_job(self, step: Ints | int) -> Ints:
        """The HR job of one step, without the HR update."""
        return self._zero + np.where((step == 1) | (self.N == 1), *self._restart_or_hr)

    def longest_hr_job(self) -> Ints:
        """The longest HR job of the cycle, without the HR update."""
        restart, hr = self._restart_or_hr
        return np.where(self.N == 1, restart, np.maximum(restart, hr))

    def hr_work(self, first: Ints | int, end: Ints | int) -> Ints:
        """All HR jobs of steps first .. end-1 without HR updates, 0 <= first <= end <= N."""
        c = self.costs
        steps: Ints = np.subtract(end, first)
        once = self._zero + (np.less_equal(first, 1) & np.greater(end, 1))
        restarts: Ints = np.where(self.N == 1, steps, once)
        return steps * c.hr + restarts * (c.hr_restart - c.hr)

    def before_lr(self, steps: Ints | int) -> Ints:
        """HR work that LR jobs have to wait for between k and the start of step k + `steps` (at least 1)."""
        return self.hr_job(0) if self.separate else self.hr_work(0, steps)

    @property
    def lr_early(self) -> int:
        """LR work before the update: propagate, and the gain if it is precomputed."""
        return self.costs.lr_propagate + self.costs.lr_gain

    def update_window(self, end: Ints, code: int, more: Ints | int = 0) -> Quotient:
        """The LR update, and `more`, between m and the start of step `end`."""
        hr = self._zero if self.separate else self.hr_work(self.M, end)
        return quotient(hr + self.costs.lr_update + more, end - self.M, code)

    def total_window(self, end: Ints, code: int, more: Ints | int = 0) -> Quotient:
        """All LR work, and `more`, between k and the start of step `end`."""
        return quotient(self.before_lr(end) + self.lr_early + self.costs.lr_update + more, end, code)

    def propagate_window(self, code: int, more: Ints | int = 0) -> Quotient:
        """LR propagate (and gain) between k and m; nothing where m = k."""
        M = np.maximum(self.M, 1)
        work = np.where(self.M == 0, self._zero, self.before_lr(M) + self.lr_early + more)
        return quotient(work, M, code)

    def first_end(self, period: Ints, scale: Ints | int = 1) -> Ints:
        """The first step by whose start all LR work is done, at an HR period of `period / scale` ticks; it may lie
        beyond N. The period must be enough for every HR job, and no HR update runs between k and then."""
        c, M = self.costs, self.M
        update, total = c.lr_update * scale, (self.lr_early + c.lr_update) * scale
        if self.separate:
            first = self.hr_job(0) * scale
            done: Ints = np.maximum(M + self._steps(update, period), self._steps(first + total, period))
            return done
        slack = period - c.hr * scale
        saved = (c.hr_restart - c.hr) * scale
        by_update = M + self._steps(update + saved * (self._zero + (M <= 1)), slack)
        end: Ints = np.maximum(np.maximum(by_update, self._steps(total + saved, slack)), 2)
        within_first = (M == 0) & (period - self.hr_job(0) * scale >= total)
        return np.where(within_first, 1, end)

    def _steps(self, work: Ints | int, slack: Ints) -> Ints:
        """How many steps it takes to do `work` when each leaves `slack`: at least one; more than N if it never ends."""
        ceiling = -(-work // np.maximum(slack, 1))
        never = self.N + 1
        return np.where(slack > 0, np.maximum(ceiling, 1), np.where(np.less_equal(work, 0), 1, never))
