"""Scenarios that cannot be."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from sched_sim.errors import InputError
from sched_sim.scenario.scenario import Sensor
from sched_sim.schedule.tasks import Task
from tests.scenarios import BY_HAND, scenario, sensor


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"every": 0}, "every 0 must be at least 1"),
        ({"offset": -1}, "offset -1 must be 0 or more"),
        ({"dropout": 1.2}, "dropout 1.2 must be from 0 to 1: it is a probability"),
        ({"delays": (-3,)}, "delay -3 must be 0 or more"),
        ({"delays": ()}, "delay has nothing to draw from"),
        ({"land_by": 3}, "land_by 3 must not be less than the least delay 4"),
    ],
)
def test_a_sensor_that_cannot_be_is_refused_by_name(settings: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=f"sensor 'gps': .*{said}"):
        Sensor(**({"name": "gps", "every": 10, "delays": (4,), "land_by": 10} | settings))


def test_two_tasks_of_one_name_are_refused() -> None:
    with pytest.raises(InputError, match="task name 'control' is used twice; give each task its own"):
        scenario(10, BY_HAND, sensor("gps", 20, 2), tasks=[Task("control", 4, 1, 5), Task("control", 2, 1, 5)])


def test_two_sensors_of_one_name_are_refused() -> None:
    with pytest.raises(InputError, match="sensor 'gps' is there 2 times: give each its own name"):
        scenario(10, BY_HAND, sensor("gps", 20), sensor("gps", 10), steps=8)


def test_all_that_is_wrong_is_said_at_once() -> None:
    fine = scenario(10, BY_HAND, sensor("gps", 20, 2), steps=8)
    with pytest.raises(
        InputError, match=r"steps 0 must.*speed 0 must.*no costs of correct\.radar: give sensor 'radar' a"
    ):
        replace(fine, steps=0, speed=Fraction(0), sensors=[sensor("radar", 20, 2)])


@pytest.mark.parametrize("delays", [range(10**10), [0, 10**30]])
def test_a_scenario_of_more_steps_than_anyone_waits_for_is_refused_at_once(delays: Sequence[int]) -> None:
    with pytest.raises(
        InputError, match=r"sensor 'gps': delay (9999999999|10{30}) is above 10,000,000 HR steps: give fewer"
    ):
        Sensor("gps", 10, delays, land_by=10)
    with pytest.raises(InputError, match="steps 99999999999 is above 10,000,000: simulate fewer HR steps"):
        scenario(10, BY_HAND, sensor("gps", 20), steps=99999999999)


def test_larsen_needs_costs_of_its_own() -> None:
    said = (
        'costs of predict_accumulate, correct_late.gps: late = "larsen" takes them from a costs file, not from `cost`: '
        "write there [samples] predict_accumulate = [...] and [samples.correct_late] gps = [...], beside its name"
    )
    with pytest.raises(InputError, match=re.escape(said)):
        scenario(10, BY_HAND, sensor("gps", 20, 2), steps=8, late="larsen")


@pytest.mark.parametrize(
    ("late", "way", "kind"), [("carried-gain", "", ""), ("larsen", " with several measurements in flight", "_product")]
)
def test_so_does_what_carries_several(late: str, way: str, kind: str) -> None:
    carry = "carry_product" if kind else "carry.gps"
    parts = f"{carry}, beside{kind}.gps, beside{kind}.imu, land{kind}.gps"
    with pytest.raises(InputError, match=re.escape(f'no costs of {parts}: late = "{late}"{way} takes them')):
        scenario(10, BY_HAND, sensor("gps", 2, 5), sensor("imu", 1), steps=8, late=late)
