"""A scenario beside the filter that it stands for: the same work, and the same measurements refused."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple
from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from filters.modular import (
    Measurement,
    ModularFilter,
    carried_gain,
    extended_corrector,
    extended_predictor,
    in_flight,
    larsen,
    linear_corrector,
    linear_predictor,
    run,
)
from filters.modular import Sensor as FilterSensor
from sched_sim.scenario.instants import Steps
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import PRODUCTS, Sensor
from tests.scenarios import BY_HAND, HR, LR, scenario, sensor

QUOTIENTS = st.sampled_from([Fraction(4, 3), Fraction(5, 2), Fraction(7, 2)])
"""Of HR steps: what is between two of them."""

# ------------------------------------------------------------------------------- the work is that of the filter


def fated(sensors: Sequence[Sensor], steps: int, seed: int) -> list[Measurement]:
    """The measurements of such a simulation that arrive."""
    found = []
    for each in sensors:
        drawn = each.measurements(steps, seed)
        found += [Measurement(each.name, k, k + delay, np.zeros(1)) for k, delay in drawn if delay is not None]
    return found


class Work(NamedTuple):
    """Of a whole run: predictions, and corrections by each sensor's name."""

    predicts: int
    corrections: dict[str, int]


def of_the_filter(sensors: Sequence[Sensor], steps: int, seed: int) -> Work:
    """Calls of f and h, less those with which they are tried before."""
    calls: Counter[str] = Counter()

    def counted(name: str) -> Any:
        def function(x: Any, *rest: Any) -> None:
            calls[name] += 1
            rest[-1][:] = x

        return function

    def jacobian(_x: Any, *rest: Any) -> None:
        rest[-1][:] = 1.0

    one = np.eye(1)
    composed = ModularFilter(
        extended_predictor(counted("predict"), one, jacobian),
        [FilterSensor(each.name, extended_corrector(counted(each.name), one, jacobian)) for each in sensors],
    )
    longest = max(each.longest_delay for each in sensors)

    def counts(measurements: Sequence[Measurement]) -> Counter[str]:
        calls.clear()
        run(composed, np.zeros(1), one, np.zeros((steps - 1, 0)), measurements, history=longest)
        return calls.copy()

    idle, busy = counts([]), counts(fated(sensors, steps, seed))
    tried = {name: count - (steps - 1) * (name == "predict") for name, count in idle.items()}
    return Work(busy["predict"] - tried["predict"], {each.name: busy[each.name] - tried[each.name] for each in sensors})


def of_the_scenario(sensors: Sequence[Sensor], steps: int, seed: int) -> Work:
    """From the busy time: each part takes a power of a thousand."""
    names = [each.name for each in sensors]
    entries = {"predict": 1} | {f"correct.{name}": 1000 ** (number + 1) for number, name in enumerate(names)}
    speed = 1000 ** (len(names) + 2)
    schedule = run_scenario(scenario(speed, entries, *sensors, steps=steps, seed=seed)).schedule
    units = schedule.utilization * steps * speed
    assert units.denominator == 1
    digits = [units.numerator // 1000**place % 1000 for place in range(len(names) + 1)]
    return Work(digits[0], dict(zip(names, digits[1:], strict=True)))


def roll_backs(sensors: Sequence[Sensor], steps: int, seed: int) -> int:
    """In how many steps something late arrives."""
    return len({one.arrives for one in fated(sensors, steps, seed) if one.taken < one.arrives < steps})


@given(
    delays=st.lists(st.lists(st.integers(0, 5) | QUOTIENTS, min_size=1, max_size=3), min_size=1, max_size=3),
    every=st.lists(st.integers(1, 4) | QUOTIENTS, min_size=3, max_size=3),
    offset=st.integers(0, 2) | QUOTIENTS,
    priority=st.sampled_from([HR, LR]),
    seed=st.integers(0, 9),
)
@settings(max_examples=60, deadline=None)
def test_on_a_fast_processor_the_work_is_the_filters_and_the_prediction_of_each_step_that_is_rolled_back(
    delays: list[list[Steps]], every: list[Steps], offset: Steps, priority: int, seed: int
) -> None:
    """The filter's first step has no prediction, the scenario's has."""
    steps = 16
    sensors = [
        sensor(f"s{number}", every[number], drawn, offset=number * offset, priority=priority, dropout=0.2)
        for number, drawn in enumerate(delays)
    ]
    needed = of_the_filter(sensors, steps, seed)
    charged = of_the_scenario(sensors, steps, seed)
    assert charged.predicts == 1 + needed.predicts + roll_backs(sensors, steps, seed)
    assert charged.corrections == needed.corrections


def test_two_late_measurements_of_one_step_replay_once() -> None:
    """Of steps 0 and 1, arriving in step 3: the filter does steps 1 to 3 once more, with step 3's own prediction."""
    sensors = [sensor("gps", 100, 3), sensor("camera", 100, 2, offset=1)]
    assert of_the_filter(sensors, 5, 0) == Work(4 + 2, {"gps": 1, "camera": 1})
    assert of_the_scenario(sensors, 5, 0) == Work(5 + 3, {"gps": 1, "camera": 1})


@given(every=st.fractions(1, 20, max_denominator=12), steps=st.integers(1, 60))
def test_both_take_measurements_in_the_same_steps(every: Fraction, steps: int) -> None:
    one = np.eye(1)
    assert FilterSensor("s", linear_corrector(one, one), every=every).takes(steps) == [*sensor("s", every).takes(steps)]


# ------------------------------------------------------------------------------- one late measurement at a time


LARSENS = BY_HAND | {"predict_accumulate": 4, "correct_late.gps": 2, "correct_late.camera": 2, "correct.camera": 1}
LARSENS |= {f"{kind}.{name}": 1 for kind in PRODUCTS[1:3] for name in ("gps", "camera")} | {"carry_product": 1}


def test_what_never_arrives_is_in_no_ones_way() -> None:
    """In the filter's eyes: of two sensors that overlap always, one is always lost."""
    lost = sensor("camera", 4, 3, dropout=1.0)
    assert scenario(10, LARSENS, sensor("gps", 4, 4), lost, steps=20, late="larsen").carries is None


@given(
    every=st.sampled_from([6, Fraction(20, 3)]),
    delays=st.lists(st.integers(0, 9) | QUOTIENTS, min_size=1, max_size=3),
    others=st.lists(st.integers(0, 2), min_size=1, max_size=2),
    offset=st.integers(0, 8) | QUOTIENTS,
    dropout=st.sampled_from([0.0, 0.5, 0.9]),
    seed=st.integers(0, 9),
)
@settings(max_examples=100, deadline=None)
def test_larsen_carries_several_where_the_filter_does(
    every: Steps, delays: list[Steps], others: list[int], offset: Steps, dropout: float, seed: int
) -> None:
    steps = 30
    gps = sensor("gps", every, delays, dropout=dropout)
    camera = sensor("camera", 12, others, offset=offset, dropout=dropout)
    entries = LARSENS | {"correct_accumulate.gps": 1, "correct_accumulate.camera": 1}
    of = scenario(10, entries, gps, camera, steps=steps, seed=seed, late="larsen")
    assert (of.carries == PRODUCTS) == carried_by_the_filter([gps, camera], steps, seed)


def carried_by_the_filter(sensors: Sequence[Sensor], steps: int, seed: int) -> bool:
    """Whether it carries several products, for all measurements that are taken in so many steps."""
    one = np.eye(1)
    composed = ModularFilter(
        linear_predictor(one, one), [FilterSensor(each.name, linear_corrector(one, one)) for each in sensors]
    )
    with pytest.MonkeyPatch.context() as patch:
        carried = Mock(wraps=larsen.run_in_flight)
        patch.setattr(larsen, "run_in_flight", carried)
        run(composed, np.zeros(1), one, np.zeros((steps + 10, 0)), fated(sensors, steps, seed), late="larsen")
    return carried.called


# ---------------------------------------------------------------------------------------- several in flight at once


@given(
    delays=st.lists(st.lists(st.integers(0, 9), min_size=1, max_size=3), min_size=1, max_size=3),
    every=st.lists(st.integers(1, 4) | QUOTIENTS, min_size=3, max_size=3),
    priority=st.sampled_from([HR, LR]),
    seed=st.integers(0, 9),
)
@settings(max_examples=40, deadline=None)
def test_on_a_fast_processor_as_many_are_carried_and_land_as_in_the_filter(
    delays: list[list[int]], every: list[Steps], priority: int, seed: int
) -> None:
    steps, base = 16, 1000
    sensors = [
        sensor(f"s{number}", every[number], drawn, offset=number, priority=priority)
        for number, drawn in enumerate(delays)
    ]
    assume(any(each.delayed for each in sensors))
    works = {"predict": 1, "carry": base, "land": base**2, "correct": base**3, "beside": base**4}
    entries = {f"{kind}.{each.name}": work for kind, work in works.items() for each in sensors} | {"predict": 1}
    of = scenario(base**6, entries, *sensors, steps=steps, seed=seed, late="carried-gain")
    units = int(run_scenario(of).schedule.utilization * steps * base**6)
    assert [units // base**place % base for place in range(4)] == in_the_filter(sensors, steps, seed)


def in_the_filter(sensors: Sequence[Sensor], steps: int, seed: int) -> list[int]:
    """Predictions, with one in step 0; steps of what is carried; landings; corrections of the covariance."""
    one = np.eye(1)
    composed = ModularFilter(
        linear_predictor(one, one), [FilterSensor(each.name, linear_corrector(one, one)) for each in sensors]
    )
    at_once = sum(taken.taken == taken.arrives < steps for taken in fated(sensors, steps, seed))
    with pytest.MonkeyPatch.context() as patch:
        carry, land, take_in = (Mock(wraps=each) for each in (in_flight.carry, carried_gain.land, carried_gain.take_in))
        patch.setattr(in_flight, "carry", carry)
        patch.setattr(carried_gain, "land", land)
        patch.setattr(carried_gain, "take_in", take_in)
        run(composed, np.zeros(1), one, np.zeros((steps - 1, 0)), fated(sensors, steps, seed), late="carried-gain")
    return [steps, carry.call_count, land.call_count, take_in.call_count + at_once]
