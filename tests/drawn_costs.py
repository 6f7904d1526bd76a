"""The simulation of `sched_sim.design` with costs that are drawn, for each execution anew.

Each source is run with costs that are digits of a number, from which it is read how often a job runs each piece; then
each execution is drawn, and the job takes their sum.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from fractions import Fraction
from typing import Any

from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import JobCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.schedule.jobs import Job
from sched_sim.schedule.processor import Platform, Processor
from sched_sim.schedule.tasks import Task, TaskSource

DIGIT = 128
Draw = Callable[[str], int]


@dataclass
class Seen:
    """What came out. landed: L, by cycle; ended: release, end and deadline of each job, by kind and step."""

    landed: dict[int, int] = field(default_factory=dict)
    ended: defaultdict[str, dict[int, tuple[int, int, int]]] = field(default_factory=lambda: defaultdict(dict))

    def missed(self, kind: str, step: int) -> bool:
        """Of a job whose deadline has come."""
        _release, end, deadline = self.ended[kind].get(step, (0, 1, 0))
        return end > deadline

    def responses(self, kind: str) -> Counter[int]:
        return Counter(end - release for release, end, _ in self.ended[kind].values())


def pieces(costs: JobCosts[Any]) -> dict[str, CostDistribution]:
    return {one.name: getattr(costs, one.name) for one in fields(costs) if one.name != "lacks"}


def simulated(
    costs: JobCosts[Any],
    timing: Timing,
    period: int,
    steps: int,
    draw: Draw,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
) -> Seen:
    """One run of so many steps. period: in ticks, each a cost unit."""
    digits = {
        name: DIGIT**number * (law != CostDistribution.certain(0))
        for number, (name, law) in enumerate(pieces(costs).items())
    }
    seen = Seen()

    def redrawn(jobs: tuple[Job, ...]) -> tuple[Job, ...]:
        for job in jobs:
            counts = {name: job.remaining // digit % DIGIT for name, digit in digits.items() if digit}
            job.remaining = sum(draw(name) for name, count in counts.items() for _ in range(count))
            job.parts = ((job.kind, job.remaining),)
            if job.then is not None:
                job.then = following(job.then)
        return jobs

    def following(then: Callable[[Job, int], tuple[Job, ...]]) -> Callable[[Job, int], tuple[Job, ...]]:
        return lambda job, now: redrawn(then(job, now))

    def ended(job: Job, now: int) -> None:
        seen.ended[job.kind][job.step] = job.release, now, job.deadline

    coded: Any = type(costs)(*digits.values())
    source: Any = method_of(coded).source(coded, timing, options, period, seen.landed.__setitem__)
    release = source.release
    source.release = lambda: redrawn(release())
    others = [_drawn_task(task, period, draw) for task in tasks]
    Processor([source, *others], period, steps * period, Platform(options.cpus, 0), None, ended).run()
    return seen


def _drawn_task(task: Task, period: int, draw: Draw) -> TaskSource:
    source: Any = TaskSource(task, Fraction(period), 1)
    release = source.release

    def redrawn() -> tuple[Job, ...]:
        (job,) = release()
        job.remaining = draw(task.name)
        job.parts = ((job.kind, job.remaining),)
        return (job,)

    source.release = redrawn
    return source


def all_runs(laws: Mapping[str, CostDistribution], run: Callable[[Draw], Seen]) -> Iterator[tuple[Fraction, Seen]]:
    """Every outcome of all that is drawn, with its probability."""
    tape: list[tuple[CostDistribution, int]] = []  # of each draw: which value it is
    while True:
        drawn: list[Fraction] = []

        def draw(name: str, drawn: list[Fraction] = drawn) -> int:
            if len(drawn) == len(tape):
                tape.append((laws[name], 0))
            law, number = tape[len(drawn)]
            drawn.append(Fraction(law.probabilities[number]))
            return int(law.values[number])

        seen, share = run(draw), Fraction(1)
        for each in drawn:
            share *= each
        yield share, seen
        while tape and tape[-1][1] + 1 == len(tape[-1][0].values):
            tape.pop()
        if not tape:
            return
        law, number = tape.pop()
        tape.append((law, number + 1))
