"""Scenarios in compiled code: job by job what SimPy does, and each is the other's oracle."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from sched_sim.errors import InputError
from sched_sim.scenario import run
from sched_sim.scenario.engine import run as of_engine
from sched_sim.scenario.engine.layout import FIRST_JOBS
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.workload import workload
from tests.exhaust import share_of
from tests.random_scenarios import random_scenario
from tests.scenarios import BY_HAND, HR, scenario, sensor


def assert_the_same(of: Scenario) -> int:
    """How many jobs there were, with each the same end; and the landings, the misses, the instants."""
    expected = run_scenario(of, engine="simpy")
    assert run_scenario(of, engine="compiled") == expected
    return sum(len(jobs.responses) for jobs in expected.jobs.values())


def test_compiled_code_does_what_simpy_does():
    assert sum(assert_the_same(random_scenario(seed)) for seed in range(400)) > 10_000


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(50))
def test_compiled_code_does_what_simpy_does_in_many_scenarios(part, record_property):
    count = share_of(2_000)
    seeds = range(1_000 + part * count, 1_000 + (part + 1) * count)
    record_property("jobs", sum(assert_the_same(random_scenario(seed)) for seed in seeds))
    record_property("scenarios", count)


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(20))
def test_compiled_code_does_what_simpy_does_in_long_scenarios(part, record_property):
    count, steps = share_of(50), 2_000
    seeds = range(part * count, (part + 1) * count)
    record_property("jobs", sum(assert_the_same(random_scenario(seed, [steps])) for seed in seeds))
    record_property("steps", count * steps)


def test_the_rules_are_plain_python_too(monkeypatch):
    monkeypatch.setattr(of_engine, "compiled", lambda function: function)
    with np.errstate(over="ignore"):  # products of two halves of a random word fill 64 bits
        for seed in range(30):
            assert_the_same(random_scenario(seed))


OVERLOAD = {"predict": 11, "correct.gps": [2, 3]}
"""In a period of 10."""


def test_jobs_that_pile_up_get_room():
    waiting = scenario(10, OVERLOAD, sensor("gps", 2, [0, 3], priority=HR), steps=20 * FIRST_JOBS)
    found = run_scenario(waiting, engine="compiled")
    assert found.jobs["predict"].released - len(found.jobs["predict"].responses) > 3 * FIRST_JOBS
    assert_the_same(waiting)


LONG = {"predict": ["3/33232930569601", 0.5], "correct.gps": "1/243"}
"""In a period of 16,000,000,000,000,000 ticks and more: 7^16 of them, times 3^5 and 6, are a cost unit."""


def test_ticks_that_no_float_holds_are_divided_exactly():
    of = scenario(3, LONG, sensor("gps", 2, [0, 3]), steps=4)
    assert workload(of).period > 1 << 53
    assert_the_same(of)


PRECISE = {"predict": pi, "correct.gps": 1e-9}
"""In ticks of 1e-15, of which 64 bits hold 9,000."""


def test_what_64_bits_do_not_hold_is_simpys(monkeypatch):
    monkeypatch.setattr(run, "MANY_JOBS", 0)
    of = scenario(10, PRECISE, sensor("gps", 2), steps=2_000)
    assert run_scenario(of) == run_scenario(of, engine="simpy")
    with pytest.raises(InputError, match=r"engine compiled: .* do not fit into 64 bits; give engine simpy"):
        run_scenario(of, engine="compiled")


def test_auto_takes_compiled_code_for_many_jobs(monkeypatch):
    taken = []
    monkeypatch.setattr(of_engine, "compiled", lambda function: taken.append(function) or function)
    monkeypatch.setattr(run, "MANY_JOBS", 10)
    for steps in (9, 10):
        run_scenario(scenario(10, BY_HAND, sensor("gps", 20), steps=steps))
        assert bool(taken) == (steps == 10)


def test_slices_are_simpys(monkeypatch):
    monkeypatch.setattr(run, "MANY_JOBS", 0)
    of, slices = scenario(10, BY_HAND, sensor("gps", 20), steps=3), []
    run_scenario(of, on_slice=slices.append)
    assert slices
    with pytest.raises(InputError, match="engine compiled has no slices"):
        run_scenario(of, engine="compiled", on_slice=slices.append)


def test_an_engine_that_is_not_there():
    with pytest.raises(InputError, match="engine is 'fast': choose from auto, simpy, compiled"):
        run_scenario(scenario(10, BY_HAND, sensor("gps", 20)), engine="fast")


@pytest.mark.parametrize("steps", [7, 250])
def test_both_tell_how_far_they_are(steps):
    told = {"simpy": [], "compiled": []}
    for engine, calls in told.items():
        of = scenario(10, BY_HAND, sensor("gps", 20), steps=steps)
        run_scenario(of, engine=engine, on_progress=lambda *call, calls=calls: calls.append(call))
    assert told["simpy"] == told["compiled"]
    assert told["simpy"][0] == (0, steps, "HR steps")
