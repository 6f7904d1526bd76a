"""Executions in measured order: what comes in a row is in a row."""

from __future__ import annotations

from fractions import Fraction

import pytest

from sched_sim.costs.table import CostTable
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.probability.stated import StatedCost
from studies.probability import blocks
from studies.probability.answer import answer
from studies.probability.blocks import autocorrelations, in_blocks
from studies.probability.question import Question, certain, stated_and_constant

ALTERNATING = [Fraction(value) for value in [10] * 90 + [16] * 10] * 5
"""Slow executions come ten at a time."""


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(blocks, "MOST_STEPS", 4000)


def standard(cost: StatedCost) -> Question:
    stated = {"propagate": cost, "update": certain(Fraction(1))}
    costs, constant, pieces = stated_and_constant(CostTable("none", "us", {}), "standard", Options(), stated, "minimum")
    return Question("standard", costs, constant, pieces, Timing(4, 0, 0), Fraction(13), cycles=5)


def test_slow_ones_in_a_row_are_worse_than_as_many_one_by_one() -> None:
    asked = standard(StatedCost(ALTERNATING))
    found = answer(asked)
    assert found.correlations["propagate"] == pytest.approx(0.899, abs=0.001)
    assert found.blocks is not None
    assert found.blocks.lengths == {"propagate": 22}
    low, _ = found.blocks.missed.interval
    assert low > 1.3 * found.hr_miss.first.upper
    assert found.blocks == in_blocks(asked)  # the same every time


def test_nothing_is_simulated_where_nothing_is_doubtful() -> None:
    assert answer(standard(StatedCost(ALTERNATING, autocorrelation=0.01))).blocks is None
    assert autocorrelations(standard(certain(Fraction(3)))) == {}


def test_none_of_many_is_no_0() -> None:
    found = in_blocks(standard(StatedCost([Fraction(2), Fraction(3)] * 50)))
    assert found is not None
    document = found.missed.document
    assert (document["events"], document["probability"], document["least"]) == (0, None, None)
    assert 0 < found.missed.interval[1] < 1e-3
