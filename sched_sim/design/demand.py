"""Demand of the dual-rate filter over windows of a cycle, as exact quotients, of one design or over whole arrays.

A window of c steps offers c HR periods of processor time; the work that must be done in it, divided by c, is the
HR period (in ticks) that it takes at least.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, NamedTuple

from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.whole import Flags, Whole, filled, larger, where


class Quotient(NamedTuple, Generic[Whole]):
    """Elementwise numerator / denominator (denominators positive), with a code that says where it comes from."""

    numerator: Whole
    denominator: Whole
    code: Whole


def quotient(numerator: Whole, denominator: Whole | int, code: int) -> Quotient[Whole]:
    """A number over a number, or an array over either."""
    return Quotient(numerator, 0 * numerator + denominator, filled(numerator, code))


def choose(condition: bool | Flags, yes: Quotient[Whole], no: Quotient[Whole]) -> Quotient[Whole]:
    """`yes` where the condition holds, else `no`."""
    return Quotient(*(where(condition, a, b) for a, b in zip(yes, no, strict=True)))


def exceeds(first: Quotient[Whole], second: Quotient[Whole]) -> bool | Flags:
    return first.numerator * second.denominator > second.numerator * first.denominator


def largest(*quotients: Quotient[Whole]) -> Quotient[Whole]:
    """The elementwise maximum; the first of equals."""
    result = quotients[0]
    for quotient in quotients[1:]:
        result = choose(exceeds(quotient, result), quotient, result)
    return result


def smaller(first: Quotient[Whole], second: Quotient[Whole]) -> Quotient[Whole]:
    return choose(exceeds(first, second), second, first)


@dataclass(frozen=True, slots=True)
class DualRateDemand(Generic[Whole]):
    """Work of the HR and LR jobs of one cycle. Steps are counted from k; costs in ticks.

    separate: LR jobs have a processor of their own.
    """

    costs: DualRateCosts[int]
    N: Whole
    M: Whole
    separate: bool

    @property
    def _zero(self) -> Whole:
        """Zero, of arrays zeros of their own type, so that what is added to them cannot overflow if they cannot."""
        return 0 * self.N

    @property
    def _restart_or_hr(self) -> tuple[Whole, Whole]:
        return self._zero + self.costs.hr_restart, self._zero + self.costs.hr

    def hr_job(self, step: Whole | int) -> Whole:
        """The HR job of one step, without the HR update."""
        return self._zero + where((step == 1) | (self.N == 1), *self._restart_or_hr)

    def longest_hr_job(self) -> Whole:
        """The longest HR job of the cycle, without the HR update."""
        restart, hr = self._restart_or_hr
        return where(self.N == 1, restart, larger(restart, hr))

    def hr_work(self, first: Whole | int, end: Whole) -> Whole:
        """All HR jobs of steps first .. end-1 without HR updates, 0 <= first <= end <= N."""
        c = self.costs
        steps = end - first
        once = self._zero + ((first <= 1) & (end > 1))
        restarts = where(self.N == 1, steps, once)
        return steps * c.hr + restarts * (c.hr_restart - c.hr)

    def before_lr(self, steps: Whole) -> Whole:
        """HR work that LR jobs have to wait for between k and the start of step k + `steps` (at least 1)."""
        return self.hr_job(0) if self.separate else self.hr_work(0, steps)

    @property
    def lr_early(self) -> int:
        """LR work before the update: propagate, and the gain if it is precomputed."""
        return self.costs.lr_propagate + self.costs.lr_gain

    def update_window(self, end: Whole, code: int, more: Whole | int = 0) -> Quotient[Whole]:
        """The LR update, and `more`, between m and the start of step `end`."""
        hr = self._zero if self.separate else self.hr_work(self.M, end)
        return quotient(hr + self.costs.lr_update + more, end - self.M, code)

    def total_window(self, end: Whole, code: int, more: Whole | int = 0) -> Quotient[Whole]:
        """All LR work, and `more`, between k and the start of step `end`."""
        return quotient(self.before_lr(end) + self.lr_early + self.costs.lr_update + more, end, code)

    def propagate_window(self, code: int, more: Whole | int = 0) -> Quotient[Whole]:
        """LR propagate (and gain) between k and m; nothing where m = k."""
        M = larger(self.M, 1)
        work = where(self.M == 0, self._zero, self.before_lr(M) + self.lr_early + more)
        return quotient(work, M, code)

    def first_end(self, period: Whole, scale: Whole | int = 1) -> Whole:
        """The first step by whose start all LR work is done, at an HR period of `period / scale` ticks; it may lie
        beyond N. The period must be enough for every HR job, and no HR update runs between k and then."""
        c, M = self.costs, self.M
        update, total = c.lr_update * scale, (self.lr_early + c.lr_update) * scale
        if self.separate:
            first = self.hr_job(0) * scale
            return larger(M + self._steps(update, period), self._steps(first + total, period))
        slack = period - c.hr * scale
        saved = (c.hr_restart - c.hr) * scale
        by_update = M + self._steps(update + saved * (self._zero + (M <= 1)), slack)
        end = larger(larger(by_update, self._steps(total + saved, slack)), 2)
        after_first = (M > 0) | (period - self.hr_job(0) * scale < total)
        return where(after_first, end, 1)

    def _steps(self, work: Whole | int, slack: Whole) -> Whole:
        """How many steps it takes to do `work` when each leaves `slack`: at least one; more than N if it never ends."""
        ceiling = -(-work // larger(slack, 1))
        never = self.N + 1
        return where(slack > 0, larger(ceiling, 1), where(work > 0, never, 1))
