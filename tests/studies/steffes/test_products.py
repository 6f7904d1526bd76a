"""Steffes Sec. III.C and III.D in counts: one more n x n x n product in each HR step, two saved by Q' and Q''."""

from __future__ import annotations

from functools import cache

from sched_sim.costs.table_file import load_costs
from studies.steffes.products import STEPS, Multiplies, multiplies


@cache
def counted() -> list[Multiplies]:
    return multiplies()


def test_dual_rate_and_larsen_multiply_exactly_one_product_more() -> None:
    for one in counted():
        assert one.more(("dual-rate", "hr_propagate")) == one.more(("larsen", "propagate_accumulate")) == one.n**3


def test_approximate_noise_saves_two_products() -> None:
    for one in counted():
        for kind in ("hr_propagate_sum", "hr_propagate_euler"):
            assert one.by_job["dual-rate", "hr_propagate"] - one.by_job["dual-rate", kind] == 2 * one.n**3


def test_the_counts_of_the_papers_size_are_those_shipped() -> None:
    shipped = load_costs("counted-9-3-3").operations
    (nine,) = [one for one in counted() if one.n == 9]
    assert nine.by_job == {(method, kind): shipped[method][kind]["multiply"] for method, kind in STEPS}
