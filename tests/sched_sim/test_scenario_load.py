"""What a scenario asks of the processor: by hand, and beside what the simulation was busy with."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.cli.overload import causes
from sched_sim.scenario import Scenario, Sensor
from sched_sim.scenario_file import read_scenario
from sched_sim.scenario_load import catching_up, demand, loads
from sched_sim.scenario_run import run_scenario
from sched_sim.tasks import Task

ROCKET = read_scenario(Path(__file__).parent / "rocket.toml")


def scenario(speed: int, **more: object) -> Scenario:
    """A step asks 4, a correction of s 6 and 5 replays every 20 steps, the barometer 3 in every third, the task 1."""
    fields: dict[str, object] = {
        "steps": 400,
        "sensors": [Sensor("s", 20, (4, 6), land_by=12), Sensor("barometer", 3, (0,), land_by=3, priority=10)],
        "costs": {
            "predict": [Fraction(3), Fraction(5)],
            "correct.s": [Fraction(6)],
            "correct.barometer": [Fraction(3)],
            "predict_accumulate": [Fraction(9)],
            "correct_accumulate.barometer": [Fraction(3)],
            "correct_late.s": [Fraction(7)],
        },
        "tasks": [Task("control", Fraction(2), Fraction(2), priority=5)],
    }
    return Scenario("x", speed=Fraction(speed), **(fields | more))


def test_loads_are_mean_costs_over_mean_periods() -> None:
    by_name = {load.name: 10 * load.share for load in loads(scenario(10))}
    again = 4 + 6 / 20 + 1
    assert by_name == pytest.approx(
        {
            "predict": 4,
            "correct s": 6 / 20,
            "replay for s": 5 / 20 * again,
            "correct barometer": 1,
            "control": 1,
        }
    )
    assert demand(scenario(10)) == [pytest.approx(sum(by_name.values()) / 10)]


def test_larsen_accumulates_while_a_measurement_is_in_flight_and_replays_nothing() -> None:
    by_name = {load.name: 10 * load.share for load in loads(scenario(10, late="larsen"))}
    share = 5 / 20
    assert by_name == pytest.approx(
        {"predict": share * 9 + (1 - share) * 4, "correct s": 7 / 20, "correct barometer": 1, "control": 1}
    )


def test_with_two_processors_each_has_its_own_demand() -> None:
    first, second = demand(scenario(10, cpus=2))
    assert (first, second) == (pytest.approx((4 + 1) / 10), pytest.approx((6 / 20 + 5 / 20 * 5.3 + 1) / 10))


@pytest.mark.parametrize("late", ["recalculate", "larsen"])
def test_demand_is_what_the_simulation_was_busy_with(late: str) -> None:
    asked = replace(scenario(40, steps=2000), late=late)
    assert demand(asked) == [pytest.approx(float(run_scenario(asked).schedule.utilization), rel=0.03)]


def test_a_correction_catches_up_only_if_a_step_leaves_more_than_it_takes_to_do_again() -> None:
    """More urgent work takes 4 + 1 + 1 of a step; to do a step again takes 5.3."""
    for speed, lands in ((11, False), (14, True)):
        asked = scenario(speed)
        found = catching_up(asked, asked.sensors[0])
        assert found is not None
        assert found == pytest.approx((5.3, speed - 6))
        assert found.never != lands
        outcome = run_scenario(asked)
        assert (outcome.sensors["s"].not_landed == 0) == lands
        assert any("corrections of s never catch up" in line for line in causes(asked, outcome)) != lands
    assert catching_up(asked, asked.sensors[1]) is None
    assert catching_up(scenario(11, late="larsen"), asked.sensors[0]) is None


def test_too_much_work_is_explained_and_enough_time_needs_no_words() -> None:
    asked = scenario(6)
    (demanded, never) = causes(asked, run_scenario(asked))
    assert demanded.startswith(f"demand is {demand(asked)[0]:.1%} of the processor, so that work piles up: predict 67%")
    assert never.endswith("takes 5.3 cost units to do again, and more urgent jobs leave 0 cost units in each")
    assert causes(ROCKET, run_scenario(ROCKET)) == []
