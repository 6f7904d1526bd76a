"""A simulation whose costs are drawn is that of constant costs where what is drawn is constant."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from itertools import cycle

import pytest

from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.drawn import executions, kinds_by_piece, marks, run_drawn
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import works
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task

TABLE = load_costs("counted-9-3-3")
CONTROL = Task("control", 2, 900, 5, offset=0)


def always(cost: int) -> Callable[[], int]:
    return lambda: cost


@pytest.mark.parametrize("method", ["standard", "recalculate", "larsen", "clone", "carried-gain", "dual-rate"])
@pytest.mark.parametrize("options", [Options(), Options(gain="precomputed", feedback="same-step")], ids=["", "early"])
def test_constant_draws_are_constant_costs(method: str, options: Options) -> None:
    M = 0 if method == "standard" else 4
    timing, speed, tasks = Timing(10, M, 9), Fraction(6000), [CONTROL]
    achieved: Counter[int] = Counter()
    costs = select(TABLE, method, options)
    constant = simulate(costs, timing, speed, 12, options, tasks, on_landing=lambda _, L: achieved.update([L]))
    draws = {kind: always(int(cost.minimum)) for kind, cost in TABLE.costs[method].items()}
    drawn = run_drawn(method, draws, timing, speed, 1, 12, options, tasks)
    assert drawn.achieved == achieved
    assert drawn.achieved.total() == 12
    worst = {kind: response.worst for kind, response in constant.responses.items()}
    assert {kind: response.worst for kind, response in drawn.schedule.responses.items()} == worst


def test_each_execution_takes_what_is_drawn_for_it() -> None:
    costs = {"hr_propagate": 63, "hr_restart": 4, "hr_update": 3, "lr_propagate": 41}
    draws = {kind: always(cost) for kind, cost in costs.items()}
    slow = cycle([56, 56, 56, 61])
    run = run_drawn("dual-rate", draws | {"lr_update": slow.__next__}, Timing(10, 4, 8), Fraction(78), 1, 40)
    assert run.achieved == {8: 30, 9: 10}


def test_how_often_pieces_run_can_be_read_from_work() -> None:
    kinds = ("propagate", "update", "replay")
    propagate, update, replay = works(marks("recalculate", kinds, Options()))
    assert executions(propagate + update + 7 * replay, kinds) == [("propagate", 1), ("update", 1), ("replay", 7)]
    assert executions(0, kinds) == []


def test_pieces_are_kinds_of_jobs() -> None:
    found = kinds_by_piece("dual-rate", tuple(TABLE.costs["dual-rate"]), Options(), TABLE)
    assert found["hr"] == "hr_propagate"
    assert found["lr_gain"] is None
    early = kinds_by_piece("dual-rate", tuple(TABLE.costs["dual-rate"]), Options(gain="precomputed"), TABLE)
    assert (early["lr_gain"], early["lr_update"]) == ("lr_gain", "lr_correct")
    with pytest.raises(InputError, match="differences of costs"):
        kinds_by_piece("augmentation", tuple(TABLE.costs["augmentation"]), Options(), TABLE)
    with pytest.raises(InputError, match=r"cost table mine has no entry .* hr_update"):
        kinds_by_piece("dual-rate", ("hr_propagate", "hr_restart"), Options(), CostTable("mine", "us", {}))
