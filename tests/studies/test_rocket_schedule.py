"""What the study of the rocket's filter on slow processors claims, on short runs with made-up costs."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from functools import cache
from statistics import fmean

import pytest

from filters.modular.problem import unscented_parts
from filters.systems.rocket import RATE_HZ
from filters.systems.rocket_filter import ACCELEROMETER, BAROMETER, CAMERA, GPS, GYRO, SENSORS, PredictorName
from sched_sim.sample_file import SampledCosts
from sched_sim.scenario_run import run_scenario
from studies.rocket_schedule import (
    CONTROL_EVERY,
    DROPOUT,
    GPS_DELAYS,
    GPS_EVERY,
    JOBS,
    LAND_BY,
    PERIOD_MS,
    URGENCIES,
    WAYS,
    Costs,
    MissRow,
    Run,
    Way,
    arrivals,
    chosen,
    compared_at,
    control_task,
    filter_of,
    miss_curves,
    scenario,
    slowest_that_holds,
    slowness_of_a_full_processor,
    slownesses,
    step_s,
    thinned,
)

UNSCENTED, EXTENDED, LARSEN = WAYS
STEPS = 600
GRID = (20, 100, 300, 700, 1400)
MICROSECONDS = {GPS: 1.3, BAROMETER: 0.5, GYRO: 0.7, ACCELEROMETER: 2.5, CAMERA: 2.6}


def samples(microseconds: float) -> tuple[Fraction, ...]:
    """Three, spread by a tenth."""
    return tuple(Fraction(f"{microseconds * spread:.4g}e-6") for spread in (0.9, 1.0, 1.1))


def made_up(predictor: PredictorName) -> SampledCosts:
    """An unscented prediction takes 6 us, an extended one 4 us, what Larsen's method adds to each part a fifth."""
    predict = 6.0 if predictor == "unscented" else 4.0
    parts = {"predict": predict, **{f"correct.{name}": MICROSECONDS[name] for name in SENSORS}}
    if predictor == "extended":
        parts["predict_accumulate"] = 1.2 * predict
        parts |= {f"{kind}.{name}": 1.2 * MICROSECONDS[name] for kind in LARSENS for name in SENSORS}
    return SampledCosts("made up", "second", {part: samples(value) for part, value in parts.items()})


LARSENS = ("correct_accumulate", "correct_late")
COSTS: Costs = {"unscented": made_up("unscented"), "extended": made_up("extended")}


@cache
def curves() -> tuple[MissRow, ...]:
    return tuple(miss_curves(COSTS, GRID, steps=STEPS))


def curve(way: str, urgency: str, job: str) -> list[float]:
    return [row.probability for row in curves() if (row.way, row.urgency, row.job) == (way, urgency, job)]


@cache
def run(way: int, urgency: str, times_slower: int) -> Run:
    return chosen(COSTS, WAYS[way], urgency, times_slower, steps=STEPS)


# ---------------------------------------------------------------------------------------------- probability of a miss


@pytest.mark.parametrize("way", [way.name for way in WAYS])
@pytest.mark.parametrize("urgency", URGENCIES)
@pytest.mark.parametrize("job", JOBS)
def test_misses_go_from_none_to_all_as_the_processor_gets_slower(way: str, urgency: str, job: str) -> None:
    found = curve(way, urgency, job)
    assert found == sorted(found)
    assert found[0] == 0
    assert found[-1] > 0.95


def test_in_the_loop_a_replay_makes_the_loop_late_first() -> None:
    """On a processor 100 times slower a replay of 20 steps takes 15 to 19 ms."""
    for way in (UNSCENTED, EXTENDED):
        at = GRID.index(100)
        assert curve(way.name, "in the loop", "loop")[at] > curve(way.name, "in the loop", "control")[at] >= 0
        assert curve(way.name, "in the loop", "GPS")[at] == 0


def test_preempted_the_fix_is_late_first_and_the_loop_is_not() -> None:
    for way in (UNSCENTED, EXTENDED):
        at = GRID.index(300)
        assert curve(way.name, "preempted", "GPS")[at] > 0.05
        assert curve(way.name, "preempted", "loop")[at] == 0


@pytest.mark.parametrize("urgency", URGENCIES)
def test_larsen_holds_on_processors_on_which_replaying_does_not(urgency: str) -> None:
    held = {way.name: slowest_that_holds(curves(), way.name, urgency) or 0 for way in WAYS}
    assert held[LARSEN.name] > held[EXTENDED.name] >= held[UNSCENTED.name]


def test_lateness_is_that_of_the_replay() -> None:
    """Twenty steps of 4 + 0.7 + 2.5 us and the correction, 300 times slower, take 43 ms; the step itself 2.2 ms."""
    (row,) = [
        row
        for row in curves()
        if (row.way, row.urgency, row.times_slower, row.job) == (EXTENDED.name, "in the loop", 300, "loop")
    ]
    assert 0.8 * (43 + 2.2) - PERIOD_MS < row.late_ms < 1.1 * (43 + 2.2)


def slowness_of_no_return(costs: Costs, predictor: PredictorName) -> float:
    """How many times slower the processor is on which preempted replays pile up, by average work.

    Where each period leaves time for r steps beside the one that is due, replaying d steps takes T = d / (r - 1)
    periods, since the T steps that pass meanwhile have to be replayed too. T must be below the time between fixes.
    """
    step, control = step_s(costs[predictor], DROPOUT), float(control_task(costs, 1).cost) / CONTROL_EVERY
    r = 1 + fmean(GPS_DELAYS) * (1 - DROPOUT) / GPS_EVERY
    return 1 / (RATE_HZ * (step + control + r * step))


@pytest.mark.parametrize("way", [UNSCENTED, EXTENDED], ids=lambda way: way.name)
def test_preempted_replays_pile_up_where_average_work_says(way: Way) -> None:
    """Of 67 fixes that arrive, hardly one is not in the state at the end, or most are not."""
    limit = slowness_of_no_return(COSTS, way.predictor)
    waiting = []
    for slower in (0.85 * limit, 1.2 * limit):
        outcome = run_scenario(scenario(COSTS, way, "preempted", int(slower), steps=1500))
        waiting.append(outcome.sensors[GPS].not_landed)
    assert waiting[0] <= 2
    assert waiting[1] > 30


def test_slowest_that_holds_ends_before_the_first_that_does_not() -> None:
    rows = [
        MissRow("way", "preempted", slower, job, misses, 100, 0.0, 0.5)
        for slower, misses in ((10, 0), (20, 1), (30, 2), (40, 0))
        for job in JOBS
    ]
    assert slowest_that_holds(rows, "way", "preempted", 0.01) == 20
    assert slowest_that_holds(rows[6:], "way", "preempted", 0.01) is None
    assert compared_at(rows) == 10


# --------------------------------------------------------------------------------------------- what one run looks like


@pytest.mark.parametrize("urgency", URGENCIES)
@pytest.mark.parametrize("way", range(3))
def test_on_a_fast_processor_corrections_land_when_the_fix_arrives(way: int, urgency: str) -> None:
    fast, arrived = run(way, urgency, 1).achieved, arrivals(STEPS)
    assert fast <= arrived
    assert (arrived - fast).total() <= 1  # the last one may arrive after the end


def test_preempted_replay_lands_later_than_in_the_loop_and_both_later_than_larsen() -> None:
    def mean(achieved: Counter[int]) -> float:
        return sum(step * count for step, count in achieved.items()) / achieved.total()

    preempted, in_the_loop = mean(run(1, "preempted", 200).achieved), mean(run(1, "in the loop", 200).achieved)
    assert preempted > in_the_loop > mean(run(2, "preempted", 200).achieved)


def test_larsen_needs_less_time_than_replaying() -> None:
    replaying, larsen = run(1, "in the loop", 100).shares, run(2, "in the loop", 100).shares
    assert larsen["replay"] == larsen["catching up"] == 0
    assert sum(larsen.values()) < sum(replaying.values())
    assert replaying["replay"] > larsen["prediction"] - replaying["prediction"] > 0


def test_only_a_preempted_replay_has_to_catch_up() -> None:
    assert run(1, "preempted", 200).shares["catching up"] > 0
    assert run(1, "in the loop", 200).shares["catching up"] == 0


def test_shares_are_those_of_the_whole_time() -> None:
    found = run(0, "preempted", 100)
    assert sum(found.shares.values()) == pytest.approx(float(found.outcome.schedule.utilization), rel=1e-9)


def test_responses_are_in_milliseconds() -> None:
    """Predict and accelerometer of the extended filter take 6.5 us, and 0.9 of it at least; sometimes the gyro is
    lost."""
    assert run(1, "in the loop", 100).responses_ms["loop"][0] == pytest.approx(0.9 * 0.65)


# ---------------------------------------------------------------------------------------------- what it is made from


def test_costs_are_thinned_to_quantiles_without_what_others_took() -> None:
    values = tuple(Fraction(number, 1000) for number in range(1, 1001))
    outlier = (Fraction(300),) * 10
    found = thinned(SampledCosts("many", "second", {"predict": values + outlier, "correct.gps": (Fraction(1),)}))
    kept = found.samples["predict"]
    assert len(kept) == 200
    assert sum(kept) / 200 == pytest.approx(0.5005, abs=0.001)
    assert found.samples["correct.gps"] == (Fraction(1),)
    assert str(found.provenance["samples_are"]).startswith("1.0 % took over 10 times the median")


def test_the_extended_filter_is_one_that_larsen_can_do_with() -> None:
    assert unscented_parts(filter_of("extended")) == []
    assert "predictor" in unscented_parts(filter_of("unscented"))


def test_at_most_one_fix_is_on_its_way() -> None:
    gps, *others = scenario(COSTS, LARSEN, "preempted", 10).sensors
    assert max(gps.delays) <= gps.every <= LAND_BY
    assert [sensor.delayed for sensor in others] == [False] * 4


def test_processors_are_chosen_around_the_one_that_is_full() -> None:
    """A step takes 4 + 0.7 + 2.5 us, and with a quarter of the barometer and a tenth of the camera 7.585 us."""
    full = slowness_of_a_full_processor(COSTS["extended"])
    assert full == pytest.approx(1e4 / 7.585)
    grid = slownesses(COSTS)
    assert grid[0] < 0.05 * full < full < grid[-1]


def test_the_same_seed_gives_the_same_rows() -> None:
    assert miss_curves(COSTS, [300], steps=100) == miss_curves(COSTS, [300], steps=100)
