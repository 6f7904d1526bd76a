"""A scenario that is a design has the design's exact probability: a simulation of it says the same."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Late, Scenario, Sensor
from sched_sim.schedule.tasks import Task
from studies.probability.beside_sampled import beside_sampled
from studies.probability.of_scenario import as_designs

Costs = Mapping[str, Sequence[Fraction]]
CONTROL = Task("control", 2, 1, 3, offset=0)


def costs(**known: Sequence[float]) -> Costs:
    return {part.replace("__", "."): [Fraction(str(value)) for value in values] for part, values in known.items()}


RECALCULATE = costs(predict=(1, 1.5, 2), correct__gps=(2, 3, 4))
FAST = costs(predict=(0.5, 1, 2.5), correct__gps=(0.5,))
SLOW = costs(predict=(1, 2, 3), correct__gps=(2, 3, 22))
CARRIED = costs(predict=(3, 5, 6), correct__gps=(2, 3, 4), carry__gps=(1, 2), land__gps=(2, 3), beside__gps=(1,))
DUAL_RATE = costs(
    hr_propagate=(5, 6), hr_restart=(2, 4), hr_update=(2, 5), lr_propagate=(4, 8),
    gain__gps=(3, 6, 9), lr_correct__gps=(2, 6), hr_pass__gps=(1,),
)  # fmt: skip


def scenario(late: Late, known: Costs, delays: Sequence[int], speed: int = 10, **more: Any) -> Scenario:
    sensor = {"priority": 20 if late == "dual-rate" else 5, "land_by": max(delays) + (late == "dual-rate")} | more
    tasks = sensor.pop("tasks", ())
    gps = Sensor("gps", 10, delays, **sensor)
    return Scenario("one", 8_000, Fraction(speed), [gps], known, late=late, tasks=tasks)


@pytest.mark.parametrize(
    "one",
    [
        scenario("recalculate", RECALCULATE, (4,), tasks=[CONTROL]),
        scenario("recalculate", RECALCULATE, (2, 4, 5), dropout=0.3),
        scenario("recalculate", SLOW, (4,), priority=20, land_by=5),
        scenario("recalculate", FAST, (2, 4), speed=2, priority=20, land_by=5, dropout=0.1),
        scenario("carried-gain", CARRIED, (10,)),
        scenario("carried-gain", CARRIED, (1, 4, 6), speed=9, dropout=0.2),
        scenario("dual-rate", DUAL_RATE, (2, 4, 5), land_by=6),
        scenario("dual-rate", DUAL_RATE, (4,), land_by=6, speed=10, tasks=[CONTROL]),
    ],
    ids=[
        "held up",
        "random",
        "preempted",
        "preempted, random",
        "carried",
        "carried, random",
        "dual-rate, random",
        "dual-rate, task",
    ],
)
def test_sampled_and_exact_are_near(one: Scenario) -> None:
    exact, sampled = beside_sampled(one), run_scenario(one)
    assert {"predict"} <= exact.misses.keys() <= sampled.jobs.keys()
    some = 0
    for kind, (bounds, floor) in exact.misses.items():
        jobs = sampled.jobs[kind]
        assert jobs.miss_interval is not None
        low, high = jobs.miss_interval
        slack = high - low
        assert low - slack <= bounds.upper
        assert bounds.lower <= high + slack
        assert floor == 0
        some += 0 < bounds.lower < 1
    assert some


def test_the_reason_is_said_where_there_is_none() -> None:
    one = scenario("recalculate", RECALCULATE, (4,))
    (gps,) = one.sensors
    other = replace(gps, name="baro")
    both = {**RECALCULATE, "correct.baro": RECALCULATE["correct.gps"]}
    larsen = costs(
        predict=(1,), predict_accumulate=(1,), correct_late__gps=(1,), correct__gps=(1,), correct_accumulate__gps=(1,)
    )
    for wrong, said in (
        (replace(one, sensors=[gps, other], costs=both), "2 sensors"),
        (replace(one, cpus=2), "one processor"),
        (replace(one, late="larsen", costs=larsen), "Larsen's method"),
        (replace(one, sensors=[replace(gps, every=Fraction(21, 2))]), "whole steps from step 0"),
        (replace(one, sensors=[replace(gps, offset=3)]), "whole steps from step 0"),
        (replace(one, sensors=[replace(gps, delays=(12,), land_by=12)]), "before another has arrived"),
        (replace(one, sensors=[replace(gps, priority=10)]), "priority 10 of sensor and predictor"),
        (replace(one, tasks=[replace(CONTROL, offset="any")]), "task 'control' has no fixed offset"),
        (replace(one, tasks=[replace(CONTROL, priority=5)]), "task 'control' has the priority of"),
        (scenario("carried-gain", CARRIED, (4,), priority=20), "a correction that they preempt lands"),
        (scenario("carried-gain", CARRIED, (4,), speed=2), "takes longer than an HR period"),
    ):
        why = as_designs(wrong)
        assert isinstance(why, str)
        assert said in why
    rare = {**DUAL_RATE, **costs(lr_correct__gps=(2, 6, 90))}
    crowded = scenario("dual-rate", rare, (4,), land_by=6, speed=20)
    assert "after the next measurement was taken" in beside_sampled(crowded).why
    assert "the load is 1" in beside_sampled(scenario("dual-rate", DUAL_RATE, (4,), land_by=6, speed=7)).why


def test_samples_from_a_file_resolve_no_more_than_they_are() -> None:
    one = replace(scenario("recalculate", RECALCULATE, (4,)), files=["costs.toml"])
    assert all(exact.floor == 1 for exact in beside_sampled(one).misses.values())  # of three samples each
