"""One filter on the simulated processor, each execution of a piece of its jobs with a cost of its own.

The source of the jobs knows constant costs. Here each piece's is another power of a base, so that the work of a job
says how often each piece runs in it; in its place the job gets what is drawn for these executions.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from functools import partial

from sched_sim.costs.table import CostTable
from sched_sim.design.hr_loop import HrSource
from sched_sim.design.method import CostOf
from sched_sim.design.methods import METHODS
from sched_sim.design.options import Options
from sched_sim.design.pieces import JobCosts, converted, works
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.schedule.jobs import Job, Source, Then
from sched_sim.schedule.outcome import Schedule
from sched_sim.schedule.processor import Platform, Processor
from sched_sim.schedule.tasks import Task, TaskSource
from sched_sim.ticks import to_ticks

BASE = 2**32
"""More executions of one piece than there are in any job."""

NO_TABLE = CostTable("no table", "mark", {})

Draw = Callable[[], int]
"""What the next execution of a piece costs, in ticks."""


@dataclass(frozen=True)
class CostsBy(CostOf):
    """What a job of some kind costs where it is not in the table, or is something else."""

    known: Mapping[str, Fraction]

    def __call__(self, kind: str) -> Fraction:
        return self.known[kind] if kind in self.known else super().__call__(kind)

    def has(self, kind: str) -> bool:
        return kind in self.known or super().has(kind)


def marks(method: str, kinds: Sequence[str], options: Options, table: CostTable = NO_TABLE) -> JobCosts[int]:
    """The pieces of a method, that of the kind with number i being BASE**i. table: which `InputError` names where there
    is no kind that it needs."""
    known = {kind: Fraction(BASE**number) for number, kind in enumerate(kinds)}
    return converted(METHODS[method].pieces(CostsBy(table, method, "minimum", known), options), int)


def kinds_by_piece(method: str, kinds: Sequence[str], options: Options, table: CostTable) -> dict[str, str | None]:
    """By the name of each piece, the kind of job that it is, of these kinds; None for a piece that does not run.

    Raises InputError as `marks` does, and for a method whose pieces are no jobs.
    """
    pieces = marks(method, kinds, options, replace(table, costs={}))
    found: dict[str, str | None] = {}
    names = [piece.name for piece in fields(pieces) if piece.name != "lacks"]
    for name, work in zip(names, works(pieces), strict=True):
        counts = executions(work, kinds)
        if [count for _, count in counts] not in ([], [1]):
            raise InputError(
                f"{option('method')} {method}: what its jobs take is computed from differences of costs, and of random "
                f"ones there are none: choose another method"
            )
        found[name] = counts[0][0] if counts else None
    return found


def executions(work: int, kinds: Sequence[str]) -> list[tuple[str, int]]:
    """How often each kind runs in a job of this work, by `marks`; without those that do not."""
    counts = []
    for kind in kinds:
        work, count = divmod(work, BASE)
        if count:
            counts.append((kind, count))
    return counts


class DrawnSource(Source):
    """The jobs of a source whose costs are `marks`, with costs that are drawn."""

    def __init__(self, source: HrSource, draws: Mapping[str, Draw]) -> None:
        self.source = source
        self.draws = draws
        self.kinds = tuple(draws)
        self.next_release = source.next_release

    def release(self) -> tuple[Job, ...]:
        jobs = tuple(map(self._drawn, self.source.release()))
        self.next_release = self.source.next_release
        return jobs

    def at_horizon(self) -> tuple[Job, ...]:
        return self.source.at_horizon()

    def _drawn(self, job: Job) -> Job:
        job.parts = tuple((label, self._cost(work)) for label, work in job.parts)
        job.remaining = sum(work for _, work in job.parts)
        if job.then is not None:
            job.then = partial(self._then, job.then)
        return job

    def _then(self, then: Then, job: Job, now: int) -> tuple[Job, ...]:
        return tuple(map(self._drawn, then(job, now)))

    def _cost(self, work: int) -> int:
        return sum(self.draws[kind]() for kind, count in executions(work, self.kinds) for _ in range(count))


@dataclass(frozen=True)
class DrawnRun:
    """What came of it. schedule: of the processor; achieved: how many corrections landed at each L, of all `cycles`."""

    schedule: Schedule
    achieved: Counter[int]
    cycles: int


def run_drawn(
    method: str,
    draws: Mapping[str, Draw],
    timing: Timing,
    speed: Fraction,
    resolution: int,
    cycles: int,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
) -> DrawnRun:
    """So many measurement cycles, and one more, in which the last ones may still land.

    draws: by kind of job, of all kinds that the method runs with. speed: cost units per HR period; resolution: ticks in
    a cost unit.
    """
    achieved: Counter[int] = Counter()

    def landed(cycle: int, L: int) -> None:
        if cycle < cycles:
            achieved[L] += 1

    period = to_ticks(speed, resolution)
    source = METHODS[method].source(marks(method, tuple(draws), options), timing, options, period, landed)
    of_tasks = [TaskSource(task, speed, resolution) for task in tasks]
    platform = Platform(options.cpus, to_ticks(options.context_switch, resolution), options.policy)
    steps = timing.taken.step(cycles) + max(timing.L, timing.N)
    processor = Processor([DrawnSource(source, draws), *of_tasks], period, steps * period, platform)
    processor.run()
    return DrawnRun(processor.schedule(), achieved, cycles)
