"""The jobs of a filter composed of one predictor and several sensors' correctors.

Every step releases a predict job at its start, due at the start of the next step. A measurement that arrives at the
start of step m = k + delay releases a correct job there, after the predict job of m, due at the end of step
k + land_by. Its response time is from the arrival until the correction has landed: is in the state. The step in which
that is, is the achieved l; so the deadline is met exactly if l <= k + land_by.

Held up or preempted. A correction as urgent as the predictor, or more, runs before the next predict job, and lands in
the step in which it finishes. A less urgent one is preempted by predict jobs (with two processors it runs beside them);
such corrections of one priority run one after another, each from when the one before has landed, and those that wait
by then go together.

recalculate. A correction is of step k, so it rolls back: its work is the correction, the other corrections of step k
once more, and for each step from k + 1 to the one it aims at a predict, and a correction for each other measurement
taken in those steps that has landed or lands before it. The step it aims at is the one in which it could start. Late
measurements of one priority that arrive in the same step go together: one job rolls back once, to the earliest, and
they land together. This is the work of `filters.modular.recalculate`, and one predict more for each such job: that of
step m, which the predict job has done and the replay does again. The filter code begins a step when it has all
measurements that arrive in it; here the predict job of m does not wait for them, as in `design.serial` and in Table 1
of Steffes 2014. Corrections that are more urgent have also been done in step m before, and are done again.

A preempted correction that finishes in a later step has to catch up: it goes on with the steps that passed meanwhile
and the corrections made meanwhile, from the step of the earliest of those measurements if that is before the one it had
reached, until it finishes in the step it aims at. On a processor without that much time left this never ends.

larsen, where none is taken before the late one before has arrived: one late measurement is in flight at a time, from
when it is taken until it lands; if it never arrives, until the next late one is taken, for the filter cannot know.
Meanwhile each predict job also multiplies what has become of an error of step k by the transition, and so do the
corrections of undelayed sensors with their own part. On a slow processor one may land after the next has been taken,
and then both are in flight: each needs a product of its own, and what is charged is one. The late correction itself
needs no replay, and lands in the step in which it finishes. A preempted correction of an undelayed sensor that finishes
in a later step catches up as above.

carried-gain, and larsen in any other scenario: any number may be in flight (`filters.modular.carried_gain`). That one
is being taken is known in its step k, and the covariance is corrected there: the predict job of k does that too, with
the work of the sensor's correction. It also takes each measurement that is in flight when it begins a step further,
`carry`, and a correction made at once, or at k, does its part with each in flight, `beside`: those of its own step
have been taken before it. One that arrives in the step of a predict job and is more urgent has landed before that
begins, on the same processor; others land behind it. When a late one has arrived its correction is the work of its
landing, `land`, which needs no replay and lands in the step in which it finishes; it is in flight until then. A
measurement that never arrives is in flight as long as its sensor's longest delay, for then the filter knows; to add
what it would have told to the covariance is not charged. A measurement that for once arrives in its own step is
corrected at once. A preempted correction that is made at once and finishes in a later step catches up as above, by
predicts, and the corrections of the covariance and the landings in the steps that passed.

In one step and of one priority, late corrections come first, then those of the sensors in their order.

What a job costs is settled when it is released. A correction that catches up is still the same job: no context switch
is charged if nothing else runs in between.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right, insort
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from itertools import chain, groupby
from operator import itemgetter
from typing import NamedTuple

from sched_sim.scenario.draws import total, words
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.scenario import Scenario
from sched_sim.schedule.jobs import Job, Parts, Source, Then, step_at


class Measurement(NamedTuple):
    """One that arrived. step: k, in which it was taken; sensor: its number in the scenario; arrival, due: in ticks."""

    step: int
    sensor: int
    arrival: int
    due: int


Together = tuple[Measurement, ...]
"""Corrections that are one job, that of the first of them, and land together."""


class Branch(NamedTuple):
    """Corrections under way, while the filter goes on without them.

    aim: the step whose state they compute; seen: corrections that had landed when the work was settled;
    ahead: those that had not, and of which it was clear that they would before these.
    """

    together: Together
    aim: int
    seen: int
    ahead: frozenset[Measurement]


class Taken(NamedTuple):
    """A late measurement whose covariance was corrected in this step. sensor: its number."""

    step: int
    sensor: int


class Awaited(NamedTuple):
    """A late measurement, not there yet. step: in which it was taken; arrives: None if it never does."""

    step: int
    arrives: int | None


Applied = tuple[int, Measurement | Taken]


class ComposedFilter(Source):
    """Releases the jobs; `period` (the HR period) and `costs`, by part, in ticks.

    flying: where several may be in flight, those that are, with the step in which one that never arrives is known to be
    lost, else None. following: each sensor's next measurement; taken, dropped: measurements so far, by the number of
    the sensor;
    pending: arrived and not landed, sorted.
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
        self.corrector_cpu = scenario.cpus - 1
        self.carries = scenario.carries
        self.one_in_flight = scenario.late == "larsen" and self.carries is None
        self.flying: dict[Taken, int | None] = {}
        self.measurements = [sensor.measurements(scenario.steps, scenario.seed) for sensor in self.sensors]
        self.following = [next(measurements, None) for measurements in self.measurements]
        self.predict_stream = words(scenario.seed, "predictor cost")
        self.streams = [words(scenario.seed, f"{sensor.name} cost") for sensor in self.sensors]
        self.arrivals: defaultdict[int, list[Measurement]] = defaultdict(list)  # by step
        self.waiting: dict[int, list[Measurement]] = {}  # by priority, while one of that priority is under way
        self.landed: list[Applied] = []  # the step of the state it was applied to, in order of landing
        self.applied: list[Applied] = []  # the same, in order of that step
        self.awaited: Awaited | None = None  # by Larsen's method, not arrived yet
        self.carried: dict[Measurement, None] = {}  # of those that are carried, arrived and not landed

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        first = self._landing_first(step)
        predict, carry = self._predict(), self._carry(first)
        corrected = 0
        for number, following in enumerate(self.following):
            if following is not None and following[0] == step:
                corrected += self._take(number, *following, len(first))
                self.following[number] = next(self.measurements[number], None)
        for taken in [taken for taken, lost in self.flying.items() if lost == step]:
            del self.flying[taken]
        jobs = [self._predict_job(step, start, predict, carry, corrected)]
        if self.awaited is not None and self.awaited.arrives == step:
            self.awaited = None
        arrived = sorted(self.arrivals.pop(step, []), key=self._order)
        self.carried |= dict.fromkeys(measurement for measurement in arrived if self._is_carried(measurement))
        for _, together in groupby(arrived, self._group):
            jobs += self._arrive(tuple(together), start)
        return tuple(jobs)

    def at_horizon(self) -> tuple[Job, ...]:
        return tuple(
            self._job((measurement,), (), None) for waiting in self.waiting.values() for measurement in waiting
        )

    def _order(self, measurement: Measurement) -> tuple[int, bool, int, int]:
        """The order of corrections released at one instant."""
        sensor = self.sensors[measurement.sensor]
        return sensor.priority, not self._is_late(measurement), measurement.sensor, measurement.step

    def _group(self, measurement: Measurement) -> tuple[int, Measurement | None]:
        """The same for corrections that arrive in one step and go back together."""
        goes_back = self._is_late(measurement) and not self._is_carried(measurement)
        return self.sensors[measurement.sensor].priority, None if goes_back else measurement

    def _is_late(self, measurement: Measurement) -> bool:
        """Whether it arrived in a later step than that in which it was taken."""
        return measurement.step * self.period < measurement.arrival

    def _landing_first(self, step: int) -> set[Taken]:
        """Those in flight that will have landed when the predict job of this step begins."""
        if self.carries is None or self.corrector_cpu:
            return set()
        there = (Taken(found.step, found.sensor) for found in chain(self.carried, self.arrivals.get(step, ())))
        urgent = self.scenario.priority
        return {taken for taken in there if taken in self.flying and self.sensors[taken.sensor].priority < urgent}

    def _predict(self) -> int:
        """The work of the prediction; with the products of Larsen's method while one is awaited."""
        waits = self.one_in_flight and (self.awaited or self.carried)
        part = "predict_accumulate" if waits else "predict"
        return total(self.costs[part], self.predict_stream)

    def _carry(self, landing_first: set[Taken]) -> int:
        """The work of taking what is in flight a step further."""
        work = 0
        if self.carries is not None:
            for taken in self.flying:
                if taken in landing_first:
                    continue
                work += total(self.costs[self.carries.of(self.sensors[taken.sensor].name)], self.predict_stream)
        return work

    def _predict_job(self, step: int, start: int, predict: int, carry: int, corrected: int) -> Job:
        """corrected: the work of the corrections of the covariance in its step."""
        more = tuple((label, work) for label, work in (("CA", carry), ("CO", corrected)) if work)
        work = predict + carry + corrected
        return Job("predict", step, self.scenario.priority, start, start + self.period, work, (("PR", predict), *more))

    def _take(self, number: int, step: int, delay: int | None, landed: int) -> int:
        """What is done in its step with one that will come late. landed: of those in flight, before that."""
        sensor = self.sensors[number]
        arrives = None if delay is None else step + delay
        self.taken[number] += 1
        work = 0
        if sensor.delayed and arrives != step:
            if self.one_in_flight:
                self._await(Awaited(step, arrives))
            elif self.carries is not None:
                work = self._correct_covariance(Taken(step, number), arrives, len(self.flying) - landed)
        if arrives is None:
            self.dropped[number] += 1
            return work
        due = (step + sensor.land_by + 1) * self.period
        self.arrivals[arrives].append(Measurement(step, number, arrives * self.period, due))
        return work

    def _correct_covariance(self, taken: Taken, arrives: int | None, in_flight: int) -> int:
        """The work of it, by one that comes late, with so many in flight; from now on it is too."""
        sensor = self.sensors[taken.sensor]
        work = total(self.costs[f"correct.{sensor.name}"], self.streams[taken.sensor])
        work += self._beside(taken.sensor, in_flight)
        self.flying[taken] = taken.step + sensor.longest_delay if arrives is None else None
        self._apply(taken.step, taken)
        return work

    def _beside(self, number: int, in_flight: int) -> int:
        """The work of a correction by the sensor of this number with so many in flight."""
        if self.carries is None or not in_flight:
            return 0
        costs = self.costs[f"{self.carries.beside}.{self.sensors[number].name}"]
        return total(costs, self.streams[number], in_flight)

    def _apply(self, step: int, applied: Measurement | Taken) -> None:
        """In the history of this step."""
        self.landed.append((step, applied))
        insort(self.applied, (step, applied), key=itemgetter(0))

    def _await(self, taken: Awaited) -> None:
        """One that will never arrive is not waited for while another is in flight."""
        current = self.awaited
        if taken.arrives is not None or current is None or current.arrives in (None, taken.step):
            self.awaited = taken

    def _arrive(self, together: Together, now: int) -> tuple[Job, ...]:
        for measurement in together:
            insort(self.pending, measurement)
        sensor = self.sensors[together[0].sensor]
        if self.scenario.preempted(sensor):
            if sensor.priority in self.waiting:
                self.waiting[sensor.priority] += together
                return ()
            self.waiting[sensor.priority] = []
        return (self._correct(together, now),)

    def _next(self, priority: int, now: int) -> tuple[Job, ...]:
        """The preempted correction of this priority has landed: what waits for it starts."""
        waiting = self.waiting[priority]
        if not waiting:
            del self.waiting[priority]
            return ()
        first = waiting[0]
        rest = [] if self._is_carried(first) else waiting[1:]
        together = (first, *(measurement for measurement in rest if not self._is_carried(measurement)))
        self.waiting[priority] = [measurement for measurement in waiting if measurement not in together]
        return (self._correct(together, now),)

    def _correct(self, together: Together, now: int) -> Job:
        """Settles the work of corrections that can start now."""
        first = together[0]
        sensor, draws = self.sensors[first.sensor], self.streams[first.sensor]
        if self._is_carried(first):
            late = total(self.costs[self._part(first)], draws)
            label = "CO" if self.carries is None else "LA"
            return self._job(together, ((label, late),), partial(self._land, together))
        aim = now // self.period
        kind = "correct_accumulate" if self.one_in_flight and self._waits(aim, together) else "correct"
        names = [self.sensors[measurement.sensor].name for measurement in together]
        work = sum(total(self.costs[f"{kind}.{name}"], draws) for name in names)
        if self.carries is not None:
            flying = self._in_flight(aim, together)
            work += sum(self._beside(measurement.sensor, flying) for measurement in together)
        back = min(measurement.step for measurement in together)
        after = back - 1 if back < aim else back  # from the prediction of step `back`, or from the state as it is
        later = self.pending[bisect_right(self.pending, after, key=itemgetter(0)) :]
        again = [
            measurement
            for measurement in later
            if self._is_ahead(measurement, together) and not self._is_carried(measurement)
        ]
        replay = self._replay(first, aim - back, [*again, *self._applied_after(after)])
        parts = (("CO", work), ("RP", replay)) if replay else (("CO", work),)
        if not self.scenario.preempted(sensor):
            return self._job(together, parts, partial(self._land, together))
        ahead = frozenset(measurement for measurement in self.pending if self._is_ahead(measurement, together))
        return self._job(together, parts, partial(self._finish, Branch(together, aim, len(self.landed), ahead)))

    def _is_ahead(self, measurement: Measurement, together: Together) -> bool:
        """Whether the correction of one that has arrived lands before these do; those that wait for them do not."""
        sensor = self.sensors[together[0].sensor]
        limit = sensor.priority - self.scenario.preempted(sensor)
        return self.sensors[measurement.sensor].priority <= limit and measurement not in together

    def _waits(self, step: int, together: Together) -> bool:
        """Whether something taken before `step` will still be in flight when these have landed."""
        awaited = self.awaited is not None and self.awaited.step < step
        return awaited or any(
            measurement.step < step and not self._is_ahead(measurement, together) for measurement in self.carried
        )

    def _in_flight(self, step: int, together: Together) -> int:
        """How many taken by `step` will still be in flight when these have landed."""
        ahead = sum(measurement.step <= step and self._is_ahead(measurement, together) for measurement in self.carried)
        return sum(taken.step <= step for taken in self.flying) - ahead

    def _is_carried(self, measurement: Measurement) -> bool:
        """Whether it is carried to the step in which it lands, instead of being replayed from its own."""
        if self.carries is not None:
            return self._is_late(measurement)
        return self.one_in_flight and self.sensors[measurement.sensor].delayed

    def _part(self, applied: Measurement | Taken) -> str:
        """That of which it costs the work to apply it once more."""
        name = self.sensors[applied.sensor].name
        if isinstance(applied, Taken) or not self._is_carried(applied):
            return f"correct.{name}"
        return f"{'correct_late' if self.carries is None else self.carries.land}.{name}"

    def _applied_after(self, step: int) -> list[Measurement | Taken]:
        """Corrections in the history of the steps after this one."""
        return [applied for _, applied in self.applied[bisect_right(self.applied, step, key=itemgetter(0)) :]]

    def _replay(self, measurement: Measurement, steps: int, again: Iterable[Measurement | Taken]) -> int:
        """The work of so many predicts and these corrections, drawn for the correction of `measurement`."""
        draws = self.streams[measurement.sensor]
        work = total(self.costs["predict"], draws, steps)
        for repeated in again:
            work += total(self.costs[self._part(repeated)], draws)
        return work

    def _finish(self, branch: Branch, job: Job, now: int) -> tuple[Job, ...]:
        """The branch has got as far as it aimed at: it lands, or catches up."""
        if step_at(now, self.period) <= branch.aim:
            return self._land(branch.together, job, now)
        first = branch.together[0]
        news = [(step, applied) for step, applied in self.landed[branch.seen :] if applied not in branch.ahead]
        back = min([branch.aim, *(step for step, _ in news)])
        if back < branch.aim:  # from the prediction of that step
            again = [
                *self._applied_after(back - 1),
                *(measurement for measurement in branch.together if measurement.step >= back),
            ]
        else:
            again = [*self._applied_after(back), *(applied for step, applied in news if step == back)]
        aim = now // self.period
        work = self._replay(first, aim - back, again)
        further = branch._replace(aim=aim, seen=len(self.landed))
        return (job.go_on((("CU", work),), partial(self._finish, further)),)

    def _land(self, together: Together, job: Job, now: int) -> tuple[Job, ...]:
        for measurement in together:
            del self.pending[bisect_left(self.pending, measurement)]
            self.carried.pop(measurement, None)
            self.flying.pop(Taken(measurement.step, measurement.sensor), None)
            self._apply(step_at(now, self.period) if self._is_carried(measurement) else measurement.step, measurement)
        return self._next(job.priority, now) if job.priority in self.waiting else ()

    def _job(self, together: Together, parts: Parts, then: Then | None) -> Job:
        first, *others = together
        sensor = self.sensors[first.sensor]
        work, cpu = sum(time for _, time in parts), self.corrector_cpu
        job = Job(correct_kind(sensor), first.step, sensor.priority, first.arrival, first.due, work, parts, then, cpu)
        job.companions = tuple(self._job((companion,), (), None) for companion in others)
        return job
