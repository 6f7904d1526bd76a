"""Which processor does the rocket's filter need, if its GPS fix is late by a time that nobody knows beforehand?

The filter of `systems.rocket_filter` at 100 Hz: in every step it predicts and corrects by gyro and accelerometer, by
barometer and camera when they measure. Its GPS measures at 5 Hz and is 50 to 200 ms late, so that at most one fix is on
its way, for Larsen's method can wait for one only. A control task runs at 50 Hz, below the predictor, above corrections
that may be preempted.

Execution times are stated, not measured: the counted operations of each part in cycles of `PROCESSOR`, by its data
sheet, times a factor drawn from `SPREAD` for each execution. So are delays and dropout. What comes out holds for these.

Larsen's method needs F and H, so for it predictor and camera are extended, not unscented. To compare like with like,
there are three ways: recalculate with the filter as it was, recalculate with the extended one, and Larsen with that.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import product
from statistics import fmean, median
from typing import NamedTuple, TypeAlias

import numpy as np

from filters.modular import ModularFilter, extended_corrector
from filters.modular.jobs import modular_jobs
from filters.systems.rocket import RATE_HZ
from filters.systems.rocket_filter import (
    ACCELEROMETER,
    ATTITUDE,
    CAMERA,
    GPS,
    START_SIGMAS,
    PredictorName,
    attitude,
    rocket_filter,
)
from sched_sim.costs.sample_file import SampledCosts
from sched_sim.processors.part import seconds_for
from sched_sim.processors.part_file import load_part
from sched_sim.scenario.distribution import wilson
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Late, Scenario, Sensor
from sched_sim.schedule.jobs import HR, LR
from sched_sim.schedule.outcome import Slice
from sched_sim.schedule.tasks import Task
from studies.measurement.samples import measure_filter
from studies.measurement.user_filter import UserFilter

Progress: TypeAlias = Callable[[int, int, str], None]
Costs: TypeAlias = Mapping[PredictorName, SampledCosts]
"""In cycles of `PROCESSOR`."""

NAME = "rocket-schedule"
QUESTION = "Which processor does the rocket's filter need, if its GPS fix is late by a random time?"

GPS_EVERY, GPS_DELAYS, LAND_BY = 20, range(5, 21), 24
"""In steps of 10 ms; the correction must be in the state at the end of step k + 24, 250 ms after the measurement."""
DROPOUT = 0.1
CONTROL_EVERY, CONTROL_PRIORITY = 2, 15
STEPS, SEED = 20_000, 0
"""Simulated on each processor."""
PROCESSOR = "cortex-a53"
"""Whose cycles the costs are; it runs at any clock."""
SPREAD = tuple(Fraction(tenths, 10) for tenths in range(10, 16))
"""Times the counted work: an execution takes any of these, equally likely."""
PERIOD_MS = 1000 / RATE_HZ


BEARABLE = 0.01
"""The share of missed deadlines up to which a processor is said to hold."""


class Way(NamedTuple):
    """Whose predictor and camera, and what a late GPS fix does."""

    predictor: PredictorName
    late: Late

    @property
    def name(self) -> str:
        return f"{self.late}, {self.predictor}"


PREDICTORS: tuple[PredictorName, ...] = ("unscented", "extended")
WAYS = (Way("unscented", "recalculate"), Way("extended", "recalculate"), Way("extended", "larsen"))
URGENCIES = {"preempted": LR, "in the loop": HR}
"""Priority of the GPS correction: below the predictor, which then goes on meanwhile, or the predictor's own, so that
the next steps wait until it is done."""

JOBS = {"loop": f"correct {ACCELEROMETER}", "control": "task:control", "GPS": f"correct {GPS}"}
"""What may miss its deadline. The accelerometer's correction ends the work of a step, so with it the step is late."""


class MissRow(NamedTuple):
    """How often one job missed its deadline. cycles: the fixes that were taken, in which misses of a row may come
    together; late_ms: by how much at worst, 0 if never; utilization: of the processor, the same in all rows of one run.
    """

    way: str
    urgency: str
    clock_mhz: int
    job: str
    misses: int
    decided: int
    cycles: int
    late_ms: float
    utilization: float

    @property
    def probability(self) -> float:
        return self.misses / self.decided

    @property
    def interval(self) -> tuple[float, float]:
        """95 %, by `wilson` of as many trials as there are cycles: all misses of one cycle may have one cause. It is
        exact where they do, and too wide where they do not."""
        trials = min(self.cycles, self.decided)
        return wilson(self.probability * trials, trials)


class Run(NamedTuple):
    """One simulation. responses_ms: sorted, by job; shares: of the processor's time, by what it is spent on.

    outcome: all else, as the achieved l of the GPS corrections.
    """

    way: str
    urgency: str
    clock_mhz: int
    responses_ms: Mapping[str, Sequence[float]]
    shares: Mapping[str, float]
    outcome: Outcome

    @property
    def achieved(self) -> Counter[int]:
        """How many GPS corrections landed at each l - k."""
        return self.outcome.sensors[GPS].achieved


# ---------------------------------------------------------------------------------------------------- execution times


def filter_of(predictor: PredictorName) -> ModularFilter:
    """The rocket's filter; the extended one without any unscented part."""
    built = rocket_filter(predictor)
    if predictor == "unscented":
        return built
    sensors = [
        replace(sensor, corrector=extended_corrector(attitude, sensor.corrector.R, observed=ATTITUDE))
        if sensor.name == CAMERA
        else sensor
        for sensor in built.sensors
    ]
    return ModularFilter(built.predictor, sensors, built.dt, built.of)


@cache
def counted() -> Costs:
    """Both filters: the operations of each part, exactly, as cycles of `PROCESSOR`, with their `SPREAD`."""
    processor = load_part(PROCESSOR)
    assert processor.clock_hz is not None
    upright, P0 = np.eye(16)[12], np.diag(START_SIGMAS**2)
    costs: dict[PredictorName, SampledCosts] = {}
    for predictor in PREDICTORS:
        composed = filter_of(predictor)
        user = UserFilter(composed, modular_jobs(composed, upright, P0))
        table = measure_filter(user, "counted", name=f"rocket-{predictor}")
        cycles = {
            part: processor.clock_hz * seconds_for(counts, processor, part) for part, counts in table.operations.items()
        }
        samples = {part: tuple(factor * work for factor in SPREAD) for part, work in cycles.items()}
        costs[predictor] = replace(table, unit="cycle", samples=samples)
    return costs


# ------------------------------------------------------------------------------------------------------- the scenario


def scenario(costs: Costs, way: Way, urgency: str, clock_mhz: int, *, steps: int = STEPS, seed: int = SEED) -> Scenario:
    """urgency: one of `URGENCIES`. Costs stay in cycles."""
    composed = rocket_filter(way.predictor, DROPOUT)
    late = late_sensor(urgency)
    on_time = [
        Sensor(sensor.name, sensor.every, (0,), land_by=0, dropout=sensor.dropout, priority=HR)
        for sensor in composed.sensors
        if sensor.name != GPS
    ]
    return Scenario(
        f"{way.name}, {urgency}, {clock_mhz} MHz",
        steps=steps,
        speed=Fraction(clock_mhz * 10**6, RATE_HZ),
        sensors=[late, *on_time],
        costs=costs[way.predictor].samples,
        hr_hz=Fraction(RATE_HZ),
        seed=seed,
        late=way.late,
        tasks=[control_task(costs)],
    )


def late_sensor(urgency: str) -> Sensor:
    """The GPS."""
    return Sensor(GPS, GPS_EVERY, GPS_DELAYS, LAND_BY, dropout=DROPOUT, priority=URGENCIES[urgency])


def control_task(costs: Costs) -> Task:
    """It takes as long as the median of an extended prediction, whichever filter runs beside it."""
    usual = Fraction(median(costs["extended"].samples["predict"]))
    return Task("control", Fraction(CONTROL_EVERY), usual, CONTROL_PRIORITY)


def step_cycles(costs: SampledCosts, dropout: float) -> float:
    """What a step's prediction and corrections take on average, without late measurements."""
    means = {part: fmean(map(float, values)) for part, values in costs.samples.items()}
    on_time = [sensor for sensor in rocket_filter().sensors if sensor.name != GPS]
    return means["predict"] + (1 - dropout) * sum(means[f"correct.{sensor.name}"] / sensor.every for sensor in on_time)


def full_mhz(costs: SampledCosts) -> float:
    """The clock of the processor that is filled by the steps alone, if nothing drops out."""
    return RATE_HZ * step_cycles(costs, 0.0) / 10**6


POINTS, SLOWEST, FASTEST = 12, 1.0, 30.0
FULL = 0.99
"""A curve ends with the first processor that is so busy: with less time than is asked for, what is late depends on how
long it is simulated."""


def clocks(costs: Costs) -> list[int]:
    """In MHz, from a processor on which all is late to one on which nothing is, to two digits."""
    full = full_mhz(costs["extended"])
    return sorted({int(float(f"{value:.2g}")) for value in np.geomspace(SLOWEST * full, FASTEST * full, POINTS)})


# ------------------------------------------------------------------------------------------------------------ answers


def miss_curves(
    costs: Costs,
    clocks_mhz: Sequence[int],
    *,
    steps: int = STEPS,
    seed: int = SEED,
    progress: Progress = lambda _done, _total, _what: None,
) -> list[MissRow]:
    """How often each job misses its deadline, each way, at each urgency, on each processor, from the fastest on, until
    one is full."""
    cases = list(product(WAYS, URGENCIES))
    rows: list[MissRow] = []
    for done, (way, urgency) in enumerate(cases):
        progress(done, len(cases), f"{way.name}, {urgency}")
        for clock_mhz in sorted(clocks_mhz, reverse=True):
            workload = scenario(costs, way, urgency, clock_mhz, steps=steps, seed=seed)
            misses = miss_rows(way, urgency, clock_mhz, run_scenario(workload))
            rows += misses
            if misses[0].utilization > FULL:
                break
    progress(len(cases), len(cases), "done")
    return rows


def miss_rows(way: Way, urgency: str, clock_mhz: int, outcome: Outcome) -> list[MissRow]:
    """One for each job of `JOBS`."""
    ms_per_tick = PERIOD_MS / outcome.schedule.period
    return [
        MissRow(
            way.name,
            urgency,
            clock_mhz,
            job,
            outcome.jobs[kind].misses,
            outcome.jobs[kind].decided,
            outcome.sensors[GPS].taken,
            ms_per_tick * outcome.schedule.responses[kind].worst_lateness,
            float(outcome.schedule.utilization),
        )
        for job, kind in JOBS.items()
    ]


def chosen(costs: Costs, way: Way, urgency: str, clock_mhz: int, *, steps: int = STEPS, seed: int = SEED) -> Run:
    """One simulation, looked at closely."""
    ticks: Counter[str] = Counter()

    def spent(piece: Slice) -> None:
        for label, start, end in piece.pieces():
            ticks[_purpose(piece.kind, label)] += end - start

    workload = scenario(costs, way, urgency, clock_mhz, steps=steps, seed=seed)
    outcome = run_scenario(workload, on_slice=spent)
    whole = steps * outcome.schedule.period
    shares = {purpose: ticks[purpose] / whole for purpose in PURPOSES}
    responses = {job: sorted(PERIOD_MS * each for each in outcome.jobs[kind].responses) for job, kind in JOBS.items()}
    return Run(way.name, urgency, clock_mhz, responses, shares, outcome)


def arrivals(steps: int = STEPS, seed: int = SEED) -> Counter[int]:
    """How many GPS measurements take so many steps to arrive, of those of a simulation: the achieved l - k if no
    computation took any time. The last ones may arrive after its end."""
    fixes = late_sensor("preempted").measurements(steps, seed)
    return Counter(delay for _, delay in fixes if delay is not None)


PURPOSES = ("prediction", "on-time corrections", "GPS correction", "replay", "catching up", "control")
_OF_GPS = {"CO": "GPS correction", "RP": "replay", "CU": "catching up"}


def _purpose(kind: str, label: str) -> str:
    if kind == JOBS["GPS"]:
        return _OF_GPS[label]
    return {"predict": "prediction", JOBS["control"]: "control"}.get(kind, "on-time corrections")


def slowest_that_holds(rows: Iterable[MissRow], way: str, urgency: str, limit: float = BEARABLE) -> int | None:
    """The slowest of the clocks tried, in MHz, down to which every job misses no more than this share of its deadlines
    even at the upper end of its interval; None if some job does on the fastest."""
    held = None
    by_clock: dict[int, list[MissRow]] = {}
    for row in rows:
        if (row.way, row.urgency) == (way, urgency):
            by_clock.setdefault(row.clock_mhz, []).append(row)
    for clock_mhz in sorted(by_clock, reverse=True):
        if any(row.interval[1] > limit for row in by_clock[clock_mhz]):
            break
        held = clock_mhz
    return held


def compared_at(rows: Sequence[MissRow]) -> int:
    """The slowest processor tried on which the extended filter, preempted while it replays, holds: there all others are
    looked at too. The fastest one if there is none."""
    held = slowest_that_holds(rows, WAYS[1].name, "preempted", BEARABLE)
    return max(row.clock_mhz for row in rows) if held is None else held
