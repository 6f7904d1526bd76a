"""The simulated preemptive processor: immediate preemption, exact integer time.

At one instant, finishes come first, then releases, then dispatch: a job that finishes exactly at its deadline has met
it, and an LR update that finishes exactly at the start of step j is applied in step j. A job without work finishes as
it is dispatched, and where a finish makes it the next, that is before the releases of the instant. The ready queues
are our own, because SimPy's `PreemptiveResource` lets a release preempt a job that finishes at that same instant.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Generator, Hashable, Sequence
from heapq import heapify, heappop, heappush, heappushpop, heapreplace
from itertools import chain
from typing import NamedTuple

import simpy
from simpy.events import NORMAL, EventCallbacks

from sched_sim.schedule.jobs import Job, Source
from sched_sim.schedule.outcome import Response, Schedule, Slice
from sched_sim.schedule.policy import RANKS, Policy

OnSlice = Callable[[Slice], None]
OnFinish = Callable[[Job, int], None]
"""Called with each job that finishes, and when."""


class Platform(NamedTuple):
    """How jobs run. cpus: how many processors; context_switch: in ticks; policy: which job each of them runs."""

    cpus: int
    context_switch: int
    policy: Policy = "fixed"


class Cpu:
    """One processor: the jobs that are ready, the one that runs, and the one that ran last.

    ready: a heap of (rank, order of release, job); entry: that of the running job;
    since: when it was dispatched; finish: when it will finish if nothing preempts it; busy: ticks it has run.
    """

    __slots__ = ("busy", "entry", "finish", "last", "number", "ready", "running", "since")

    def __init__(self, number: int) -> None:
        self.number = number
        self.ready: list[tuple[int, int, Job]] = []
        self.running: Job | None = None
        self.entry: tuple[int, int, Job]
        self.last: Job | None = None
        self.since = self.finish = self.busy = 0


class Tally:
    """The running figures of one job kind; see `Response`."""

    __slots__ = ("finished", "misses", "preemptions", "releases", "total", "worst", "worst_lateness")

    def __init__(self) -> None:
        self.releases = self.finished = self.worst = self.total = 0
        self.misses = self.worst_lateness = self.preemptions = 0

    def frozen(self) -> Response:
        return Response(**{name: getattr(self, name) for name in self.__slots__})


class Processor:
    """Runs the jobs of `sources` from time 0 to `horizon`; all times in ticks."""

    def __init__(
        self,
        sources: Sequence[Source],
        period: int,
        horizon: int,
        platform: Platform,
        on_slice: OnSlice | None = None,
        on_finish: OnFinish | None = None,
    ) -> None:
        self.sources = sources
        self.period = period
        self.horizon = horizon
        self.cpus = tuple(Cpu(number) for number in range(platform.cpus))
        self.context_switch = platform.context_switch
        self.rank = RANKS[platform.policy]
        self.on_slice = on_slice
        self.on_finish = on_finish
        self.tallies: defaultdict[str, Tally] = defaultdict(Tally)
        self.first_miss: tuple[int, int, int, str, bool] | None = None
        self.instants = 0
        self._environment: simpy.Environment | None = None

    def run(self) -> None:
        """To the horizon."""
        environment = self._environment or self._begun()
        environment.run(until=self._ended)

    def advance(self, until: int) -> None:
        """To this instant before the horizon, of which nothing is done yet; later than the one reached before."""
        environment = self._environment or self._begun()
        environment.run(until=until)

    def _begun(self) -> simpy.Environment:
        environment = self._environment = simpy.Environment()
        self._ended = environment.event()
        instant = environment.timeout(0)
        callbacks: EventCallbacks = []
        timeline = self._timeline(environment, instant, callbacks)
        next(timeline)
        callbacks.append(timeline.send)
        instant.callbacks = callbacks
        return environment

    def end(self, now: int) -> None:
        """Makes this instant the last: what is released and dispatched in it does not run."""
        self.horizon = now
        self._ended.succeed()

    def state(self, now: int) -> Hashable:
        """The unfinished jobs, in the order in which they will go on: all that the schedule from `now` on depends on,
        beside the sources. To be asked before the releases of an instant."""
        return tuple(
            (
                cpu.running
                and cpu.running.state(now, cpu.finish - now, max(cpu.running.overhead - now + cpu.since, 0)),
                tuple(job.state(now, job.remaining, job.overhead) for _, _, job in sorted(cpu.ready)),
            )
            for cpu in self.cpus
        )

    def overdue(self, now: int) -> bool:
        """Whether a job has missed its deadline, finished or not."""
        waiting = (job for cpu in self.cpus for _, _, job in cpu.ready)
        running = (cpu.running for cpu in self.cpus if cpu.running is not None)
        return self.first_miss is not None or any(job.deadline <= now for job in chain(waiting, running))

    def _timeline(
        self,
        environment: simpy.Environment,
        instant: simpy.Event,
        callbacks: EventCallbacks,
    ) -> Generator[None, simpy.Event | None, None]:
        """Waits from one instant at which something happens to the next.

        One generator with its state in local names and no small methods: this loop is what every simulated second
        costs. `instant` is scheduled anew each time, and resumes it itself: a `simpy.Process` that waits for new events
        would take half as long again.
        """
        schedule = environment.schedule
        horizon, cpus = self.horizon, self.cpus
        tallies, on_slice, on_finish = self.tallies, self.on_slice, self.on_finish
        context_switch, rank = self.context_switch, self.rank
        releases = [(source.next_release, order, source) for order, source in enumerate(self.sources)]
        heapify(releases)
        release, order, source = heappop(releases)  # the next one; the heap has those of the other sources
        order_of_release = now = instants = 0
        next_finish = -1
        yield
        while True:
            while now == next_finish:  # 1. finishes
                for cpu in cpus:
                    if cpu.finish != now or cpu.running is None:
                        continue
                    job, cpu.running = cpu.running, None
                    cpu.busy += now - cpu.since
                    piece = None if on_slice is None else self._slice(job, cpu.since, now, finished=True)
                    finished = (job, *job.companions) if job.companions else (job,)
                    if job.then is not None:
                        following = job.then(job, now)
                        if job in following:
                            finished = ()
                        for new in following:
                            order_of_release += 1
                            heappush(cpus[new.cpu].ready, (rank(new), order_of_release, new))
                    if on_slice is not None and piece is not None:
                        on_slice(piece if finished else piece._replace(finished=False))
                    for done in finished:
                        tally = tallies[done.kind]
                        tally.finished += 1
                        response = now - done.release
                        tally.total += response
                        if response > tally.worst:
                            tally.worst = response
                        if now > done.deadline:
                            self._missed(done, now)
                        if on_slice is not None and done is not job:
                            on_slice(self._slice(done, now, now, finished=True))
                        if on_finish is not None:
                            on_finish(done, now)
                next_finish = -1
                for cpu in cpus:  # jobs without work that are next
                    if cpu.ready and cpu.running is None and not (context_switch or cpu.ready[0][2].remaining):
                        cpu.entry = heappop(cpu.ready)
                        cpu.running = cpu.entry[2]
                        cpu.since = cpu.finish = next_finish = now
            if now == horizon:
                self.instants = instants
                self._ended.succeed()
                yield
            while release == now:  # 2. releases
                for new in source.release():
                    order_of_release += 1
                    heappush(cpus[new.cpu].ready, (rank(new), order_of_release, new))
                release, order, source = heappushpop(releases, (source.next_release, order, source))
            until = release if release < horizon else horizon
            for cpu in cpus:  # 3. dispatch
                ready, running = cpu.ready, cpu.running
                if ready and (running is None or (running.preemptive and ready[0][0] < cpu.entry[0])):
                    if running is None:
                        cpu.entry = heappop(ready)
                    else:
                        ran = now - cpu.since
                        if on_slice is not None:
                            on_slice(self._slice(running, cpu.since, now, finished=False))
                        if running.overhead:
                            overhead = min(ran, running.overhead)
                            running.overhead -= overhead
                            running.remaining += overhead
                        running.remaining -= ran
                        cpu.busy += ran
                        tallies[running.kind].preemptions += 1
                        cpu.entry = heapreplace(ready, cpu.entry)
                    running = cpu.running = cpu.entry[2]
                    if context_switch and running is not cpu.last:
                        running.overhead += context_switch
                        cpu.last = running
                    cpu.since = now
                    cpu.finish = now + running.remaining + running.overhead
                if running is not None and cpu.finish <= until:
                    next_finish = until = cpu.finish
            instants += 1
            instant.callbacks = callbacks
            schedule(instant, NORMAL, until - now)
            yield
            now = until

    def _missed(self, job: Job, now: int) -> None:
        tally = self.tallies[job.kind]
        tally.misses += 1
        tally.worst_lateness = max(tally.worst_lateness, now - job.deadline)
        this = job.deadline, job.priority, job.release, job.kind, job.held
        if self.first_miss is None or this < self.first_miss:
            self.first_miss = this

    def schedule(self) -> Schedule:
        """The outcome, once `run` has reached the horizon; unfinished jobs are counted as they stand, and each has
        a last slice, of no length, there."""
        unfinished = [job for cpu in self.cpus for _, _, job in cpu.ready]
        unfinished += [job for source in self.sources for job in source.at_horizon()]
        for cpu in self.cpus:
            if cpu.running is not None:
                cpu.busy += self.horizon - cpu.since
                piece = self._slice(cpu.running, cpu.since, self.horizon, finished=False)
                cpu.running.remaining -= piece.end - piece.start - piece.overhead
                if self.on_slice is not None:
                    self.on_slice(piece)
                unfinished.append(cpu.running)
        for waiting in [each for job in unfinished for each in (job, *job.companions)]:
            if self.on_slice is not None:
                self.on_slice(self._slice(waiting, self.horizon, self.horizon, finished=False))
            self.tallies[waiting.kind].releases += 1
            if waiting.deadline <= self.horizon:
                self._missed(waiting, self.horizon)
        for tally in self.tallies.values():
            tally.releases += tally.finished
        return Schedule(
            period=self.period,
            horizon=self.horizon,
            cpus=len(self.cpus),
            busy=sum(cpu.busy for cpu in self.cpus),
            responses={kind: tally.frozen() for kind, tally in sorted(self.tallies.items())},
            first_miss=self.first_miss[3:] if self.first_miss else None,
            instants=self.instants,
        )

    def _slice(self, job: Job, start: int, end: int, *, finished: bool) -> Slice:
        """What `job` did on its processor from its dispatch until now; called before the work is booked."""
        return Slice(
            cpu=job.cpu,
            start=start,
            end=end,
            kind=job.kind,
            step=job.step,
            begin=sum(work for _, work in job.parts) - job.remaining,
            overhead=min(job.overhead, end - start),
            parts=job.parts,
            finished=finished,
            release=job.release,
            deadline=job.deadline,
            period=self.period,
        )
