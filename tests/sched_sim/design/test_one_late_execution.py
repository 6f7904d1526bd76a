"""One execution that takes longer may make every later cycle late."""

from __future__ import annotations

from fractions import Fraction
from typing import Any
from unittest.mock import patch

import pytest

from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.jobs import Job

COSTS = DualRateCosts(*map(Fraction, (10, 10, 1, 4, 0, 16)))


@pytest.mark.parametrize(("longest", "later"), [(16, 1), (17, 2)])
def test_an_lr_update_that_is_a_tick_late_delays_all_that_come(longest: int, later: int) -> None:
    """At 30: HR, LR propagate and LR update fill the step of k. A tick more, and the HR update comes in the next k, and
    takes its tick from the LR update of that."""
    made, updates, landings = Job.__init__, [], []

    def make(self: Job, kind: str, step: int, priority: int, release: int, due: int, work: int, *more: Any) -> None:
        if kind == "lr_update":
            updates.append(self)
            work = longest if len(updates) == 6 else work
        made(self, kind, step, priority, release, due, work, *more)

    with patch.object(Job, "__init__", make):
        simulate(COSTS, Timing(2, 0, 1), 30, 500, Options(), on_landing=lambda _cycle, L: landings.append(L))
    assert landings == [1] * 5 + [later] * 495
