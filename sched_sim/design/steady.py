"""Runs a schedule until it is known that no deadline is ever missed: until what is left to do at the start of a
hyperperiod returns.

Costs are constant and releases periodic, so the schedule is a function of its state; once a state returns, all that
comes has been seen (J. Y.-T. Leung and M. L. Merrill, A note on preemptive scheduling of periodic, real-time tasks,
1980, for tasks alone; here jobs also release one another, and a fixed number of hyperperiods would prove nothing).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil

from sched_sim.bounds import MOST_IN_FLIGHT, MOST_JOBS_TO_REPEAT, short
from sched_sim.design.common_period import common_period
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.simulate import in_ticks
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.schedule.jobs import Job, RecurringSource, Source
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.outcome import Schedule
from sched_sim.schedule.processor import Processor
from sched_sim.schedule.tasks import Task

LONGEST = 200_000
"""HR periods until the last task has started, and from there until all repeats, that are simulated at the most."""

MOST_NAMED = 10
"""Tasks, in a message."""

FEWEST = 20_000
"""HR periods that are simulated at the least before a schedule is said not to repeat."""

LOOK = 64
"""HR periods from one look for a miss to the next."""


@dataclass(frozen=True, slots=True)
class Steady:
    """A schedule from its start until it repeats, a deadline is missed, or it was given up.

    steps: HR periods that were simulated. repeats: no deadline is missed, however long it runs: what is left to do has
    returned, so that all has been seen. Where it does not and nothing was missed, work piles up slowly.
    """

    schedule: Schedule
    steps: int
    repeats: bool


def run_until_steady(
    costs: Costs,
    timing: Timing,
    speed: Fraction,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    at_most: int | None = None,
) -> Steady:
    """The schedule that `simulate` runs, for as many HR periods as it takes, but not more than `at_most`, by default
    `longest_run`; a miss may be seen LOOK periods late.

    costs, speed: as for `simulate`. Raises InputError as `simulate` and `longest_run` do.
    """
    longest = longest_run(timing, tasks)
    achieved: Counter[int] = Counter()
    run = in_ticks(costs, timing, speed, options, tasks)
    period, sources = run.period, (run.source(lambda _cycle, L: achieved.update((L,))), *run.tasks)
    hyperperiod = hyperperiod_steps(timing, tasks) * period
    watch = Watch(sources, period, hyperperiod)
    horizon = min(at_most or longest, longest) * period
    processor = Processor([watch, *sources], period, horizon, run.platform)
    watch.processor = processor
    processor.run()
    schedule = replace(processor.schedule(), achieved=achieved)
    return Steady(schedule, processor.horizon // period, watch.repeats)


def hyperperiod_steps(timing: Timing, tasks: Sequence[Task]) -> int:
    """HR periods after which measurements and tasks are released together again as they were."""
    return common_period(timing.taken.steps, [task.period for task in tasks])


def longest_run(timing: Timing, tasks: Sequence[Task]) -> int:
    """HR periods to simulate before a schedule is said not to repeat: until the last task has started and the first
    correction of several in flight is due, and six hyperperiods. Raises InputError where one of them is longer than
    LONGEST, or they release too many jobs."""
    flight = max(timing.M, timing.L)
    if flight > max(LONGEST, timing.N) or flight > MOST_IN_FLIGHT * timing.N:
        raise InputError(
            f"L={flight} with N={timing.N} is more than is simulated to find the least speed, {LONGEST} HR periods and "
            f"{MOST_IN_FLIGHT} measurements on their way at once: look at one speed with `sched-sim simulate --speed`"
        )
    hyperperiod, started = hyperperiod_steps(timing, tasks), max((ceil(task.start) for task in tasks), default=0)
    if started > LONGEST:
        last = max(tasks, key=lambda task: task.start)
        raise InputError(
            f"task {last.name!r}: offset {float(last.start):g} is more than the {LONGEST} HR periods that are "
            f"simulated: give one below its period, {float(last.period):g}"
        )
    if hyperperiod > LONGEST and not tasks:
        raise InputError(
            f"N={timing.N} is more than the {LONGEST} HR periods that are simulated where context switches take time, "
            f"or the earliest deadline comes first: leave out {option('context_switch')} and {option('policy')} (what "
            f"is left has a closed form), or look at one speed with `sched-sim simulate --speed`"
        )
    if hyperperiod > LONGEST:
        periods = [f"{task.name} {float(task.period):g}" for task in tasks]
        if len(periods) > MOST_NAMED:
            periods[MOST_NAMED:] = ["..."]
        raise InputError(
            f"the tasks repeat together with the measurements only after {short(hyperperiod)} HR periods: round their "
            f"periods ({', '.join(periods)}) down to a common grid "
            f"with N={timing.N}, or look at one speed with `sched-sim simulate --speed`"
        )
    started += flight if flight > timing.N else 0
    once = started + hyperperiod
    check_simulation(once, tasks, f"the {once} HR periods until the tasks repeat", MOST_JOBS_TO_REPEAT)
    return started + max(6 * hyperperiod, FEWEST)


class Watch(Source):
    """Releases nothing: looks at the processor before others release, and ends the run when all has been seen.

    States are compared by R. P. Brent's rule (An improved Monte Carlo factorization algorithm, 1980): each with the
    last one whose number, counted from one, is a power of two.
    """

    def __init__(self, sources: Sequence[RecurringSource], period: int, hyperperiod: int) -> None:
        self.sources = sources
        self.processor: Processor
        self.look = LOOK * period
        self.hyperperiod = hyperperiod
        self.next_release = self.boundary = 0
        self.repeats = False
        self.states = 0
        self.kept: Hashable = None

    def release(self) -> tuple[Job, ...]:
        now, processor = self.next_release, self.processor
        missed = processor.overdue(now)
        if now == self.boundary:
            self.boundary += self.hyperperiod
            self.repeats = not missed and self._returned(now)
        if self.repeats or missed:
            processor.end(now)
        self.next_release = min(now + self.look, self.boundary)
        return ()

    def at_horizon(self) -> tuple[Job, ...]:
        return ()

    def _returned(self, now: int) -> bool:
        state = self.processor.state(now), tuple(source.state(now) for source in self.sources)
        if state == self.kept:
            return True
        self.states += 1
        if self.states.bit_count() == 1:
            self.kept = state
        return False
