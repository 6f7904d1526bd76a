"""What makes a method: its pieces, its jobs, its work, and which L it can have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Generic, NamedTuple, TypeVar

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.options import Options
from sched_sim.design.timing import Feedback, Timing

CostOf = Callable[[str], Fraction]
"""What a job of this kind costs, by a cost table."""

Exact = TypeVar("Exact")
InTicks = TypeVar("InTicks")


class Law(NamedTuple):
    """Which L a method can have: from M + after to N - before.

    only_first: it is M + after, whatever is asked for; undelayed: M is 0.
    """

    after: int
    before: int
    only_first: bool
    undelayed: bool = False

    def legal(self, N: int, M: int) -> range:
        """Every L, from the earliest to the latest."""
        first = M + self.after
        return range(first, first + 1 if self.only_first else N - self.before + 1)

    def latest(self, N: int, M: int) -> int:
        """The last L, or what comes nearest to one where there is none."""
        return max(N - self.before, M)

    def why_none(self, N: int, M: int) -> str | None:
        """Why no L is left, although other methods have one; None if one is."""
        if M + self.after <= N - self.before:
            return None
        return f"with M=N={N} no step is left to it between the measurement's arrival and the next one"


class CycleWork(NamedTuple):
    """Work in N steps. low: that of LR jobs, which have a processor of their own if there are two."""

    high: Fraction
    low: Fraction = Fraction(0)


def kind_missed(kind: str, _held: bool, _timing: Timing, _options: Options) -> str:
    return kind


@dataclass(frozen=True)
class Method(Generic[Exact, InTicks]):
    """All that is particular to one method, but its filter and its closed form.

    pieces: the record of what they cost, from the costs of its kinds of jobs; source: of its jobs, from costs and HR
    period in ticks; work: in a measurement cycle; law: of L; check: raises InputError for an L that it cannot have;
    lands_in_step_m: its correction is part of the HR job of step m, so that with M = N it comes with the next cycle;
    binding: the demand that a missed job stands for, from its kind and whether it waited for an earlier LR job.
    work_varies: the work of a cycle depends on where it lands; `work` is the least that it can be.
    """

    pieces: Callable[[CostOf, Options], Exact]
    source: Callable[[InTicks, Timing, Options, int, OnLanding], HrSource]
    work: Callable[[Exact, Timing], CycleWork]
    law: Callable[[Feedback], Law]
    check: Callable[[Timing, Feedback], None] = lambda _timing, _feedback: None
    lands_in_step_m: bool = False
    binding: Callable[[str, bool, Timing, Options], str] = kind_missed
    work_varies: bool = False
