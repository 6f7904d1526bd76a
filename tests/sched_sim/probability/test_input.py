"""What is no distribution, and what the exact probability cannot have, is refused by name."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    DelayedHorizonCosts,
    DualRateCosts,
    LarsenInFlightCosts,
    RecalculateCosts,
    StandardCosts,
)
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.schedule.tasks import Task

certain = CostDistribution.certain


def test_samples_are_one_value_each_with_its_share() -> None:
    samples = CostDistribution.of_samples([3, "0.5", 3, 2.0])
    assert samples.values == (Fraction(1, 2), 2, 3)
    assert samples.probabilities == (0.25, 0.25, 0.5)
    assert samples.worst == 3
    assert samples.mean == Fraction(17, 8)
    assert CostDistribution((1, 2), (0.1 + 0.2, 0.7)).probabilities == pytest.approx((0.3, 0.7))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("values", "shares", "said"),
    [
        ((1, 2), (0.5, 0.4), r"probabilities sum to 0\.9: they must sum to 1"),
        ((1, 2), (0.5,), "2 values and 1 probabilities"),
        ((), (), "at least one"),
        ((2, 1), (0.5, 0.5), "values must increase: 1 comes after 2"),
        ((1, 1), (0.5, 0.5), "give each value once"),
        ((-1, 1), (0.5, 0.5), "value -1 must be 0 or more"),
        ((1, 2), (1.0, 0.0), "probability 0 of 2 must be greater than"),
        ((1, 2), (float("nan"), 0.5), "probability nan of 1"),
    ],
)
def test_what_is_no_distribution(values: Any, shares: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        CostDistribution(values, shares)
    with pytest.raises(InputError, match="there are no samples"):
        CostDistribution.of_samples([])


DUAL_RATE = DualRateCosts(*map(certain, (10, 10, 1, 4, 0, 16)))
RECALCULATE = RecalculateCosts(*map(certain, (10, 5, 4)))


def task(**changed: Any) -> Task:
    known = {"name": "t", "period": Fraction(2), "cost": Fraction(1), "priority": 5, "offset": Fraction(0)}
    return Task(**known | changed)


@pytest.mark.parametrize(
    ("costs", "timing", "given", "said"),
    [
        (DUAL_RATE, Timing(4, 1, 2), {"options": Options(policy="edf")}, "policy edf: .* fixed priorities"),
        (DUAL_RATE, Timing(4, 1, 2), {"options": Options(context_switch=1)}, "context_switch 1: "),
        (DUAL_RATE, Timing(4, 1, 2), {"tasks": [task(offset="any")]}, "task 't': its offset may be any"),
        (DUAL_RATE, Timing(4, 1, 2), {"tasks": [task(jitter=Fraction(1, 2))]}, "task 't': jitter 0.5"),
        (DUAL_RATE, Timing(4, 1, 2), {"tasks": [task(preemptive=False)]}, "task 't': .* preemptive tasks only"),
        (DUAL_RATE, Timing(4, 1, 2), {"tasks": [task(priority=20)]}, "task 't': priority 20 is that of LR jobs"),
        (DUAL_RATE, Timing(4, 1, 2), {"tasks": [task(cpu=2)], "options": Options(cpus=2)}, "task 't': .* CPU 1"),
        (DUAL_RATE, Timing(4, 1, 2), {"tasks": [task()], "options": Options(cpus=2)}, "task 't' with cpus 2"),
        (DUAL_RATE, Timing(4, 1, 2), {"tasks": [task()], "options": Options(feedback="same-step")}, "same-step"),
        (DUAL_RATE, Timing(4, 1, 2), {"task_costs": {"u": certain(1)}}, "task_costs: there is no task 'u', but none"),
        (DUAL_RATE, Timing(4, 1, 2), {"options": Options(cpus=2), "bins": 7}, "cpus 2: had where all costs are whole"),
        (DUAL_RATE, Timing(4, 1, 2), {"preempted": True}, "preempted: only recalculate"),
        (DUAL_RATE, Timing(4, 1, 2), {"dropout": 1.0}, "dropout is 1.0: it must be a probability"),
        (DUAL_RATE, Timing(4, 1, 2), {"delays": certain("1.5")}, "delays 1.5 must be whole HR steps"),
        (DUAL_RATE, Timing(4, 1, 2), {"bins": 0}, "bins is 0"),
        (DUAL_RATE, Timing(4, 1, 2), {"bins": 10**5}, "bins is 100000: at most 16384"),
        (
            DUAL_RATE,
            Timing(4, 1, 2),
            {"bins": 3, "tasks": [task(offset=Fraction(1, 2))]},
            "bins 3 must be a multiple of 2",
        ),
        (DUAL_RATE, Timing(4, 1, 2), {"cycles": 10**6}, "cycles 1000000 is more than"),
        (DualRateCosts(*map(certain, (10, 10, 1, 4, 2, 16))), Timing(2, 3, 4), {}, "gain precomputed with M=3"),
        (DualRateCosts(*map(certain, (10, 10, 1, 4, 0, 10**5))), Timing(4, 1, 2), {}, "lr_update takes up to 100000"),
        (DualRateCosts(*(1,) * 6), Timing(4, 1, 2), {}, "DualRateCosts: hr is 1: give a CostDistribution"),
        (RECALCULATE, Timing(4, 1, 1), {"delays": certain(5)}, "delays up to 5 steps"),
        (RECALCULATE, Timing(4, 1, 1), {"preempted": True, "dropout": 0.5}, "preempted with delays, dropout"),
        (
            StandardCosts(certain(1), certain(1)),
            Timing(4, 0, 0),
            {"dropout": 0.5},
            "delays, dropout: had for recalculate",
        ),
        (LarsenInFlightCosts(*map(certain, range(1, 7))), Timing(2, 3, 3), {}, "M=3 and N=2: .* larsen"),
        (DelayedHorizonCosts(*map(certain, range(1, 5))), Timing(4, 1, 2), {}, "DelayedHorizonCosts: "),
    ],
)
def test_what_is_not_had(costs: Any, timing: Timing, given: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        probabilities(costs, timing, 30, **{"cycles": 1} | given)


def test_less_urgent_tasks_are_left_out() -> None:
    (alone,) = probabilities(DUAL_RATE, Timing(4, 1, 2), 30, 1).cycles
    tasks = [task(priority=30, offset="any")]
    (beside,) = probabilities(DUAL_RATE, Timing(4, 1, 2), 30, 1, tasks=tasks, task_costs={"t": certain(99)}).cycles
    assert (beside.landing, beside.misses) == (alone.landing, alone.misses)


@pytest.mark.parametrize("costs", [DUAL_RATE, RECALCULATE])
def test_too_much_work_has_no_long_run(costs: Any) -> None:
    found = probabilities(costs, Timing(2, 0, 1), 12, 3)
    assert found.long_run is None
    assert found.why_no_long_run.startswith("the load is 1.")
    assert found.cycles[2].late.upper == 1


def test_where_nothing_can_be_followed_there_is_no_long_run() -> None:
    """The work is less than the time, but each HR update that comes late makes the next one later."""
    costs = DualRateCosts(*map(certain, (27, 20, 20, 27, 0, 20)))
    found = probabilities(costs, Timing(2, 3, 4), 60, 3, debt=2)
    assert found.long_run is None
    assert found.why_no_long_run == "the distribution of what is left to do does not settle"


def test_progress_is_told_up_to_the_long_run() -> None:
    told: list[tuple[int, int, str]] = []
    probabilities(RECALCULATE, Timing(4, 1, 1), 60, 20, on_progress=lambda *progress: told.append(progress))
    *cycles, last = told
    assert last == (20, 20, "cycles, and the long run")
    assert cycles == [(number, 20, "cycles") for number in range(len(cycles))] != []
