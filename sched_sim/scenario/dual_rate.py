"""The jobs of the dual-rate filter of several sensors, any delays, any order of arrival.

Every step releases a predict job at its start, due at the start of the next step: the high-rate task, with the state
and the transition from the last measurement, which starts anew in the step after one. Each measurement that is taken
has two low-rate jobs, both due at the start of step k + land_by:

    gain      released when the predict job of k has finished: the covariance, carried on from the step in which one was
              taken before, of several taken in one step once, and with it the gain
    correct   released at the start of the step in which it arrives; it runs after its gain job

All low-rate jobs have one priority and run one after another, first in, first out; what waits for a gain job joins the
queue with it. The correction is in the state of the first step at whose start its correct job has finished: that step
is the achieved l. Its predict job has the work of the landing too, `hr_update`, and `hr_pass` for each measurement
taken since: in a later step before l, or in k by a sensor behind. One of these that has been corrected, and lands with
it, is told what it did not expect, `lr_correct`.

A measurement that never arrives is known to be lost in step k + land_by. Then a job, `loss`, is due in land_by steps
more: its gain without what is lost, and all from there on again, the covariance from step to step and for each
measurement the gain, or where it has landed what its gain, that has been used, leaves of the covariance. Nothing lands
of it.

With one sensor and none in flight together this is `design.dual_rate` with precomputed gain. The work is that of
`filters.modular.dual_rate_in_flight`, which lands in k + L however early the correct job has finished.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import islice

from sched_sim.scenario.draws import total, words
from sched_sim.scenario.kinds import correct_kind, gain_kind, loss_kind
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.source import Measurement
from sched_sim.schedule.jobs import Job, Parts, Source, Then


@dataclass(slots=True, eq=False)
class Knot:
    """A measurement that is taken: its step, and the number of its sensor.

    first: of those of its step. queued: its gain job has joined the queue; waiting: jobs that join with it. corrected:
    it has arrived, and its correct job has finished. landed: it is in the state, or known to be lost.
    """

    step: int
    sensor: int
    first: bool
    queued: bool = False
    waiting: list[Job] = field(default_factory=list)
    corrected: bool = False
    landed: bool = False


class DualRateFilter(Source):
    """Releases the jobs; `period` (the HR period) and `costs`, by part, in ticks.

    taken, dropped: measurements so far, by the number of the sensor; pending: arrived, and their correct job not
    finished. knots: from the first on that has not landed. landing: corrected, and not in the state yet. restarts: one
    was taken in the last step. queue: low-rate jobs behind the one that is under way, if it is busy.
    """

    def __init__(self, scenario: Scenario, costs: Mapping[str, Sequence[int]], period: int) -> None:
        self.scenario = scenario
        self.sensors = scenario.sensors
        self.costs = costs
        self.period = period
        self.step = 0
        self.next_release = 0
        self.taken = [0] * len(self.sensors)
        self.dropped = [0] * len(self.sensors)
        self.pending: list[Measurement] = []
        self.priority = self.sensors[0].priority
        self.lr_cpu = scenario.cpus - 1
        self.measurements = [sensor.measurements(scenario.steps, scenario.seed) for sensor in self.sensors]
        self.following = [next(measurements, None) for measurements in self.measurements]
        self.hr_stream = words(scenario.seed, "predictor cost")
        self.streams = [words(scenario.seed, f"{sensor.name} cost") for sensor in self.sensors]
        self.arrivals: defaultdict[int, list[Knot]] = defaultdict(list)  # by step
        self.losses: defaultdict[int, list[Knot]] = defaultdict(list)  # by the step in which they are known
        self.knots: deque[Knot] = deque()
        self.landing: list[Knot] = []
        self.queue: deque[Job] = deque()
        self.busy = False
        self.restarts = False

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        parts = [("HRP", total(self.costs["hr_restart" if self.restarts else "hr_propagate"], self.hr_stream))]
        if self.landing:
            parts.append(("HRU", self._land()))
        knots = self._take(step)
        self.restarts = bool(knots)
        work = sum(time for _, time in parts)
        then = partial(self._release_gains, knots) if knots else None
        predict = Job("predict", step, self.scenario.priority, start, self.next_release, work, tuple(parts), then)
        for knot in self.losses.pop(step, ()):
            self._queue_behind(knot, self._loss(knot, start))
        for knot in sorted(self.arrivals.pop(step, ()), key=_order):
            self._queue_behind(knot, self._correct(knot, start))
        return (predict, *self._next())

    def at_horizon(self) -> tuple[Job, ...]:
        return (*self.queue, *(job for knot in self.knots for job in knot.waiting))

    def _take(self, step: int) -> list[Knot]:
        """Those taken in this step, in the sensors' order."""
        knots: list[Knot] = []
        for number, sensor in enumerate(self.sensors):
            following = self.following[number]
            if following is None or following[0] != step:
                continue
            self.following[number] = next(self.measurements[number], None)
            self.taken[number] += 1
            knot = Knot(step, number, first=not knots)
            knots.append(knot)
            if following[1] is None:
                self.dropped[number] += 1
                self.losses[step + sensor.land_by].append(knot)
            else:
                self.arrivals[step + following[1]].append(knot)
        self.knots += knots
        return knots

    def _land(self) -> int:
        """The work of what lands, in the order in which it was taken."""
        work = 0
        for knot in sorted(self.landing, key=_order):
            work += total(self.costs["hr_update"], self.hr_stream)
            for other in self._behind(knot):
                work += self._draw_high_rate("hr_pass", other)
                if other.corrected and not other.landed:
                    work += self._draw_high_rate("lr_correct", other)
            knot.landed = True
        self.landing.clear()
        self._forget()
        return work

    def _forget(self) -> None:
        """What has landed, with all that was taken before."""
        while self.knots and self.knots[0].landed:
            self.knots.popleft()

    def _behind(self, knot: Knot) -> Iterator[Knot]:
        """Those taken since."""
        return islice(self.knots, self.knots.index(knot) + 1, None)

    def _release_gains(self, knots: Sequence[Knot], _predict: Job, now: int) -> tuple[Job, ...]:
        """The message of the predict job of their step is there."""
        for knot in knots:
            parts = [("LRP", self._draw("lr_propagate", knot, knot))] if knot.first else []
            parts.append(("LRG", self._draw("gain", knot, knot)))
            kind, due = gain_kind(self.sensors[knot.sensor]), self._due(knot)
            self.queue.append(self._job(kind, knot, now, due, tuple(parts), self._done))
            knot.queued = True
            self.queue += knot.waiting
            knot.waiting.clear()
        return self._next()

    def _correct(self, knot: Knot, now: int) -> Job:
        """It has arrived."""
        measurement = Measurement(knot.step, knot.sensor, now, self._due(knot))
        self.pending.append(measurement)
        parts = (("LRU", self._draw("lr_correct", knot, knot)),)
        kind, then = correct_kind(self.sensors[knot.sensor]), partial(self._corrected, knot, measurement)
        return self._job(kind, knot, now, measurement.due, parts, then)

    def _corrected(self, knot: Knot, measurement: Measurement, job: Job, now: int) -> tuple[Job, ...]:
        self.pending.remove(measurement)
        knot.corrected = True
        self.landing.append(knot)
        return self._done(job, now)

    def _loss(self, knot: Knot, now: int) -> Job:
        """It never arrives."""
        work = self._draw("gain_again", knot, knot)
        for other in self._behind(knot):
            if not other.queued:  # its gain is computed after this
                break
            if other.first:
                work += self._draw("lr_propagate", other, knot)
            work += self._draw("gain_kept" if other.landed else "gain_again", other, knot)
            if other.corrected and not other.landed:
                work += self._draw("lr_correct", other, knot)
        sensor = self.sensors[knot.sensor]
        due = now + sensor.land_by * self.period
        return self._job(loss_kind(sensor), knot, now, due, (("LRG", work),), partial(self._lost, knot))

    def _lost(self, knot: Knot, job: Job, now: int) -> tuple[Job, ...]:
        knot.landed = True
        self._forget()
        return self._done(job, now)

    def _queue_behind(self, knot: Knot, job: Job) -> None:
        """Behind its gain job."""
        if knot.queued:
            self.queue.append(job)
        else:
            knot.waiting.append(job)

    def _done(self, _job: Job, _now: int) -> tuple[Job, ...]:
        self.busy = False
        return self._next()

    def _next(self) -> tuple[Job, ...]:
        """The first of the queue, if none is under way."""
        if self.busy or not self.queue:
            return ()
        self.busy = True
        return (self.queue.popleft(),)

    def _due(self, knot: Knot) -> int:
        return (knot.step + self.sensors[knot.sensor].land_by) * self.period

    def _job(self, kind: str, knot: Knot, release: int, due: int, parts: Parts, then: Then) -> Job:
        work = sum(time for _, time in parts)
        return Job(kind, knot.step, self.priority, release, due, work, parts, then, self.lr_cpu)

    def _draw(self, part: str, knot: Knot, drawn_for: Knot) -> int:
        """A part of the low-rate task, with this knot, in a job of another."""
        name = part if part == "lr_propagate" else f"{part}.{self.sensors[knot.sensor].name}"
        return total(self.costs[name], self.streams[drawn_for.sensor])

    def _draw_high_rate(self, part: str, knot: Knot) -> int:
        return total(self.costs[f"{part}.{self.sensors[knot.sensor].name}"], self.hr_stream)


def _order(knot: Knot) -> tuple[int, int]:
    """That in which they are taken."""
    return knot.step, knot.sensor
