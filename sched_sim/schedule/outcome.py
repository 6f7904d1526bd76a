"""What a simulated schedule says: response times, misses, preemptions, utilization, achieved l."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from sched_sim.schedule.jobs import Parts


class Slice(NamedTuple):
    """A stretch of uninterrupted execution, [start, end) in ticks; of no length for a job that is unfinished at the
    horizon, or whose work another has done.

    cpu: from 0; kind, step: of the job; begin: work of the job done before this slice, without overhead;
    overhead: ticks at the start of the slice that went into the context switch; parts: of the whole job;
    finished: whether the job finished at `end`; release, deadline: of the job; period: the HR period, in ticks.
    """

    cpu: int
    start: int
    end: int
    kind: str
    step: int
    begin: int
    overhead: int
    parts: Parts
    finished: bool
    release: int
    deadline: int
    period: int

    @property
    def missed(self) -> bool:
        """Whether the deadline was missed by the end of the slice."""
        return self.end > self.deadline or (self.end == self.deadline and not self.finished)

    def pieces(self) -> list[tuple[str, int, int]]:
        """(label, start, end) of what was done in this slice: "switch", then "HRP", "HRU", ..."""
        pieces = [("switch", self.start, self.start + self.overhead)] if self.overhead else []
        at = self.start + self.overhead - self.begin
        for label, work in self.parts:
            start, end = max(at, self.start + self.overhead), min(at + work, self.end)
            if start < end:
                pieces.append((label, start, end))
            at += work
        return pieces


@dataclass(frozen=True, slots=True)
class Response:
    """Figures of all jobs of one kind; times in ticks, of which the schedule's `period` are an HR period.

    releases: how many were released; finished: how many of them by the horizon; worst: the longest response time;
    total: the sum of all response times; misses: deadlines missed; worst_lateness: the longest time after a deadline;
    preemptions: how often one was interrupted by another job.

    A job that is unfinished at the horizon counts in `releases`, and in `misses` and `worst_lateness` if its
    deadline has passed; not in the response times.
    """

    releases: int
    finished: int
    worst: int
    total: int
    misses: int
    worst_lateness: int
    preemptions: int

    @property
    def mean(self) -> Fraction:
        """The mean response time in ticks; 0 if none finished."""
        return Fraction(self.total, self.finished) if self.finished else Fraction(0)


@dataclass(frozen=True, slots=True)
class Schedule:
    """The outcome of a simulation over `horizon` ticks.

    period: the HR period in ticks; busy: ticks in which a job ran, summed over the processors;
    responses: by job kind ("hr", "lr_propagate", "lr_update", "task:NAME", ...);
    first_miss: (kind, whether it waited for an earlier LR job) of the missed job whose deadline was first, if any; of
    several, finished or not, that of the most urgent priority, then of the first release, then of the first name;
    achieved: how many cycles landed at each achieved L;
    instants: how many points in time the simulation visited; slices: if they were asked for.
    """

    period: int
    horizon: int
    cpus: int
    busy: int
    responses: Mapping[str, Response]
    first_miss: tuple[str, bool] | None
    instants: int
    achieved: Counter[int] = field(default_factory=Counter)
    slices: tuple[Slice, ...] = ()

    @property
    def misses(self) -> int:
        """How many deadlines were missed, of all kinds of job."""
        return sum(response.misses for response in self.responses.values())

    @property
    def preemptions(self) -> int:
        """How often a job was interrupted by another."""
        return sum(response.preemptions for response in self.responses.values())

    @property
    def utilization(self) -> Fraction:
        """The busy share of the processors' time, between 0 and 1."""
        return Fraction(self.busy, self.horizon * self.cpus)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:  # noqa: ARG002
        """For a notebook: a Gantt chart above the table, if slices were kept and there is what draws them."""
        return with_chart(self, self._repr_html_())

    def _repr_html_(self) -> str:
        from sched_sim.html_table import html_table

        counts = ", ".join(f"{cycles} at L = {L}" for L, cycles in sorted(self.achieved.items()))
        landed = f"corrections landed: {counts}; " if counts else ""
        headings = ("job", "released", "finished", "worst response", "mean response", "deadlines missed", "preempted")
        rows = [
            (
                kind,
                figures.releases,
                figures.finished,
                Fraction(figures.worst, self.period) if figures.finished else None,
                figures.mean / self.period if figures.finished else None,
                figures.misses,
                figures.preemptions,
            )
            for kind, figures in self.responses.items()
        ]
        return html_table(
            f"{self.horizon / self.period:g} HR periods, busy {float(self.utilization):.1%}; {landed}responses in HR "
            f"periods",
            headings,
            rows,
        ) + ("" if self.slices else HINT)


HINT = "<p>Simulated with <code>keep_slices=True</code> it is shown as a Gantt chart.</p>"


def with_chart(schedule: Schedule, table: str) -> dict[str, str]:
    """By media type, as a notebook asks for it; nothing where there is no chart. table: what stands below, as HTML."""
    from sched_sim.shown import drawing

    draw = drawing("Schedule") if schedule.slices else None
    return {} if draw is None else {"text/html": draw(schedule, table)}
