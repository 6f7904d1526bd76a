"""Real runs. What is asserted holds on any machine, however busy; whether cycles agree is for machines that are not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest

from filters.system import System
from filters.systems.example import example_system
from filters.translation.library import Precision
from studies.board.wanted import Filter
from studies.live.measure import Measured, measured
from studies.live.program import Program, compiled, steps_of
from studies.live.rights import chosen_core
from studies.live.stairs import two_steps
from studies.live.taken import NEAR
from tests.exhaust import share_of
from tests.studies.board.systems import pendulum
from tests.studies.live.machine import needs_real_time
from tests.studies.live.recorded import MS, design

pytestmark = needs_real_time


def wanted(system: System, N: int, M: int, precision: Precision = "double") -> Filter:
    return Filter("dual-rate", system, np.zeros(system.states), "textbook", precision, steps_of(N, M), "sched-sim live")


@pytest.fixture(scope="module")
def program() -> Iterator[Program]:
    with compiled(wanted(example_system(4, 2, 2), 10, 4)) as found:
        yield found


def run(program: Program, speed: str, cycles: int, period_ns: int = 10 * MS, *, swapped: bool = False) -> Measured:
    of = design(speed, cycles, period_ns)
    assert of.predicted is not None
    return measured(program.run(of, chosen_core(None), swapped=swapped), of, of.predicted)


def test_a_short_run(program: Program) -> None:
    found = run(program, "0.85", 8, 5 * MS)
    kinds = Counter(job.kind for job in found.ran.jobs)
    skipped = found.achieved.count(None)
    assert kinds["hr_propagate"] + kinds["hr_restart"] == 90
    assert 9 - skipped <= kinds["hr_restart"] <= 9
    assert kinds["lr_update"] - 1 <= kinds["hr_update"] <= kinds["lr_update"]  # the last may be later
    for job in found.ran.jobs:
        assert job.cpu >= found.design.job_ns[job.kind]
        assert job.end - job.start >= 0.99 * job.cpu
        assert not job.high or job.start >= job.step * found.design.period_ns
    assert len(found.achieved) == 8
    assert found.agreement.word in ("agrees", "disagrees", "inconclusive")
    assert found.ran.differing == 0
    assert 0 <= found.ran.idle <= 2 * found.design.steps * found.design.period_ns


@pytest.mark.parametrize(
    ("system", "N", "M", "precision"),
    [
        (example_system(3, 0, 1), 6, 2, "double"),
        (example_system(3, 1, 1), 4, 0, "single"),
        (pendulum(), 5, 3, "double"),
    ],
    ids=["without inputs", "without delay", "nonlinear"],
)
def test_states_are_those_of_one_thread(system: System, N: int, M: int, precision: Precision) -> None:
    """To the bit, whatever preempted what."""
    of = design("1.6", 12, 2 * MS, N, M)
    with compiled(wanted(system, N, M, precision)) as found:
        assert found.run(of, chosen_core(None), once=True).differing == 0


@pytest.mark.exhaust
@pytest.mark.parametrize("factor", [1 - NEAR, 1 + NEAR])
@pytest.mark.parametrize("step", [0, 1])
def test_undisturbed_cycles_land_as_predicted(program: Program, step: int, factor: Fraction) -> None:
    """2 % from a step, at 10 ms: at least 99 % of them, or the run says that it is inconclusive."""
    speed = str(float(two_steps(design())[step] * factor))
    found = run(program, speed, share_of(500)).agreement
    assert found.word != "disagrees", found


@pytest.mark.exhaust
def test_swapped_priorities_never_agree(program: Program) -> None:
    found = run(program, "0.85", share_of(500), swapped=True)
    assert found.agreement.word != "agrees"
    assert found.agreement.agreeing_undisturbed == 0
