"""A simulation that is stopped on its way, and goes on."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.simulated import Simulation
from sched_sim.scenario.workload import workload
from sched_sim.schedule.outcome import Slice
from tests.random_scenarios import random_scenario


@settings(max_examples=25)
@given(st.integers(0, 10**6), st.sets(st.integers(1, 59)))
def test_it_is_the_same_wherever_it_was_stopped(seed: int, stops: set[int]) -> None:
    scenario = random_scenario(seed, [60])
    whole: list[Slice] = []
    outcome = run_scenario(scenario, on_slice=whole.append)
    pieces: list[Slice] = []
    simulation = Simulation(workload(scenario), pieces.append)
    for step in sorted(stops):
        simulation.advance(step)
        assert all(piece.end < step * piece.period for piece in pieces)
    assert simulation.outcome() == outcome
    assert pieces == whole
