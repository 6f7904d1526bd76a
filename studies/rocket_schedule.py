"""Which processor does the rocket's filter need, if its GPS fix is late by a time that nobody knows beforehand?

The filter of `systems.rocket_filter` at 100 Hz: in every step it predicts and corrects by gyro and accelerometer, by
barometer and camera when they measure. Its GPS measures at 5 Hz and is 50 to 200 ms late, so that at most one fix is on
its way, for Larsen's method can wait for one only. A control task runs at 50 Hz, below the predictor, above corrections
that may be preempted. Execution times are drawn from measured samples, `times_slower` on another processor.

Larsen's method needs F and H, so for it predictor and camera are extended, not unscented. To compare like with like,
there are three ways: recalculate with the filter as it was, recalculate with the extended one, and Larsen with that.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
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
from sched_sim.distribution import wilson
from sched_sim.draws import fates
from sched_sim.jobs import HR, LR
from sched_sim.sample_file import SampledCosts
from sched_sim.scenario import Late, Scenario, Sensor
from sched_sim.scenario_run import Outcome, run_scenario
from sched_sim.schedule import Slice
from sched_sim.tasks import Task
from studies.measure_filter import timed_together
from studies.user_filter import UserFilter

Progress: TypeAlias = Callable[[int, int, str], None]
Costs: TypeAlias = Mapping[PredictorName, SampledCosts]
"""Measured, in seconds."""

NAME = "rocket-schedule"
QUESTION = "Which processor does the rocket's filter need, if its GPS fix is late by a random time?"

GPS_EVERY, GPS_DELAYS, LAND_BY = 20, range(5, 21), 24
"""In steps of 10 ms; the correction must be in the state at the end of step k + 24, 250 ms after the measurement."""
DROPOUT = 0.1
CONTROL_EVERY, CONTROL_PRIORITY = 2, 15
STEPS, CURVE_STEPS, SEED = 10_000, 3_400, 0
"""Simulated of a chosen processor, and of each one on a curve."""
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
    """How often one job missed its deadline. late_ms: by how much at worst, 0 if never; utilization: of the processor,
    the same in all rows of one run."""

    way: str
    urgency: str
    times_slower: int
    job: str
    misses: int
    decided: int
    late_ms: float
    utilization: float

    @property
    def probability(self) -> float:
        return self.misses / self.decided

    @property
    def interval(self) -> tuple[float, float]:
        """95 %, see `wilson`."""
        return wilson(self.misses, self.decided)


class Run(NamedTuple):
    """One simulation. responses_ms: sorted, by job; shares: of the processor's time, by what it is spent on.

    outcome: all else, as the achieved l of the GPS corrections.
    """

    way: str
    urgency: str
    times_slower: int
    responses_ms: Mapping[str, Sequence[float]]
    shares: Mapping[str, float]
    outcome: Outcome

    @property
    def achieved(self) -> Counter[int]:
        """How many GPS corrections landed at each l - k."""
        return self.outcome.sensors[GPS].achieved


# ---------------------------------------------------------------------------------------------------- execution times

SAMPLES, DISTURBED = 200, 10
"""How many samples of each part are kept. One that took so many times the median was not measured alone: the operating
system gave the machine to others for some milliseconds."""


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


def measured(*, thorough: bool = False, progress: Progress = lambda _done, _total, _what: None) -> dict[
    PredictorName, SampledCosts
]:  # fmt: skip
    """Both filters, timed on this machine; takes minutes if they were not compiled before."""
    upright = np.eye(16)[12]
    users = {}
    for predictor in PREDICTORS:
        composed = filter_of(predictor)
        jobs = modular_jobs(composed, upright, np.diag(START_SIGMAS**2))
        users[f"rocket-{predictor}"] = UserFilter(composed, jobs)
    costs = timed_together(users, thorough=thorough, progress=progress)
    return {predictor: thinned(costs[f"rocket-{predictor}"]) for predictor in PREDICTORS}


def thinned(costs: SampledCosts) -> SampledCosts:
    """The same distributions in `SAMPLES` samples a part at most, in ascending order, without the disturbed ones."""
    kept, disturbed = {}, 0
    for part, values in costs.samples.items():
        middle = median(values)
        sound = sorted(value for value in values if value < DISTURBED * middle)
        disturbed += len(values) - len(sound)
        count = min(SAMPLES, len(sound))
        kept[part] = tuple(sound[len(sound) * (2 * number + 1) // (2 * count)] for number in range(count))
    share = disturbed / sum(map(len, costs.samples.values()))
    about = f"{100 * share:.1f} % took over {DISTURBED} times the median and were left out; quantiles of the others"
    return replace(costs, samples=kept, provenance={**costs.provenance, "samples_are": about})


# ------------------------------------------------------------------------------------------------------- the scenario


def scenario(
    costs: Costs, way: Way, urgency: str, times_slower: int, *, steps: int = STEPS, seed: int = SEED
) -> Scenario:
    """urgency: one of `URGENCIES`."""
    composed = rocket_filter(way.predictor, DROPOUT)
    late = Sensor(GPS, GPS_EVERY, GPS_DELAYS, LAND_BY, dropout=DROPOUT, priority=URGENCIES[urgency])
    on_time = [
        Sensor(sensor.name, sensor.every, (0,), land_by=0, dropout=sensor.dropout, priority=HR)
        for sensor in composed.sensors
        if sensor.name != GPS
    ]
    samples = costs[way.predictor].samples
    return Scenario(
        f"{way.name}, {urgency}, {times_slower} times slower",
        steps=steps,
        speed=Fraction(1, RATE_HZ),
        sensors=[late, *on_time],
        costs={part: tuple(times_slower * value for value in values) for part, values in samples.items()},
        hr_hz=Fraction(RATE_HZ),
        seed=seed,
        late=way.late,
        tasks=[control_task(costs, times_slower)],
    )


def control_task(costs: Costs, times_slower: int) -> Task:
    """It takes as long as an extended prediction usually does, whichever filter runs beside it."""
    usual = median(costs["extended"].samples["predict"])
    return Task("control", Fraction(CONTROL_EVERY), times_slower * usual, CONTROL_PRIORITY)


def step_s(costs: SampledCosts, dropout: float) -> float:
    """What a step's prediction and corrections take on average, in seconds, without late measurements."""
    means = {part: fmean(map(float, values)) for part, values in costs.samples.items()}
    on_time = [sensor for sensor in rocket_filter().sensors if sensor.name != GPS]
    return means["predict"] + (1 - dropout) * sum(means[f"correct.{sensor.name}"] / sensor.every for sensor in on_time)


def slowness_of_a_full_processor(costs: SampledCosts) -> float:
    """How many times slower the processor is that is filled by the steps alone, if nothing drops out."""
    return 1 / (RATE_HZ * step_s(costs, 0.0))


POINTS, SLOWEST, FASTEST = 14, 1.2, 0.02
SURE = 0.95
"""A curve ends with the processor on which every job misses so often: on still slower ones no simulation is needed."""


def slownesses(costs: Costs) -> list[int]:
    """From a processor on which nothing is late to one on which all is, to two digits."""
    full = slowness_of_a_full_processor(costs["extended"])
    return sorted({int(float(f"{value:.2g}")) for value in np.geomspace(FASTEST * full, SLOWEST * full, POINTS)} - {0})


# ------------------------------------------------------------------------------------------------------------ answers


def miss_curves(
    costs: Costs,
    times_slower: Sequence[int],
    *,
    steps: int = CURVE_STEPS,
    seed: int = SEED,
    progress: Progress = lambda _done, _total, _what: None,
) -> list[MissRow]:
    """How often each job misses its deadline, each way, at each urgency, on each processor, from the fastest on.

    Where a processor has less time than is asked for, misses also depend on how long it is simulated.
    """
    cases = list(product(WAYS, URGENCIES))
    rows: list[MissRow] = []
    for done, (way, urgency) in enumerate(cases):
        progress(done, len(cases), f"{way.name}, {urgency}")
        for slower in sorted(times_slower):
            of = scenario(costs, way, urgency, slower, steps=steps, seed=seed)
            found = miss_rows(way, urgency, slower, run_scenario(of))
            rows += found
            if all(row.probability > SURE for row in found):
                break
    progress(len(cases), len(cases), "done")
    return rows


def miss_rows(way: Way, urgency: str, times_slower: int, outcome: Outcome) -> list[MissRow]:
    """One for each job of `JOBS`."""
    ms_per_tick = PERIOD_MS / outcome.schedule.period
    return [
        MissRow(
            way.name,
            urgency,
            times_slower,
            job,
            outcome.jobs[kind].misses,
            outcome.jobs[kind].decided,
            ms_per_tick * outcome.schedule.responses[kind].worst_lateness,
            float(outcome.schedule.utilization),
        )
        for job, kind in JOBS.items()
    ]


def chosen(costs: Costs, way: Way, urgency: str, times_slower: int, *, steps: int = STEPS, seed: int = SEED) -> Run:
    """One simulation, looked at closely."""
    ticks: Counter[str] = Counter()

    def spent(piece: Slice) -> None:
        for label, start, end in piece.pieces():
            ticks[_purpose(piece.kind, label)] += end - start

    of = scenario(costs, way, urgency, times_slower, steps=steps, seed=seed)
    outcome = run_scenario(of, on_slice=spent)
    whole = steps * outcome.schedule.period
    shares = {purpose: ticks[purpose] / whole for purpose in PURPOSES}
    responses = {job: sorted(PERIOD_MS * each for each in outcome.jobs[kind].responses) for job, kind in JOBS.items()}
    return Run(way.name, urgency, times_slower, responses, shares, outcome)


def arrivals(steps: int = STEPS, seed: int = SEED) -> Counter[int]:
    """How many GPS measurements take so many steps to arrive, of those of a simulation: the achieved l - k if no
    computation took any time. The last ones may arrive after its end."""
    fixes = fates(GPS_DELAYS, DROPOUT, len(range(0, steps, GPS_EVERY)), seed, GPS)
    return Counter(delay for delay in fixes if delay is not None)


PURPOSES = ("prediction", "on-time corrections", "GPS correction", "replay", "catching up", "control")
_OF_GPS = {"CO": "GPS correction", "RP": "replay", "CU": "catching up"}


def _purpose(kind: str, label: str) -> str:
    if kind == JOBS["GPS"]:
        return _OF_GPS[label]
    return {"predict": "prediction", JOBS["control"]: "control"}.get(kind, "on-time corrections")


def slowest_that_holds(rows: Iterable[MissRow], way: str, urgency: str, limit: float = BEARABLE) -> int | None:
    """The slowest of the processors tried up to which no job misses more than this share of its deadlines; None if some
    job does on the fastest."""
    held = None
    by_speed: dict[int, list[MissRow]] = {}
    for row in rows:
        if (row.way, row.urgency) == (way, urgency):
            by_speed.setdefault(row.times_slower, []).append(row)
    for slower in sorted(by_speed):
        if any(row.probability > limit for row in by_speed[slower]):
            break
        held = slower
    return held


def compared_at(rows: Sequence[MissRow]) -> int:
    """The slowest processor tried on which the extended filter, preempted while it replays, holds: there all others are
    looked at too. The fastest one if there is none."""
    held = slowest_that_holds(rows, WAYS[1].name, "preempted", BEARABLE)
    return min(row.times_slower for row in rows) if held is None else held
