"""Power against accuracy: each stair with its standard deviation, and which no other beats."""

from __future__ import annotations

import pytest

from sched_sim import staircase
from sched_sim.design.methods import select
from studies.explorer.accuracy import accuracy
from studies.explorer.front import FrontLine, front
from studies.selection.front import front as front_of_choice
from tests.studies.explorer.questions import question

METHODS = ["recalculate", "larsen", "dual-rate", "clone"]


def test_it_is_that_of_a_choice_of_these_options_alone() -> None:
    asked = question(N=20, M=8, within=0.5)
    stairs = {method: staircase(select(asked.tables[0], method), 20, 8) for method in METHODS}
    columns = {
        method: ([of.L for of in stairs[method]], [float(of.speed) for of in stairs[method]]) for method in METHODS
    }
    found = front(columns, {method: accuracy(asked, method) for method in METHODS})
    expected = {
        (of.method, of.L): (of.speed, of.std, of.on_front)
        for of in front_of_choice(asked, METHODS, (1,)).points
        if of.L <= 20
    }
    got = {
        (method, L): (power, pytest.approx(std), on_front)
        for method, of in found.items()
        for L, power, std, on_front in zip(of.L, of.power, of.std, of.on_front, strict=True)
    }
    assert got == expected
    assert any(on_front for of in found.values() for on_front in of.on_front)


def test_a_method_without_an_accuracy_is_left_out() -> None:
    asked = question()
    stairs = {"fuse-as-fresh": ([44], [1.0]), "larsen": ([44], [2.0])}
    found = front(stairs, {method: accuracy(asked, method) for method in stairs})
    assert found == {"larsen": FrontLine([44], [2.0], [pytest.approx(0.37293, rel=1e-4)], [True])}
