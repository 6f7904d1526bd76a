"""The slider of the schedules: each L at its least speed, on two rates without a miss, and in one period as fast."""

from __future__ import annotations

from reports.erkf import tables
from reports.erkf.schedule import millions
from reports.erkf.sliding import ASKED, DRAWN, over_l
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.timing import Timing
from studies.robust.costs import HR_HZ, N

COSTS = tables.robust_costs_of(load_costs("erkf-position"), "robust-givens")


def test_each_l_has_its_least_speed_lands_there_and_misses_only_in_one_period() -> None:
    for L, (label, (apart, together)) in zip(ASKED, over_l(COSTS).frames, strict=True):
        pace = f"{millions(least_speed(COSTS, Timing(N, 0, L)).speed, HR_HZ):.3g} million operations/s"
        assert label == f"L = {L}: {pace}"
        assert len(label) <= 40
        assert apart.notes[0] == together.notes[0] == pace
        assert list(apart.schedule.achieved) == [L]
        assert (apart.schedule.misses, together.schedule.misses) == (0, L - 1)


def test_it_goes_from_one_period_to_the_next_fix_in_few_states_and_begins_where_the_file_is_drawn() -> None:
    sliding = over_l(COSTS)
    assert (ASKED[0], ASKED[-1]) == (1, N)
    assert len(ASKED) <= 12
    assert sliding.frames[sliding.at].label.startswith(f"L = {DRAWN}: ")
