"""What is done with a measurement that comes late, what it buys, and what it costs: on the oscillator.

The filter that tracks a mass without knowing of its spring, 200 steps in a period; the position is measured in every
tenth step and comes up to ten steps late. Alone, or beside an accelerometer that measures in every step, in time.

Four ways: `filters.modular.run` with late = "recalculate", "larsen" or "dual-rate" (for one sensor), and
"fuse-as-fresh": to take the measurement as if it were new, which is what a filter does that knows nothing of delays.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.backends.counted import count
from filters.modular import Measurement, ModularFilter, ModularHistory, observe, run
from filters.modular.as_system import composed_system
from filters.modular.jobs import modular_jobs
from filters.registry import ALL_METHODS
from filters.systems.spring_mass import Instrument, frequency, tracker
from studies.modular.oscillator_run import (
    ACCELERATION_SIGMA,
    AMPLITUDES,
    OSCILLATOR,
    POSITION_SIGMA_M,
    SETTLED_PERIODS,
    Setting,
    oscillation,
    start,
    step_s,
)
from studies.modular.rms import Rms, rms

Way: TypeAlias = Literal["recalculate", "larsen", "dual-rate", "fuse-as-fresh"]
Sensors: TypeAlias = Literal["position", "position and acceleration"]
Progress: TypeAlias = Callable[[int, int, str], None]

WAYS: tuple[Way, ...] = get_args(Way)
SENSORS: tuple[Sensors, ...] = get_args(Sensors)
SETTING = Setting(rate=200)
EVERY = 10
"""Steps between measurements of the position; the correction of the dual rate filter lands when the next is taken."""
DELAYS = (0, 2, 4, 6, 8, 10)
SEEDS = tuple(range(12))


class Work(NamedTuple):
    """Operations: a step's on average, and those that must be done within the longest step.

    Of the dual rate filter only its high-rate task must; the rest has until the correction lands.
    """

    mean: float
    longest: int


class Row(NamedTuple):
    """error (3,): of the estimate from the truth, in all steps. delay: in steps."""

    sensors: Sensors
    way: Way
    delay: int
    runs: int
    error: Rms
    work: Work


def late_study(
    seeds: Sequence[int] = SEEDS,
    delays: Sequence[int] = DELAYS,
    *,
    backend: BackendName = "compiled",
    progress: Progress = lambda _done, _total, _what: None,
) -> tuple[Row, ...]:
    """A row for each way that can do with the sensors and the delay; the same measurements for all."""
    truths = [oscillation(SETTING, seed).truth for seed in seeds]
    asked = [(s, w, d) for s in SENSORS for w in WAYS for d in delays if is_possible(s, w, d)]
    rows = []
    for done, (sensors, way, delay) in enumerate(asked):
        progress(done, len(asked), f"{way}, {delay} steps late")
        runs = [errors(sensors, way, delay, truth, seed, backend) for truth, seed in zip(truths, seeds, strict=True)]
        spread = rms([list(each) for each in np.array(runs).transpose(2, 0, 1)])
        rows.append(Row(sensors, way, delay, len(runs), spread, work(sensors, way, delay)))
    progress(len(asked), len(asked), "late measurements")
    return tuple(rows)


def is_possible(sensors: Sensors, way: Way, delay: int) -> bool:
    """The dual rate filter works with one sensor, and its correction lands after the measurement has come."""
    return way != "dual-rate" or (sensors == "position" and delay < EVERY)


def filter_of(sensors: Sensors, delay: int) -> ModularFilter:
    """The tracker of the dropout study, its position slow and late."""
    jerk_noise = SETTING.tuning * frequency(OSCILLATOR) ** 2.5
    instruments = Instrument(POSITION_SIGMA_M, EVERY), Instrument(ACCELERATION_SIGMA)
    both = tracker(step_s(SETTING), jerk_noise, *instruments)
    late = {sensor.name: sensor for sensor in both.sensors}
    late["position"] = replace(late["position"], delay=delay)
    kept = [late[name] for name in sensors.split(" and ")]
    return ModularFilter(both.predictor, kept, both.dt)


def errors(
    sensors: Sensors, way: Way, delay: int, truth: FloatArray, seed: int, backend: BackendName = "compiled"
) -> FloatArray:
    """Estimate less truth (steps, 3) of the settled part of a run."""
    composed = filter_of(sensors, delay)
    history = estimate(composed, way, observe(composed, truth, seed), len(truth) - 1, backend)
    settled = SETTLED_PERIODS * SETTING.rate
    return history.x[settled:] - truth[settled:]


def estimate(
    composed: ModularFilter, way: Way, measurements: list[Measurement], steps: int, backend: BackendName = "compiled"
) -> ModularHistory:
    """What the filter makes of them.

    The dual rate filter is never compiled: it is called step by step, and to pass a model to compiled code takes ten
    times as long as such a step.
    """
    x0, P0 = start()
    inputs = np.zeros((steps, 0))
    if way == "fuse-as-fresh":
        new = [measurement._replace(taken=measurement.arrives) for measurement in measurements]
        return run(composed, x0, P0, inputs, new, history=0, backend=backend)
    by = "reference" if way == "dual-rate" else backend
    return run(composed, x0, P0, inputs, measurements, late=way, backend=by)


def work(sensors: Sensors, way: Way, delay: int) -> Work:
    """The work of `EVERY` steps, by the counts of its jobs."""
    if way == "dual-rate":
        return _work_of_dual_rate(delay)
    jobs = modular_jobs(filter_of(sensors, delay), np.zeros(3), np.diag(AMPLITUDES**2 / 2))
    operations = {part: count(job.function, *job.arguments(0)).total for part, job in jobs.items()}
    predict, position = operations["predict"], operations["correct.position"]
    acceleration = operations.get("correct.acceleration", 0)
    ordinary = predict + acceleration
    last = ordinary + position
    before = [ordinary] * (EVERY - 1)
    if delay and way == "recalculate":  # the step in which it was taken is corrected again, the rest done again
        last = position + acceleration + delay * ordinary
    if delay and way == "larsen":
        accumulating = operations["predict_accumulate"]
        waiting = accumulating + operations.get("correct_accumulate.acceleration", 0)
        last = accumulating + operations["correct_late.position"] + acceleration
        before = [waiting] * (delay - 1) + [ordinary] * (EVERY - delay)
    steps = [*before, last]
    return Work(sum(steps) / EVERY, max(steps))


def _work_of_dual_rate(delay: int) -> Work:
    x0, P0 = start()
    system = composed_system(filter_of("position", delay), P0, 0)
    jobs = ALL_METHODS["dual-rate"].jobs(system, "short", 0, x0)
    operations = {kind: count(job.function, *job.arguments(0)).total for kind, job in jobs.items()}
    step, restart, update = (operations[kind] for kind in ("hr_propagate", "hr_restart", "hr_update"))
    slow = operations["lr_propagate"] + operations["lr_update"]
    return Work(((EVERY - 1) * step + restart + update + slow) / EVERY, step + update)
