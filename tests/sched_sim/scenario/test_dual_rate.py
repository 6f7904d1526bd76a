"""The dual-rate filter of several sensors on the processor: as that of one, by hand, by the tick, and as the filter."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from filters.modular import (
    Measurement,
    ModularFilter,
    dual_rate_in_flight,
    high_rate,
    linear_corrector,
    linear_predictor,
    low_rate,
)
from filters.modular import Sensor as FilterSensor
from filters.modular.low_rate import LowRate
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.scenario.load import demand
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.schedule.outcome import Slice
from tests.scenarios import scenario, sensor, slices_of

COSTS = {"hr_propagate": 4, "hr_restart": 3, "hr_update": 2, "lr_propagate": 5}
"""In a period of 10 or 20."""


def entries(*names: str, **works: int) -> dict[str, Any]:
    kinds = {"gain": 4, "lr_correct": 3, "hr_pass": 1, "gain_again": 6, "gain_kept": 7}
    each = {f"{kind}.{name}": work for kind, work in kinds.items() for name in names}
    return COSTS | each | works


def dual_rate(speed: object, *sensors: Sensor, steps: int, costs: dict[str, Any] | None = None, **of: Any) -> Scenario:
    named = entries(*(each.name for each in sensors))
    return scenario(speed, named | (costs or {}), *sensors, steps=steps, late="dual-rate", **of)


# ---------------------------------------------------------------------------------------------------- of one sensor

works = st.integers(1, 12)


def merged(slices: Sequence[Slice], high_rate: bool) -> list[tuple[Fraction, Fraction]]:
    """When either task ran, in HR periods; pieces that follow one another at once are one."""
    runs: list[tuple[Fraction, Fraction]] = []
    for piece in sorted(slices, key=lambda each: each.start):
        if (piece.kind in ("hr", "predict")) != high_rate or piece.start == piece.end:
            continue
        start, end = Fraction(piece.start, piece.period), Fraction(piece.end, piece.period)
        runs = [*runs[:-1], (runs[-1][0], end)] if runs and runs[-1][1] == start else [*runs, (start, end)]
    return runs


@given(
    timing=st.integers(2, 9).flatmap(lambda N: st.tuples(st.just(N), st.integers(0, N - 1))),
    costs=st.tuples(works, works, works, works, works, works),
    speed=st.integers(8, 60),
    cpus=st.sampled_from([1, 2]),
)
@settings(max_examples=50, deadline=None)
def test_one_sensor_is_the_dual_rate_filter_with_precomputed_gain(
    timing: tuple[int, int], costs: tuple[int, ...], speed: int, cpus: Any
) -> None:
    N, M = timing
    options = Options(lr_propagate_by="l", gain="precomputed", cpus=cpus)
    pieces = DualRateCosts(*map(Fraction, costs))
    known = simulate(pieces, Timing(N, M, N), speed, 4, options, keep_slices=True)
    assume(known.achieved.total() == 4 and max(known.achieved) <= N)
    parts = ("hr_propagate", "hr_restart", "hr_update", "lr_propagate", "gain.s", "lr_correct.s")
    given = dict(zip(parts, costs, strict=True)) | {"hr_pass.s": 99}
    of = scenario(speed, given, sensor("s", N, M, land_by=N), steps=4 * N, late="dual-rate", cpus=cpus)
    slices: list[Slice] = []
    found = run_scenario(of, on_slice=slices.append)
    for high in (True, False):
        assert merged(slices, high) == merged(known.slices, high)
    assert found.sensors["s"].achieved == known.achieved
    assert found.misses == known.misses
    assert found.schedule.utilization == known.utilization


# ---------------------------------------------------------------------------------------------------- by hand


def test_gains_follow_the_predict_job_and_a_correction_lands_in_the_step_after_it() -> None:
    """The gps of step 0: carried on and gain 9, from 4 until 13, with the predict job of step 1, 3, in between.
    It arrives at 40, behind 4: 3 until 47. It is in the state of step 5, whose predict job has 2 more."""
    of = dual_rate(10, sensor("gps", 20, 4, land_by=5), steps=7)
    assert slices_of(of, "gain gps") == [(4, 10), (13, 16)]
    assert slices_of(of, "correct gps") == [(44, 47)]
    assert slices_of(of, "predict") == [(0, 4), (10, 13), (20, 24), (30, 34), (40, 44), (50, 56), (60, 64)]
    found = run_scenario(of)
    assert found.sensors["gps"].achieved == {5: 1}
    assert found.jobs["gain gps"].responses == [1.2]
    assert found.misses == 0


def test_one_that_overtakes_another_has_less_to_go_past() -> None:
    """The gps of step 0 and the camera of step 1, whose image arrives in step 2 and lands in step 3, with none behind
    it. The gps arrives in step 4 and lands in step 5: it goes past the camera's, 1."""
    gps, camera = sensor("gps", 100, 4), sensor("camera", 100, 1, offset=1, land_by=2)
    of = dual_rate(20, gps, camera, steps=7)
    assert slices_of(of, "gain gps") == [(4, 13)]
    assert slices_of(of, "gain camera") == [(23, 32)]
    assert slices_of(of, "correct camera") == [(43, 46)]
    assert slices_of(of, "correct gps") == [(84, 87)]
    lengths = [end - start for start, end in slices_of(of, "predict")]
    assert lengths == [4, 3, 3, 4 + 2, 4, 4 + 2 + 1, 4]
    found = run_scenario(of)
    assert (found.sensors["gps"].achieved, found.sensors["camera"].achieved) == ({5: 1}, {2: 1})


def test_two_that_are_taken_in_one_step_share_the_way_to_it_and_land_one_after_the_other() -> None:
    """Gains 9 and 4. Both arrive in step 2. The first goes past the second, 1, which is told of it, 3."""
    of = dual_rate(20, sensor("gps", 100, 2), sensor("camera", 100, 2), steps=5)
    assert (slices_of(of, "gain gps"), slices_of(of, "gain camera")) == ([(4, 13)], [(13, 17)])
    assert (slices_of(of, "correct gps"), slices_of(of, "correct camera")) == ([(44, 47)], [(47, 50)])
    assert [end - start for start, end in slices_of(of, "predict")] == [4, 3, 4, 4 + 2 + 1 + 3 + 2, 4]


def test_what_is_not_late_waits_for_its_gain() -> None:
    """It is there at 0, and its gain from 4 to 13; it runs until 16, and lands in step 1."""
    of = dual_rate(20, sensor("gps", 100, land_by=1), steps=3)
    assert slices_of(of, "correct gps") == [(13, 16)]
    found = run_scenario(of)
    assert found.sensors["gps"].achieved == {1: 1}
    assert found.jobs["correct gps"].responses == [16 / 20]
    assert found.misses == 0


def test_a_deadline_is_the_start_of_the_step_in_which_it_must_land() -> None:
    """The correction takes until 50 exactly, or one longer."""
    for work, misses in ((6, 0), (7, 1)):
        of = dual_rate(10, sensor("gps", 20, 4, land_by=5), steps=8, costs={"lr_correct.gps": work})
        assert run_scenario(of).misses == misses


def test_after_a_loss_the_gains_behind_it_are_computed_again() -> None:
    """That the gps of step 0 never arrives is known in step 4: 6. The image of step 1 has landed in step 3: 5 for the
    way to it, and 7; that of step 3 has not: 5 and 6. It lands in step 5, past nothing, and of the gps nothing does."""
    gps = sensor("gps", 100, 3, dropout=1.0, land_by=4)
    of = dual_rate(40, gps, sensor("camera", 2, 1, offset=1, land_by=3), steps=6)
    assert slices_of(of, "loss gps") == [(163, 163 + 6 + 5 + 7 + 5 + 6)]
    assert slices_of(of, "correct camera") == [(83, 86), (192, 195)]
    assert [end - start for start, end in slices_of(of, "predict")] == [4, 3, 3, 4 + 2, 3, 4 + 2]
    found = run_scenario(of)
    assert (found.sensors["gps"].dropped, found.sensors["gps"].achieved) == (1, {})
    assert found.sensors["camera"].achieved == {2: 2}
    assert found.jobs["loss gps"].responses == [32 / 40]


# ---------------------------------------------------------------------------------------------------- by the tick


@dataclass(eq=False)
class Taken:
    """A measurement."""

    k: int
    sensor: int
    gained: bool = False
    arrived: bool = False
    corrected: bool = False
    l: int | None = None


@dataclass
class Work:
    """What is left of a job, and what follows."""

    left: int
    then: Callable[[], None]


@dataclass
class ByTheTick:
    """One tick after another, of sensors that lose nothing. low: what waits; its first is under way."""

    sensors: Sequence[Sensor]
    costs: dict[str, int]
    period: int
    high: list[Work] = field(default_factory=list)
    low: list[Work] = field(default_factory=list)
    taken: list[Taken] = field(default_factory=list)

    def simulate(self, steps: int, seed: int) -> list[tuple[str, int, int]]:
        """(sensor, k, l) of all that is ready for a step of the simulation, or for that after it."""
        fates = [dict(each.measurements(steps, seed)) for each in self.sensors]
        for now in range(steps * self.period):
            if now % self.period == 0:
                self.start(now // self.period, fates)
            work = (self.high or self.low or [None])[0]
            if work is not None:
                work.left -= 1
                if work.left == 0:
                    (self.high or self.low).pop(0)
                    work.then()
        for each in self.taken:
            each.l = steps if each.corrected and each.l is None else each.l
        return sorted((self.sensors[each.sensor].name, each.k, each.l) for each in self.taken if each.l is not None)

    def start(self, j: int, fates: Sequence[dict[int, int | None]]) -> None:
        after_one = any(each.k == j - 1 for each in self.taken)
        work = self.costs["hr_restart" if after_one else "hr_propagate"]
        for place, one in enumerate(self.taken):
            if one.corrected and one.l is None:
                one.l = j
                work += self.costs["hr_update"]
                for other in self.taken[place + 1 :]:
                    work += self.costs[f"hr_pass.{self.sensors[other.sensor].name}"]
                    told = other.corrected and other.l is None
                    work += self.costs[f"lr_correct.{self.sensors[other.sensor].name}"] if told else 0
        new = [Taken(j, number) for number, fate in enumerate(fates) if j in fate]
        self.taken += new
        self.high.append(Work(work, lambda: [self.gain(one, one is new[0]) for one in new] and None))
        for one in self.taken:
            if fates[one.sensor][one.k] == j - one.k:
                one.arrived = True
                if one.gained:
                    self.correct(one)

    def gain(self, one: Taken, first: bool) -> None:
        name = self.sensors[one.sensor].name
        work = self.costs[f"gain.{name}"] + (self.costs["lr_propagate"] if first else 0)
        self.low.append(Work(work, lambda: None))
        one.gained = True
        if one.arrived:
            self.correct(one)

    def correct(self, one: Taken) -> None:
        def done() -> None:
            one.corrected = True

        self.low.append(Work(self.costs[f"lr_correct.{self.sensors[one.sensor].name}"], done))


@given(
    every=st.lists(st.integers(1, 6), min_size=3, max_size=3),
    delays=st.lists(st.lists(st.integers(0, 9), min_size=1, max_size=3), min_size=2, max_size=3),
    offset=st.integers(0, 3),
    works=st.lists(st.integers(1, 6), min_size=13, max_size=13),
    period=st.integers(6, 40),
    seed=st.integers(0, 9),
)
@settings(max_examples=50, deadline=None)
def test_several_land_when_a_simulation_of_every_tick_says(
    every: list[int], delays: list[list[int]], offset: int, works: list[int], period: int, seed: int
) -> None:
    """On processors with little time left too, where several land at once and late."""
    sensors = [
        sensor(f"s{number}", every[number], drawn, offset=number * offset, land_by=20)
        for number, drawn in enumerate(delays)
    ]
    parts = ["hr_propagate", "hr_restart", "hr_update", "lr_propagate"]
    parts += [f"{kind}.{each.name}" for each in sensors for kind in ("gain", "lr_correct", "hr_pass")]
    costs = dict(zip(parts, works, strict=False))
    of = scenario(period, costs, *sensors, steps=30, seed=seed, late="dual-rate")
    found = run_scenario(of).sensors
    landings = sorted((each.name, k, l) for each in sensors for k, l in found[each.name].landings)
    assert landings == ByTheTick(sensors, costs, period).simulate(30, seed)


# ---------------------------------------------------------------------------------------------------- as the filter


def of_the_filter(sensors: Sequence[Sensor], steps: int, seed: int, monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each of its jobs is done."""
    calls = Counter[str]()

    def counted(_backend: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def done(*arguments: Any) -> Any:
            calls[function.__name__] += 1
            return function(*arguments)

        return done

    with monkeypatch.context() as patched:
        for module in (high_rate, low_rate):
            patched.setattr(module, "function_for", counted)
        patched.setattr(LowRate, "covariance", lambda *_: np.eye(2))  # that of the history is no job
        of_each = [linear_corrector(np.eye(1, 2, number % 2), [[1.0]]) for number in range(len(sensors))]
        composed = ModularFilter(
            linear_predictor([[1.0, 1.0], [0.0, 1.0]], np.eye(2)),
            [
                FilterSensor(each.name, by, int(each.every), [*each.delays])
                for each, by in zip(sensors, of_each, strict=True)
            ],
        )
        measurements = [
            Measurement(
                each.name, k, k + each.land_by - 1 if delay is None else k + delay, [None if delay is None else 1]
            )
            for each in sensors
            for k, delay in each.measurements(steps, seed)
        ]
        L = {each.name: each.land_by for each in sensors}
        inputs = np.zeros((steps - 1, 0))
        dual_rate_in_flight.run(composed, np.zeros(2), np.eye(2), inputs, measurements, L=L)
    return calls


JOBS = {
    "hr_propagate": "hr_propagate",
    "hr_restart": "hr_restart",
    "hr_update": "hr_update",
    "lr_propagate": "lr_propagate",
    "gain": "take",
    "lr_correct": "lr_correct",
    "hr_pass": "hr_pass",
    "gain_again": "regain",
    "gain_kept": "joseph",
}
"""By the part of a scenario, the filter's function."""


def of_the_scenario(sensors: Sequence[Sensor], steps: int, seed: int) -> dict[str, int]:
    """From the busy time: each part takes a power of ten thousand."""
    base = 10_000
    costs: dict[str, int] = {}
    for place, part in enumerate(JOBS):
        here = [part] if part in COSTS else [f"{part}.{each.name}" for each in sensors]
        costs |= dict.fromkeys(here, base**place)
    speed = base ** (len(JOBS) + 1)
    schedule = run_scenario(scenario(speed, costs, *sensors, steps=steps, seed=seed, late="dual-rate")).schedule
    units = schedule.utilization * steps * speed
    return {part: units.numerator // base**place % base for place, part in enumerate(JOBS)}


@given(
    every=st.lists(st.integers(2, 6), min_size=3, max_size=3),
    delays=st.lists(st.integers(0, 9), min_size=1, max_size=3),
    offset=st.integers(0, 3),
    dropout=st.sampled_from([0.0, 0.3]),
)
@settings(max_examples=30, deadline=None)
def test_on_a_fast_processor_the_work_is_that_of_the_filter(
    every: list[int], delays: list[int], offset: int, dropout: float
) -> None:
    """The filter has no prediction in its first step, and nothing to carry to it. It lands what is lost as all else,
    and gives what lands in that step a gain once more that has been used here."""
    sensors = [
        sensor(f"s{number}", every[number], delay, offset=number * offset, land_by=delay + 1, dropout=dropout)
        for number, delay in enumerate(delays)
        if delay or not dropout  # one that is not late is not known to be taken where it is lost
    ]
    assume(sensors)
    calls, work = of_the_filter(sensors, 24, 0, pytest.MonkeyPatch()), of_the_scenario(sensors, 24, 0)
    needed = {part: calls[name] for part, name in JOBS.items()}
    starts = 0 in {k for each in sensors for k in each.takes(24)}
    needed["hr_propagate"] += 1
    needed["lr_propagate"] += starts
    needed["hr_restart"] -= not starts  # the filter starts as after a measurement
    needed["hr_propagate"] += not starts
    for both in (needed, work) if dropout else ():
        both["gain_again"] += both.pop("gain_kept")
        for part in ("hr_update", "hr_pass", "lr_correct"):
            del both[part]
    assert work == needed


# ---------------------------------------------------------------------------------------------------- what it asks for


@pytest.mark.parametrize("dropout", [0.0, 0.3])
def test_demand_is_the_mean_work_of_a_processor_that_has_the_time(dropout: float) -> None:
    gps = sensor("gps", 20, range(8, 13), land_by=30, dropout=dropout)
    camera = sensor("camera", Fraction(13, 2), [3, 7], land_by=12)
    of = dual_rate(1000, gps, camera, sensor("imu", 2, land_by=3, dropout=dropout), steps=20_000)
    assert demand(of) == pytest.approx([float(run_scenario(of).schedule.utilization)], rel=0.015)


def test_each_processor_has_its_own() -> None:
    of = dual_rate(1000, sensor("gps", 20, 8, land_by=30), sensor("imu", 2, land_by=3), steps=2000, cpus=2)
    high, low = demand(of)
    assert 2000 * 1000 * (high + low) == pytest.approx(
        float(2 * 2000 * 1000 * run_scenario(of).schedule.utilization), rel=0.01
    )
    alone = [end - start for start, end in slices_of(of, "predict")]
    assert high == pytest.approx(sum(alone) / (2000 * 1000), rel=0.01)


# ---------------------------------------------------------------------------------------------------- what is refused


@pytest.mark.parametrize(
    ("sensors", "settings", "said"),
    [
        (
            [sensor("gps", 20, 4, land_by=4)],
            {},
            "sensor 'gps': land_by 4 must be more than the least delay 4: with late = \"dual-rate\" a correction lands "
            "in a later step than that in which its measurement arrives; give 5 or more",
        ),
        (
            [sensor("gps", 20, 4), sensor("camera", 20, 4, priority=15)],
            {},
            "sensor 'camera': priority 15, where 'gps' has 20: with late = \"dual-rate\" one low-rate task",
        ),
        (
            [sensor("gps", 20, 4, priority=10)],
            {},
            "sensor 'gps': priority 10 must be more than 10, that of [predictor]",
        ),
        ([sensor("gps", 20, 4)], {"priority": 30}, "priority 20 must be more than 30, that of [predictor]"),
        (
            [sensor("gps", 20, 4, dropout=0.1), sensor("camera", 20, 4)],
            {"costs": {}},
            "no costs of hr_propagate, hr_restart, hr_update, lr_propagate, gain.gps, lr_correct.gps, hr_pass.gps, "
            "gain_again.gps, gain_kept.gps, gain.camera",
        ),
    ],
)
def test_what_the_low_rate_task_cannot_do_is_refused_by_name(
    sensors: list[Sensor], settings: dict[str, Any], said: str
) -> None:
    names = [each.name for each in sensors]
    with pytest.raises(InputError) as refused:
        Scenario(
            **{
                "name": "s",
                "steps": 40,
                "speed": Fraction(20),
                "sensors": sensors,
                "late": "dual-rate",
                "costs": {part: [Fraction(1)] for part in entries(*names)},
            }
            | settings
        )
    assert said in str(refused.value)
