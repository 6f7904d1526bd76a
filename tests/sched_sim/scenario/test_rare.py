"""Rare misses by splitting, against a task whose probability of a miss is known exactly, and long simulations."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from math import sqrt

import numpy as np
import pytest

from sched_sim.errors import InputError
from sched_sim.scenario.engine.splitting import Band, count
from sched_sim.scenario.rare import RareMisses, rare_misses
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.workload import workload
from sched_sim.schedule.tasks import Task
from tests.exhaust import share_of
from tests.scenarios import scenario, sensor

LOG = Task("log", period=Fraction(2), cost=Fraction(15), priority=30, offset=Fraction(0))
STEPS = 400


def two_long_ones(one_in: int, seed: int = 0) -> Scenario:
    """A job of 15 in two periods of 30, behind two predict jobs of 10, or of 29 once in so many: two such leave it 2.

    No measurement is ever taken.
    """
    costs = {"predict": [10] * (one_in - 1) + [29], "correct.gps": 1}
    return scenario(30, costs, sensor("gps", 1, offset=STEPS), steps=STEPS, tasks=[LOG], seed=seed)


def exact(one_in: int) -> float:
    """The mean share of the jobs of LOG that miss: job by job, from the law of what the one before has left to do."""
    p = 1 / one_in
    left_to_it = {60 - 20: (1 - p) ** 2, 60 - 39: 2 * p * (1 - p), 60 - 58: p**2}
    law, misses = Counter({0: 1.0}), 0.0
    for _ in range(STEPS // 2):
        following: Counter[int] = Counter()
        for left, probability in law.items():
            for time, share in left_to_it.items():
                still = max(left + 15 - time, 0)
                misses += probability * share * (still > 0)
                following[still] += probability * share
        law = following
    return misses / (STEPS // 2)


def test_two_long_ones_in_a_row_are_as_likely_as_that() -> None:
    """And a little more, for the next job starts late."""
    assert 0.01**2 < exact(100) < 0.01**2 * 1.05


@pytest.mark.parametrize(
    "bands", [[Band(0, 1)], [Band(0, 1), Band(40, 0.1)], [Band(0, 1), Band(20, 0.5), Band(50, 0.7)]]
)
def test_whatever_the_bands_are_the_mean_is_right(bands: list[Band]) -> None:
    of, random = workload(two_long_ones(10)), np.random.default_rng(1)
    counts = [count(of, of.kinds.index("task:log"), bands, random) for _ in range(50)]
    jobs = STEPS // 2
    for found, expected in (("misses", exact(10) * jobs), ("decided", jobs)):
        of_each = np.array([getattr(each, found) for each in counts])
        assert abs(of_each.mean() - expected) <= 4 * of_each.std() / sqrt(len(counts))


def test_what_a_simulation_of_as_many_steps_would_not_show() -> None:
    """One job in 9,900 misses; a simulation has 200."""
    of = two_long_ones(100)
    assert run_scenario(of).misses == 0
    found = rare_misses(of, "task:log", runs=60)
    assert found.interval is not None
    least, most = found.interval
    assert most < 3 * least
    assert least - (most - least) / 2 < exact(100) < most + (most - least) / 2


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(10))
def test_one_in_a_million(part: int, record_property) -> None:
    """How many of the 95 % intervals hold the exact probability is for the figures."""
    count, within = share_of(4), 0
    for seed in range(part * count, (part + 1) * count):
        found = rare_misses(two_long_ones(1000, seed), "task:log", runs=1000)
        assert found.interval is not None
        least, most = found.interval
        within += least < exact(1000) < most
        assert least - (most - least) < exact(1000) < most + (most - least)
    record_property("intervals", count)
    record_property("within", within)


def late_corrections(seed: int) -> Scenario:
    """Of two sensors, with random delays, that go back."""
    gps, camera = sensor("gps", 5, [0, 2, 4], land_by=5, dropout=0.1), sensor("camera", 3, [1, 2], land_by=3)
    costs = {"predict": [3, 3, 3, 4, 6], "correct.gps": [2, 3, 5], "correct.camera": [1, 1, 2]}
    return scenario(11, costs, gps, camera, steps=STEPS, seed=seed)


@pytest.mark.exhaust
@pytest.mark.parametrize("kind", ["correct gps", "correct camera"])
def test_of_corrections_it_is_that_of_long_simulations(kind: str) -> None:
    """Two computations of what neither knows."""
    runs = [run_scenario(late_corrections(seed), engine="compiled").jobs[kind] for seed in range(share_of(4000))]
    misses, decided = (np.array([getattr(jobs, name) for jobs in runs]) for name in ("misses", "decided"))
    share = misses.sum() / decided.sum()
    error = np.std(misses - share * decided) / sqrt(len(runs)) / decided.mean()
    found = rare_misses(late_corrections(0), kind, runs=share_of(1000))
    assert found.interval is not None
    least, most = found.interval
    assert abs(found.probability - share) < 4 * sqrt(error**2 + ((most - least) / 4) ** 2)


def test_what_is_never_near_a_deadline_is_not_resolved_by_all_runs_together() -> None:
    of = scenario(30, {"predict": 1, "correct.gps": 1}, sensor("gps", 5), steps=STEPS)
    found = rare_misses(of, "predict", runs=30)
    assert found == RareMisses(runs=30, missed=0, probability=None, interval=(0, 3 / (30 * STEPS)))


def test_what_comes_near_and_never_misses_is_not_resolved() -> None:
    """Two long ones leave it 18 now, and the next predict job is not in between."""
    light = replace(two_long_ones(10), tasks=[replace(LOG, cost=Fraction(2))])
    found = rare_misses(light, "task:log", runs=30)
    assert found == RareMisses(runs=30, missed=0, probability=None, interval=None)


def test_a_kind_that_is_not_there() -> None:
    with pytest.raises(InputError, match="kind 'log' is not there: choose from 'predict', 'correct gps', 'task:log'"):
        rare_misses(two_long_ones(10), "log")


def test_times_that_64_bits_do_not_hold() -> None:
    of = scenario(10, {"predict": 3.141592653589793, "correct.gps": 1e-9}, sensor("gps", 2), steps=2000)
    with pytest.raises(InputError, match="rare misses are found by compiled code, and times"):
        rare_misses(of, "predict")


def test_it_tells_how_far_it_is() -> None:
    told: list[tuple[int, int, str]] = []
    rare_misses(two_long_ones(10), "task:log", runs=20, on_progress=lambda *call: told.append(call))
    assert told == [(run, 20, "runs") for run in range(20)]


def test_too_few_runs() -> None:
    with pytest.raises(InputError, match="runs is 19: give at least 20"):
        rare_misses(two_long_ones(10), "task:log", runs=19)
