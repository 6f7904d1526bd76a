"""What a scenario asks of the processor: by hand, and beside what the simulation was busy with."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from sched_sim.cli.overload import causes
from sched_sim.errors import InputError
from sched_sim.scenario import Scenario, Sensor
from sched_sim.scenario_file import read_scenario
from sched_sim.scenario_load import catching_up, demand, loads, switching
from sched_sim.scenario_run import run_scenario
from sched_sim.tasks import Task
from tests.scenarios import HR, LR, sensor
from tests.scenarios import scenario as case

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
    """A correction of s replays 5 steps and finds the barometer in a third of 6: 26, and is 32 in all. 4 of each step
    are left to it, in which it takes 5 to do one again: it takes what it gets."""
    by_name = {load.name: 10 * load.share for load in loads(scenario(10))}
    assert by_name == pytest.approx(
        {
            "predict": 4,
            "correct s": 6 / 20,
            "replay for s": 26 / 20,
            "correct barometer": 1,
            "control": 1,
            "catching up for s": 4 - 32 / 20,
        }
    )
    assert demand(scenario(10)) == [pytest.approx(1)]


def test_larsen_accumulates_while_a_measurement_is_in_flight_and_replays_nothing() -> None:
    by_name = {load.name: 40 * load.share for load in loads(scenario(40, late="larsen"))}
    share = 5 / 20
    assert by_name == pytest.approx(
        {"predict": share * 9 + (1 - share) * 4, "correct s": 7 / 20, "correct barometer": 1, "control": 1}
    )


def test_with_two_processors_each_has_its_own_demand() -> None:
    """A correction of s takes 32 on average, at most 6 + 6 x 4 + 3 x 3; beside the barometer's, 3 in a third of the
    steps, it may end in the eighth after its own: 8 steps and 3 barometers to do again."""
    first, second = demand(scenario(10, cpus=2))
    assert (first, second) == (pytest.approx((4 + 1) / 10), pytest.approx(((32 + 8 * 4 + 3 * 3) / 20 + 1) / 10))


@pytest.mark.parametrize("late", ["recalculate", "larsen"])
def test_demand_is_what_the_simulation_was_busy_with_or_a_little_more(late: str) -> None:
    asked = replace(scenario(40, steps=2000), late=late)
    (share,) = demand(asked)
    assert 0.99 * share < 1.02 * float(run_scenario(asked).schedule.utilization) < 1.03 * share


def test_a_correction_catches_up_only_if_a_step_leaves_more_than_it_takes_to_do_again() -> None:
    """More urgent work takes 4 + 1 + 1 of a step; to do a step again takes 4 + 1: a correction of s cannot be in it."""
    for speed, lands in ((11, False), (14, True)):
        asked = scenario(speed)
        found = catching_up(asked, asked.sensors[0])
        assert found is not None
        assert found == pytest.approx((5, speed - 6))
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
    assert never.endswith("takes 5 cost units to do again, and more urgent jobs leave 0 cost units in each")
    assert causes(ROCKET, run_scenario(ROCKET)) == []


# ------------------------------------------------------------------------------------------- by hand, and simulated

BOTH = {"predict": 1, "correct.a": 2, "correct.b": 3}
LARSEN = BOTH | {
    "predict_accumulate": 2,
    "correct_accumulate.a": 3,
    "correct_accumulate.b": 7,
    "correct_late.a": 4,
    "correct_late.b": 5,
}


def test_a_sensor_whose_corrections_are_all_late_finds_none_of_its_own() -> None:
    """One in every step, 5 steps late: 0.05 + 0.5 + 5 x 0.05, in a step of 1."""
    every_step = case(1, {"predict": "0.05", "correct.a": "0.5"}, sensor("a", 1, 5), steps=1000)
    assert demand(every_step) == [pytest.approx(0.80)]
    outcome = run_scenario(every_step)
    assert float(outcome.schedule.utilization) == pytest.approx(0.80 - 5 * 0.75 / 1000)  # the first five never come
    assert causes(every_step, outcome) == []


CASES: dict[str, tuple[Scenario, float]] = {
    "those of one step and priority go back once, to the earliest": (
        case(1000, BOTH, sensor("a", 4, 5), sensor("b", 4, 3, offset=2)),
        1 + (2 + 3 + 5) / 4,
    ),
    "those of one step in which others are more urgent find them": (
        case(1000, BOTH, sensor("a", 4, 5, priority=10), sensor("b", 4, 5)),
        1 + (2 + 5) / 4 + (3 + 5 + 2) / 4,  # a's of its own step; that of k + 4 is not there yet
    ),
    "undelayed ones are found in each step": (
        case(1000, BOTH, sensor("a", 4, 5), sensor("b", 1, priority=10)),
        1 + 3 + (2 + 5 + 6 * 3) / 4,
    ),
    "undelayed ones as urgent come after it": (
        case(1000, BOTH, sensor("a", 4, 5), sensor("b", 1)),
        1 + 3 + (2 + 5 + 5 * 3) / 4,
    ),
    "with offsets that never meet": (
        case(1000, BOTH, sensor("a", 4, 1), sensor("b", 4, offset=2, priority=10)),
        1 + 3 / 4 + (2 + 1) / 4,
    ),
    "with rates that have no common step but one": (
        case(1000, BOTH, sensor("a", 4, 5), sensor("b", 3, priority=10)),
        1 + 3 / 3 + (2 + 5 + 6 / 3 * 3) / 4,
    ),
    "later than the next is taken": (case(1000, BOTH, sensor("a", 2, 7)), 1 + (2 + 7) / 2),
    "larsen: one in flight": (
        case(1000, LARSEN, sensor("a", 9, 5), sensor("b", 1, priority=10), late="larsen"),
        (5 * 2 + 4) / 9 + (5 * 7 + 4 * 3) / 9 + 4 / 9,
    ),
    "larsen: landed before the less urgent": (
        case(1000, LARSEN, sensor("a", 9, 5), sensor("b", 1, priority=30), late="larsen"),
        (5 * 2 + 4) / 9 + (4 * 7 + 5 * 3) / 9 + 4 / 9,
    ),
    "larsen: two that take turns": (
        case(1000, LARSEN, sensor("a", 18, 5), sensor("b", 18, 7, offset=9), late="larsen"),
        (12 * 2 + 6) / 18 + (4 + 5) / 18,
    ),
    "larsen: all are lost": (
        case(1000, LARSEN, sensor("a", 9, 5, dropout=1.0), sensor("b", 3, offset=1), late="larsen"),
        2 + 7 / 3,
    ),
    "what takes more than its step catches up": (
        case(10, {"predict": 4, "correct.a": 2}, sensor("a", 20, 2)),
        4 + (2 + 8 + 2 * 4) / 20,  # 6 of each step are left: 18 are done in three, two of them done again
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_demand_is_as_by_hand_and_what_a_long_simulation_is_busy_with(name: str) -> None:
    asked, by_hand = CASES[name]
    asked = replace(asked, steps=3600)
    (share,) = demand(asked)
    assert share * float(asked.speed) == pytest.approx(by_hand)
    busy = float(run_scenario(asked).schedule.utilization)
    assert busy == pytest.approx(share, rel=0.004)
    assert busy <= share * (1 + 1e-3)


@pytest.mark.parametrize("priority", [5, 20])
@pytest.mark.parametrize("dropout", [0.0, 0.3])
def test_random_delays_and_dropout_weigh_by_probability(priority: int, dropout: float) -> None:
    """Both sensors draw; some arrive together, some overtake others."""
    a = sensor("a", 2, [0, 1, 2, 4, 7], dropout=dropout, priority=priority)
    asked = case(1000, BOTH, a, sensor("b", 1, [0, 2, 3], dropout=dropout), steps=8_000)
    assert demand(asked) == [pytest.approx(float(run_scenario(asked).schedule.utilization), rel=0.02)]


def test_larsen_waits_for_a_lost_one_until_the_next_is_taken() -> None:
    """In 6 of 10 it flies 5 of 9 steps, else all 9; in the last the next is taken before the more urgent b corrects."""
    a = sensor("a", 9, 5, dropout=0.4)
    asked = case(1000, LARSEN, a, sensor("b", 1, priority=10), late="larsen", steps=18_000)
    predicts, corrections = 0.6 * 5 / 9 + 0.4, 0.6 * 5 / 9 + 0.4 * 8 / 9
    assert demand(asked)[0] * 1000 == pytest.approx(1 + predicts + 3 + corrections * 4 + 0.6 * 4 / 9)
    assert demand(asked) == [pytest.approx(float(run_scenario(asked).schedule.utilization), rel=0.02)]


def test_corrections_that_wait_for_one_another_go_together_and_pile_up_nothing() -> None:
    """Each for itself, 0.5 + 2 + 5 x 0.5 in each step, would take more than there is."""
    asked = case(4, {"predict": "0.5", "correct.a": "2"}, sensor("a", 1, 5), steps=1000)
    outcome = run_scenario(asked)
    assert max(outcome.sensors["a"].achieved) < 20
    assert demand(asked)[0] == pytest.approx((0.5 + 2 + 2.5) / 4)
    (demanded,) = causes(asked, outcome)
    assert "so that corrections wait for one another and go back together: predict 12%" in demanded


@st.composite
def certain(draw: st.DrawFn) -> Scenario:
    """Up to three sensors without dropout, each with one delay, and one cost of each part."""
    work = st.integers(1, 5)
    names = "abc"[: draw(st.integers(1, 3))]
    entries = {"predict": draw(work)} | {f"correct.{name}": draw(work) for name in names}
    more = {"predict_accumulate": entries["predict"] + 1}
    for name in names:
        more |= {f"correct_accumulate.{name}": 6, f"correct_late.{name}": 7}
    sensors = []
    for name in names:
        every, delay = draw(st.sampled_from([1, 2, 3, 4, 6, 10])), draw(st.sampled_from([0, 0, 1, 2, 3, 5, 8]))
        priority = draw(st.sampled_from([HR - 5, HR, LR, LR, LR + 10]))
        sensors.append(sensor(name, every, delay, offset=draw(st.integers(0, every - 1)), priority=priority))
    speed = sum(entries.values()) * draw(st.sampled_from([1, 2, 5, 20]))
    of = {
        "steps": 600,
        "cpus": draw(st.sampled_from([1, 2])),
        "late": draw(st.sampled_from(["recalculate", "larsen"])),
    }
    try:
        return case(speed, entries | more, *sensors, **of)
    except InputError:  # two in flight at once
        return case(speed, entries | more, *sensors, **of | {"late": "recalculate"})


@settings(max_examples=60)
@given(certain())
def test_where_all_is_certain_the_simulation_is_never_busier_than_the_demand(asked: Scenario) -> None:
    busy = float(run_scenario(asked).schedule.utilization) * asked.cpus
    assert busy <= sum(min(share, 1) for share in demand(asked)) * 1.01


def test_context_switches_are_named_where_they_may_be_too_many() -> None:
    """0.3 + 0.3 + 2 x 0.25 in each step of 1: each job is dispatched once, after the other."""
    asked = case(1, {"predict": "0.3", "correct.a": "0.3"}, sensor("a", 1, 0), context_switch=Fraction(1, 4), steps=400)
    outcome = run_scenario(asked)
    assert outcome.misses
    assert outcome.schedule.utilization == 1
    assert (demand(asked), switching(asked)) == ([pytest.approx(0.6)], [1.0])
    assert causes(asked, outcome) == [
        "demand is 60.0% of the processor, and context switches up to 100.0% more, so that work may pile up"
    ]


@settings(max_examples=60)
@given(certain(), st.fractions(0, 1, max_denominator=8))
def test_context_switches_take_no_more_than_is_said(asked: Scenario, switch: Fraction) -> None:
    urgent = [replace(one, priority=min(one.priority, HR)) for one in asked.sensors]  # none is preempted by a step
    asked = replace(asked, late="recalculate", cpus=1, sensors=urgent, context_switch=switch * asked.speed / 10)
    shares = [a + b for a, b in zip(demand(asked), switching(asked), strict=True)]
    assume(all(share < 1 for share in shares))
    assert float(run_scenario(asked).schedule.utilization) <= sum(shares) * 1.01


def test_a_pattern_of_any_length_is_soon_looked_through() -> None:
    """Rates without a common step for longer than the world will last, and very many delays."""
    sensors = [
        sensor(f"s{number}", every, range(500_000), priority=HR)
        for number, every in enumerate((99_991, 99_989, 10**30))
    ]
    asked = case(1000, {"predict": 1} | {f"correct.{one.name}": 1 for one in sensors}, *sensors)
    assert 1 < demand(asked)[0] * 1000 < 1 + 3 * 250_001 / 99_989 * 10
