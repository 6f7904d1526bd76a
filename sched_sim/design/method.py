"""What makes a method: its pieces, its jobs, its work, and which L it can have."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Generic, NamedTuple, TypeVar

from sched_sim.costs.table import CostTable
from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.design.timing import Feedback, Timing, latest, one_at_a_time
from sched_sim.errors import InputError, option


@dataclass(frozen=True)
class CostOf:
    """What a job of some kind of one method costs, by a cost table."""

    table: CostTable
    method: str
    statistic: Statistic

    def __call__(self, kind: str) -> Fraction:
        """Raises InputError for an entry that the table lacks."""
        value: Fraction = getattr(self.table.entry(self.method, kind), self.statistic)
        return value

    def has(self, kind: str) -> bool:
        return self.table.has(self.method, kind)

    def lacks(self, *kinds: str) -> str:
        """What the table has not of these, which several in flight take, in words; empty if nothing."""
        missing = [kind for kind in kinds if not self.has(kind)]
        others = [method for method in ("recalculate", "dual-rate") if method in self.table.costs]
        return lacks_for_several(f"[costs.{self.method}] {', '.join(missing)}", others) if missing else ""


Exact = TypeVar("Exact")
InTicks = TypeVar("InTicks")


class Law(NamedTuple):
    """Which L a method can have: from M + after to N - before; or, with several measurements on their way at once, from
    M + after on.

    only_first: it is M + after, whatever is asked for; undelayed: M is 0; several: M and L may be more than N.
    """

    after: int
    before: int
    only_first: bool
    undelayed: bool = False
    several: bool = False

    def legal(self, N: int, M: int) -> range:
        """Every L, from the earliest to the latest; to `latest` where later ones are possible."""
        first = M + self.after
        return range(first, first + 1 if self.only_first else self.latest(N, M) + 1)

    def latest(self, N: int, M: int) -> int:
        """The L that is meant where none is given: the last one, or what comes nearest to one where there is none; with
        several on their way the last before the first measurement that is taken after this one has arrived."""
        if self.several and not self.only_first:
            return latest(N, M) - self.before
        return max(N - self.before, M)

    def last_of_use(self, N: int, M: int) -> int:
        """A later L asks for no less of the filter alone: with several on their way, an LR update that is not done when
        the next measurement arrives would be behind for ever."""
        if self.several and not self.only_first:
            return N + max(M, 1)
        return self.latest(N, M)

    def last_alone(self, N: int, M: int) -> int | None:
        """The latest L before the next measurement is taken; None if there is none."""
        return N - self.before if M + self.after <= N - self.before else None

    def one_in_flight(self, N: int, L: int) -> bool:
        """Whether a correction has landed before the next measurement is taken, or costs nothing until it does."""
        return self.only_first or N - self.before >= L

    def why_none(self, N: int, M: int, said: str = "") -> str | None:
        """Why no L is left, although other methods have one; None if one is.

        said: N and M as the user gave them, if not in steps.
        """
        if self.several or M + self.after <= N - self.before:
            return None
        if M > N:
            given = said or f"M={M} and N={N}"
            return f"it waits for one measurement at a time, and with {given} others are taken before one arrives"
        given = said or f"M=N={N}"
        return f"with {given} no step is left to it between the measurement's arrival and the next one"


class CycleWork(NamedTuple):
    """Work in N steps. low: that of LR jobs, which have a processor of their own if there are two."""

    high: Fraction
    low: Fraction = Fraction(0)


def lacks_for_several(entries: str, others: Sequence[str] = ()) -> str:
    """That a cost table does not have these, which are needed where M is more than N, and what can be done.

    others: methods that can have that, and that the table has.
    """
    instead = f", or choose {option('method')} {' or '.join(others)}" if others else ""
    return (
        f"where M is more than N, others are measured before one arrives, and for that the cost table has no "
        f"{entries}: use {option('costs')} counted-9-3-3 or a table that `sched-sim measure` writes{instead}"
    )


def no_work(_costs: object, _timing: Timing) -> Fraction:
    return Fraction(0)


def kind_missed(kind: str, _held: bool, _timing: Timing, _options: Options) -> str:
    return kind


@dataclass(frozen=True)
class Method(Generic[Exact, InTicks]):
    """All that is particular to one method, but its filter and its closed form.

    pieces: the record of what they cost, from the costs of its kinds of jobs; source: of its jobs, from costs and HR
    period in ticks; work: in a measurement cycle; law: of L; check: raises InputError for an L that it cannot have;
    lands_in_step_m: its correction is part of the HR job of step m, so that with M = N it comes with the next cycle;
    lacking: what its pieces lack for a timing, in words; None if nothing;
    binding: the demand that a missed job stands for, from its kind and whether it waited for an earlier LR job.
    work_varies: the work of a cycle depends on where it lands; `work` is the least that it can be.
    longest: of the HR jobs, without what lands, where several corrections may be on their way.
    """

    pieces: Callable[[CostOf, Options], Exact]
    source: Callable[[InTicks, Timing, Options, int, OnLanding], HrSource]
    work: Callable[[Exact, Timing], CycleWork]
    law: Callable[[Feedback], Law]
    check: Callable[[Timing, Feedback], None] = lambda _timing, _feedback: None
    lands_in_step_m: bool = False
    binding: Callable[[str, bool, Timing, Options], str] = kind_missed
    work_varies: bool = False
    lacking: Callable[[Exact, Timing], str | None] = lambda _costs, _timing: None
    longest: Callable[[Exact, Timing], Fraction] = no_work

    def check_design(self, costs: Exact, timing: Timing, feedback: Feedback) -> None:
        """Raises InputError for a timing that the method cannot have, or for which its costs lack something."""
        law = self.law(feedback)
        wrong = None if law.several else one_at_a_time(replace(timing, M=0, instants=None) if law.undelayed else timing)
        if wrong:
            raise InputError(wrong)
        self.check(timing, feedback)
        if lacking := self.lacking(costs, timing):
            raise InputError(lacking)
