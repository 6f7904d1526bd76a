"""What a scenario asks of the processor: by hand, and beside what the simulation was busy with."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import floor

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from sched_sim.scenario.causes import causes
from sched_sim.scenario.load import catching_up, demand, loads
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Late, Scenario, Sensor
from sched_sim.scenario.scenario_file import read_scenario
from sched_sim.schedule.tasks import Task
from tests import scenarios
from tests.scenarios import HR, LR, sensor
from tests.scenarios import scenario as case

ROCKET = read_scenario(scenarios.ROCKET)


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
    """A correction of s replays 5 steps and finds the barometer in a third of 6: 26, and is 32 in all."""
    by_name = {load.name: 10 * load.share for load in loads(scenario(10))}
    assert by_name == pytest.approx(
        {
            "predict": 4,
            "correct s": 6 / 20,
            "replay for s": 26 / 20,
            "correct barometer": 1,
            "control": 1,
        }
    )
    assert demand(scenario(10)) == [pytest.approx(0.76)]


def test_larsen_accumulates_while_a_measurement_is_in_flight_and_replays_nothing() -> None:
    by_name = {load.name: 40 * load.share for load in loads(scenario(40, late="larsen"))}
    share = 5 / 20
    assert by_name == pytest.approx(
        {"predict": share * 9 + (1 - share) * 4, "correct s": 7 / 20, "correct barometer": 1, "control": 1}
    )


def test_with_two_processors_each_has_its_own_demand() -> None:
    assert demand(scenario(10, cpus=2)) == [pytest.approx((4 + 1) / 10), pytest.approx((32 / 20 + 1) / 10)]


@pytest.mark.parametrize("late", ["recalculate", "larsen"])
def test_demand_is_what_a_processor_with_much_time_is_busy_with(late: str) -> None:
    asked = replace(scenario(100, steps=2000), late=late)
    assert demand(asked) == [pytest.approx(float(run_scenario(asked).schedule.utilization), rel=0.01)]


def test_a_correction_catches_up_only_if_a_step_leaves_more_than_it_takes_to_do_again() -> None:
    """More urgent work takes 4 + 1 + 1 of a step; to do a step again takes 4 + 1: a correction of s cannot be in it."""
    for speed, lands in ((11, False), (14, True)):
        asked = scenario(speed)
        found = catching_up(asked)["s"]
        assert found == pytest.approx((5, speed - 6))
        assert found.never != lands
        outcome = run_scenario(asked)
        assert (outcome.sensors["s"].not_landed == 0) == lands
        assert (
            any(
                "corrections of s never catch up" in line
                for line in causes(asked, outcome, [float(outcome.schedule.utilization)])
            )
            != lands
        )
    assert [*catching_up(asked)] == ["s"]
    assert not catching_up(scenario(11, late="larsen"))


def test_too_much_work_is_explained_and_enough_time_needs_no_words() -> None:
    asked = scenario(6)
    (demanded, never) = why(asked)
    assert demanded.startswith(f"demand is {demand(asked)[0]:.1%} of the processor, so that work piles up: predict 67%")
    assert never.endswith("takes 5 cost units to do again, and more urgent jobs leave 0 cost units in each")
    assert causes(ROCKET, run_scenario(ROCKET), [1.0]) == []


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
    busy = float(outcome.schedule.utilization)
    assert busy == pytest.approx(0.80 - 5 * 0.75 / 1000)  # the first five never come
    assert causes(every_step, outcome, [busy]) == []


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
}


CARRIED = {"carry": 5, "beside": 4, "land": 6}
CARRIED_COSTS = BOTH | {f"{kind}.{name}": work for kind, work in CARRIED.items() for name in "ab"}
CARRIED_COSTS |= {f"{kind}_product.{name}": CARRIED[kind] for kind in ("beside", "land") for name in "ab"}
CARRIED_COSTS |= {"carry_product": 5}

CASES |= {
    "carried-gain: one in flight": (
        case(1000, CARRIED_COSTS, sensor("a", 9, 5), sensor("b", 1, priority=10), late="carried-gain"),
        1 + 5 / 9 * 5 + 2 / 9 + (3 + 6 / 9 * 4) + 6 / 9,  # beside b's from the step on in which a is taken
    ),
    "carried-gain: landed before the less urgent": (
        case(1000, CARRIED_COSTS, sensor("a", 9, 5), sensor("b", 1, priority=30), late="carried-gain"),
        1 + 5 / 9 * 5 + 2 / 9 + (3 + 5 / 9 * 4) + 6 / 9,
    ),
    "carried-gain: later than the next is taken": (
        case(1000, CARRIED_COSTS, sensor("a", 2, 7), late="carried-gain"),
        1 + 7 / 2 * 5 + (2 + 3 * 4) / 2 + 6 / 2,  # at a take three are in flight
    ),
    "larsen: later than the next is taken": (
        case(1000, CARRIED_COSTS, sensor("a", 2, 7), late="larsen"),
        1 + 7 / 2 * 5 + (2 + 3 * 4) / 2 + 6 / 2,
    ),
    "carried-gain: taken together": (
        case(1000, CARRIED_COSTS, sensor("a", 4, 2), sensor("b", 4, 3), late="carried-gain"),
        1 + 5 / 4 * 5 + (2 + 3 + 4) / 4 + 12 / 4,
    ),
    "carried-gain: all are lost": (
        case(1000, CARRIED_COSTS, sensor("a", 9, 5, dropout=1.0), sensor("b", 3, offset=1), late="carried-gain"),
        1 + 5 / 9 * 5 + 2 / 9 + (3 + 4 * 2 / 3) / 3,
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


@pytest.mark.parametrize("priority", [5, pytest.param(20, marks=pytest.mark.exhaust)])
@pytest.mark.parametrize("dropout", [0.3, pytest.param(0.0, marks=pytest.mark.exhaust)])
@pytest.mark.parametrize("late", ["recalculate", "larsen", "carried-gain"])
def test_random_delays_and_dropout_weigh_by_probability(priority: int, dropout: float, late: Late) -> None:
    """Both sensors draw; some arrive together, some overtake others."""
    a = sensor("a", 2, [0, 1, 2, 4, 7], dropout=dropout, priority=priority)
    b = sensor("b", 1, [0, 2, 3], dropout=dropout)
    asked = case(1000, CARRIED_COSTS, a, b, steps=8_000, late=late)
    assert demand(asked) == [pytest.approx(float(run_scenario(asked).schedule.utilization), rel=0.02)]


@pytest.mark.exhaust
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
    (demanded,) = causes(asked, outcome, [float(outcome.schedule.utilization)])
    assert "so that corrections wait for one another and go back together: predict 12%" in demanded


@st.composite
def certain(draw: st.DrawFn) -> Scenario:
    """Up to three sensors without dropout, each with one delay, and one cost of each part."""
    work = st.integers(1, 5)
    names = "abc"[: draw(st.integers(1, 3))]
    entries = {"predict": draw(work)} | {f"correct.{name}": draw(work) for name in names}
    more = {"predict_accumulate": entries["predict"] + 1}
    for name in names:
        more |= {f"correct_accumulate.{name}": 6, f"correct_late.{name}": 7, f"carry.{name}": 1, f"beside.{name}": 2}
        more |= {f"land.{name}": 3, f"beside_product.{name}": 3, f"land_product.{name}": 2, "carry_product": 2}
    sensors = []
    for name in names:
        every = draw(st.sampled_from([1, 2, 3, 4, 6, 10, Fraction(4, 3), Fraction(15, 2)]))
        delay = draw(st.sampled_from([0, 0, 1, 2, 3, 5, 8, Fraction(7, 3)]))
        priority = draw(st.sampled_from([HR - 5, HR, LR, LR, LR + 10]))
        sensors.append(sensor(name, every, delay, offset=draw(st.integers(0, floor(every) - 1)), priority=priority))
    speed = sum(entries.values()) * draw(st.sampled_from([1, 2, 5, 20]))
    of = {
        "steps": 600,
        "cpus": draw(st.sampled_from([1, 2])),
        "late": draw(st.sampled_from(["recalculate", "larsen", "carried-gain"])),
    }
    return case(speed, entries | more, *sensors, **of)


@pytest.mark.exhaust
@settings(max_examples=100)
@given(certain())
def test_where_all_lands_in_the_step_of_its_arrival_the_simulation_is_as_busy_as_the_demand(
    asked: Scenario,
) -> None:
    assume(max(demand(asked)) <= 1)
    outcome = run_scenario(asked)
    lags = {one.name: {late for _, late in one.measurements(asked.steps, asked.seed)} for one in asked.sensors}
    assume(all({*outcome.sensors[name].achieved} <= lags[name] for name in lags))
    assume(all(figures.not_landed == 0 for figures in outcome.sensors.values()))
    busy, asks = float(outcome.schedule.utilization) * asked.cpus, sum(demand(asked))
    assert 0.96 * asks <= busy <= 1.01 * asks


# ---------------------------------------------------------------------------------------------- what is not in demand


def test_a_correction_that_takes_longer_than_its_step_does_more_than_is_asked() -> None:
    """6 of each step are left: 2 + 2 x 4 are done in two, then one step again."""
    asked = case(10, {"predict": 4, "correct.a": 2}, sensor("a", 20, 2), steps=3600)
    assert demand(asked) == [pytest.approx((4 + (2 + 8) / 20) / 10)]
    assert float(run_scenario(asked).schedule.utilization) > 1.05 * demand(asked)[0]


CATCHING_UP = case(
    1,
    {"predict": "0.2", "correct.a": "0.3", "correct.b": "0.05"},
    sensor("a", 4, 3, priority=10),
    sensor("b", 1, 2, priority=20),
    steps=1200,
)
SWITCHING = case(
    1, {"predict": "0.3", "correct.a": "0.3"}, sensor("a", 1, 0, priority=HR), context_switch=Fraction(1, 4), steps=400
)


def why(asked: Scenario) -> list[str]:
    outcome = run_scenario(asked)
    assert outcome.misses
    return causes(asked, outcome, [float(outcome.schedule.utilization)])


def test_a_processor_that_is_always_busy_with_less_than_it_can_do_is_explained() -> None:
    (saturated,) = why(CATCHING_UP)
    assert demand(CATCHING_UP)[0] < 1
    assert saturated.startswith("the processor is busy 99.8% of the time: demand is ")
    assert saturated.endswith(
        "and besides comes what corrections of b do again because they take longer than their step"
    )
    assert why(SWITCHING) == [
        "the processor is busy 100.0% of the time: demand is 60.0%, and besides comes what context switches take"
    ]


def test_a_demand_just_above_what_the_processor_can_do_does_not_read_as_all_of_it() -> None:
    asked = case(1, {"predict": "1.0001", "correct.a": "0.000001"}, sensor("a", 10, 0), steps=400)
    cause, *_ = why(asked)
    assert cause.startswith("demand is a little more than 100% of the processor, so that work piles up: ")


def test_misses_on_a_processor_that_has_time_are_not_laid_to_demand() -> None:
    """Two processors; s1 waits behind four steps that s0 replays, and nothing goes back together."""
    s0 = sensor("a", 10, 12, priority=5)
    s1 = sensor("b", 4, 0, offset=3, priority=20, land_by=1)
    asked = case(1, {"predict": "0.2", "correct.a": "0.1", "correct.b": "0.3"}, s0, s1, cpus=2, steps=1200)
    outcome = run_scenario(asked)
    assert outcome.misses
    assert demand(asked)[1] < 0.6
    assert causes(asked, outcome, [0.2, 0.511]) == []


@pytest.mark.exhaust
def test_many_sensors_without_a_common_step_are_soon_summed_up() -> None:
    """What is looked through does not grow with their number."""
    primes = (7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83)
    sensors = [sensor(f"s{every}", every, range(21)) for every in primes]
    asked = case(1, {"predict": "0.001"} | {f"correct.{one.name}": "0.001" for one in sensors}, *sensors, steps=40_000)
    assert demand(asked)[0] == pytest.approx(float(run_scenario(asked).schedule.utilization), rel=0.02)


def test_of_rates_of_large_numbers_the_demand_is_that_of_rates_near_them() -> None:
    """29.97 Hz at 400 Hz, late by 44.1 steps, beside two others."""
    sensors = [sensor("a", Fraction(40_000, 2997), Fraction(441, 10)), sensor("b", Fraction(37, 7), Fraction(1, 3))]
    entries = {"predict": "0.01"} | {f"correct.{name}": "0.001" for name in "abc"}
    asked = case(1, entries, *sensors, sensor("c", Fraction(100, 9)), steps=20_000)
    assert demand(asked)[0] == pytest.approx(float(run_scenario(asked).schedule.utilization), rel=0.005)


def test_a_pattern_of_any_length_is_soon_looked_through() -> None:
    """Rates without a common step for longer than the world will last, and very many delays."""
    sensors = [
        sensor(f"s{number}", every, range(500_000), priority=HR)
        for number, every in enumerate((99_991, 99_989, 10**30))
    ]
    asked = case(1000, {"predict": 1} | {f"correct.{one.name}": 1 for one in sensors}, *sensors)
    assert 1 < demand(asked)[0] * 1000 < 1 + 3 * 250_001 / 99_989 * 10
