"""A range over measurements holds what each of them makes of the figure, and grows with each."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.table import Cost, CostTable
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.timing import Timing
from studies.machines.ranges import machines, range_of

seconds = st.fractions(Fraction(1, 10**8), Fraction(1, 10**5), max_denominator=10**9)
dates = st.dates().map(str)


@st.composite
def tables(draw: st.DrawFn) -> CostTable:
    costs = {kind: Cost.of(draw(seconds)) for kind in ("propagate", "propagate_accumulate", "update")}
    about = {"machine": draw(st.sampled_from(["AMD EPYC", "Intel Xeon"])), "date": draw(dates)}
    return CostTable("any", "second", {"standard": costs, "larsen": costs}, about)


def larsens_least_speed(table: CostTable) -> Fraction:
    """Of the standard filter's."""
    return least_speed(select(table.normalised(), "larsen"), Timing(10, 4, 8)).speed


@given(st.lists(tables(), min_size=1, max_size=5))
def test_it_holds_the_figure_of_each_and_its_ends_are_figures_of_some(measured: list[CostTable]) -> None:
    values = [larsens_least_speed(table) for table in measured]
    low, high = range_of(larsens_least_speed, measured)
    assert all(low <= value <= high for value in values)
    assert {low, high} <= set(values)


@given(st.lists(tables(), min_size=1, max_size=4), tables())
def test_one_more_never_narrows_it(measured: list[CostTable], one: CostTable) -> None:
    before, after = (range_of(larsens_least_speed, of) for of in (measured, [*measured, one]))
    assert after.low <= before.low <= before.high <= after.high


@given(st.lists(tables(), min_size=1, max_size=4), seconds)
def test_a_faster_machine_of_the_same_proportions_changes_no_range_of_shares(
    measured: list[CostTable], factor: Fraction
) -> None:
    def faster(table: CostTable) -> CostTable:
        costs = {method: {kind: cost / factor for kind, cost in kinds.items()} for method, kinds in table.costs.items()}
        return replace(table, costs=costs)

    assert range_of(larsens_least_speed, measured) == range_of(larsens_least_speed, map(faster, measured))


@given(st.lists(tables(), max_size=5), st.randoms())
def test_machines_have_all_dates_in_any_order_of_measurements(measured: list[CostTable], random: object) -> None:
    of = machines(measured)
    assert sum(map(len, of.values())) == len(measured)
    assert all(sorted(dates) == dates for dates in of.values())
    random.shuffle(measured)  # type: ignore[attr-defined]
    assert machines(measured) == of
