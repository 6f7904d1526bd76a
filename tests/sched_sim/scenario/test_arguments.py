"""Scenarios built in Python: numbers as people write them, and errors that name the argument."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sched_sim import InputError, Scenario, Sensor, Task, run_scenario

GPS = Sensor("gps", 10, (4,), land_by=10)


def built(**settings: Any) -> Scenario:
    fields: dict[str, Any] = {
        "steps": 200,
        "speed": 1,
        "sensors": [GPS],
        "costs": {"predict": [0.1], "correct.gps": [0.5]},
    }
    return Scenario("built", **(fields | settings))


def sensor(**settings: Any) -> Sensor:
    fields: dict[str, Any] = {"every": 10, "delays": (4,), "land_by": 10}
    return Sensor("gps", **(fields | settings))


@pytest.mark.parametrize("speed", [0.8, "4/5", "0.8", Decimal("0.8"), Fraction(4, 5), np.float64(0.8)], ids=repr)
def test_numbers_are_what_they_write(speed: Any) -> None:
    expected = built(speed=Fraction(4, 5), hr_hz=Fraction(4, 5), context_switch=Fraction(4, 5))
    assert built(speed=speed, hr_hz=speed, context_switch=speed) == expected
    assert built(cpus=np.int64(2), steps=np.int64(50), seed=np.int32(1)) == built(cpus=2, steps=50, seed=1)
    costs = {"predict": Fraction(4, 5), "correct.gps": [Fraction(4, 5)]}
    assert built(costs={"predict": speed, "correct.gps": [speed]}) == built(costs=costs)


@pytest.mark.parametrize(
    "delays", [[4, 6], np.array([4, 6]), iter((4, 6)), (np.int64(4), 6)], ids=lambda values: type(values).__name__
)
def test_delays_are_any_numbers(delays: Any) -> None:
    assert sensor(delays=delays) == sensor(delays=(4, 6))
    assert sensor(delays=4) == sensor(delays=(4,)) == sensor(delays=np.int64(4))


def test_what_comes_from_an_iterator_stays() -> None:
    task = Task("control", 2, 0.2, 5)
    scenario = built(tasks=iter([task]), sensors=iter([GPS]))
    assert scenario == built(tasks=[task], sensors=[GPS])
    assert run_scenario(scenario).jobs["task:control"].released == 100


BAD: dict[str, tuple[Callable[[], Any], str]] = {
    "name": (lambda: Sensor(5, 10, (4,), 10), "sensor 5: name is 5: give text"),  # type: ignore[arg-type]
    "every": (lambda: sensor(every="often"), "sensor 'gps': every is 'often': give a finite number"),
    "more often than a step": (lambda: sensor(every=0.5), "sensor 'gps': every 1/2 must be at least 1"),
    "land_by": (lambda: sensor(land_by="10"), "land_by is '10': give a whole number"),
    "offset": (lambda: sensor(offset=None), "offset is 'None': give a finite number"),
    "priority": (lambda: sensor(priority="high"), "priority is 'high': give a whole number"),
    "delays": (lambda: sensor(delays="late"), "delays is 'late': give a finite number"),
    "a range": (lambda: sensor(delays={"least": 3, "most": 5}), "give a number of steps, a list, or range(least, most"),
    "one delay": (lambda: sensor(delays=[4, "late"]), "delays is 'late': give a finite number"),
    "no delays": (lambda: sensor(delays=np.array([])), "delay has nothing to draw from"),
    "dropout": (lambda: sensor(dropout="often"), "dropout is 'often': give a finite number"),
    "nan": (lambda: sensor(dropout=float("nan")), "dropout is 'nan': give a finite number"),
    "steps": (lambda: built(steps="100"), "scenario 'built': steps is '100': give a whole number"),
    "speed": (lambda: built(speed="fast"), "speed is 'fast': give a finite number"),
    "hr_hz": (lambda: built(hr_hz=0), "hr_hz is 0: it must be greater than 0"),
    "context_switch": (lambda: built(context_switch=-1), "context_switch -1 must be 0 or more cost units"),
    "cpus": (lambda: built(cpus=3), "cpus is 3: choose from 1, 2"),
    "cpus as text": (lambda: built(cpus="2"), "cpus is '2': give a whole number"),
    "late": (lambda: built(late="newest"), "late is 'newest': choose from 'recalculate', 'larsen'"),
    "seed": (lambda: built(seed=0.5), "seed is 0.5: give a whole number"),
    "no sensors": (lambda: built(sensors=[]), "sensors is empty: give at least one Sensor"),
    "sensors": (lambda: built(sensors=["gps"]), "sensors holds 'gps': give a list of Sensor"),
    "tasks": (lambda: built(tasks=[1]), "tasks holds 1: give a list of Task"),
    "costs": (lambda: built(costs=[0.1]), 'costs is [0.1]: give execution times by part, such as {"predict": [0.1]}'),
    "no cost": (lambda: built(costs={"predict": [0]}), "costs of predict is 0: it must be greater than 0"),
    "all at once": (
        lambda: built(steps=0, cpus=3, late="never", sensors=None),
        "steps 0 must be at least 1: it is how many HR steps are simulated; sensors holds None: give a list of Sensor; "
        "late is 'never': choose from 'recalculate', 'larsen', 'carried-gain', 'dual-rate'; cpus is 3: choose from "
        "1, 2",
    ),
    "a path": (lambda: run_scenario("late.toml"), "scenario is a str: give read_scenario(...)"),  # type: ignore[arg-type]
    "a Path": (lambda: run_scenario(Path("late.toml")), "Path: give read_scenario(...)"),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("case", BAD)
def test_errors_name_the_argument(case: str) -> None:
    call, message = BAD[case]
    with pytest.raises(InputError) as caught:
        call()
    assert message in str(caught.value)


def test_an_outcome_prints_in_a_few_lines() -> None:
    assert len(repr(run_scenario(built(steps=2000)))) < 1500


def test_a_schedule_of_a_scenario_says_nothing_of_cycles() -> None:
    """Its corrections are in the outcome, by sensor."""
    shown = run_scenario(built()).schedule._repr_html_()
    assert "landed" not in shown
    assert "responses in HR periods" in shown


def test_steps_are_numbers_as_people_write_them() -> None:
    """In the repr too, whole ones are whole numbers."""
    third = Fraction(40, 3)
    assert sensor(every="40/3", delays=["9/2", 4.5], offset=0.5, land_by=10) == sensor(
        every=third, delays=(Fraction(9, 2), Fraction(9, 2)), offset=Fraction(1, 2)
    )
    assert repr(sensor(every=Fraction(10), delays=[Fraction(4)])) == repr(sensor(every=10, delays=[4]))
