"""Steffes Secs III.C and V: against which methods, and when, the dual-rate filter needs less processing power."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from studies.steffes.advantage import NAMED, by_rate, heavier, needed

PAPER, COUNTED = load_costs("steffes2014"), load_costs("counted-9-3-3").normalised()
T = Timing(10, 4, 8)


def test_every_method_that_the_paper_names_needs_more_and_not_every_other() -> None:
    found = needed(COUNTED, T)
    speeds = {one.method: one.speed for one in found}
    assert speeds["dual-rate"] == Fraction(10473, 2) / 6321
    assert min(speeds[method] for method in NAMED) > speeds["dual-rate"] > speeds["clone"]
    assert [one.speed for one in found] == sorted(speeds.values())
    assert {one.method: one.lands for one in found}["clone"] == T.M


@given(st.sampled_from([(2, 8), (4, 8), (4, 5), (1, 3)]))
def test_the_rate_alone_changes_nothing(delays: tuple[int, int]) -> None:
    assert len(set(by_rate(PAPER, Timing(10, *delays)).values())) == 1


def test_a_heavier_update_is_dearer_for_larsen_by_all_of_it_and_for_dual_rate_by_its_share_of_the_wait() -> None:
    lands = (5, 8, 10)
    first, *more = heavier(PAPER, T, lands)
    for one in more:
        assert one.larsen - first.larsen == one.added
        assert one.dual_rate[5] - first.dual_rate[5] == one.added
        assert one.dual_rate[8] - first.dual_rate[8] == one.added / (8 - T.M)
        assert one.dual_rate[10] / one.larsen < first.dual_rate[10] / first.larsen
