"""Verdicts on parts: those of `fit`, cheapest first, with the accuracy where they land."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given as with_random
from hypothesis import settings
from hypothesis import strategies as st

from sched_sim import Options, fit, load_costs, on_part, read_costs, select
from sched_sim.costs.table import CostTable
from sched_sim.design.timing import Timing
from sched_sim.processors.part import Part
from sched_sim.schedule.tasks import Task
from studies.explorer.cheapest import cheapest
from studies.explorer.design import Design
from studies.explorer.given import Given
from studies.explorer.parts import Where, verdicts, where_of
from studies.explorer.resolved import resolved
from studies.explorer.view import explore
from tests.studies.explorer.questions import PARTS, options

COUNTED, PAPERS = load_costs("counted-9-3-3"), Options()


def where(parts: tuple[Part, ...], rate: int, options: Options = PAPERS, *tasks: Task) -> Where:
    return Where(COUNTED, parts, Fraction(rate), options, "minimum", tasks)


@settings(max_examples=15)
@with_random(
    st.sampled_from(["dual-rate", "larsen", "clone", "delayed-horizon"]),
    options(),
    st.integers(2, 12),
    st.data(),
    st.sampled_from([100, 5000, 100_000]),
)
def test_they_are_those_of_fit(method: str, chosen: Options, N: int, data: st.DataObject, rate: int) -> None:
    M = data.draw(st.integers(0, N - 2))
    timing = Timing(N, M, N - 1)
    parts = PARTS[::4]
    found = verdicts(where(parts, rate, chosen), method, timing, lambda L: L / 100)
    for on in found:
        assert on.part is not None
        expected = fit(select(on_part(COUNTED, on.part), method, chosen), timing, rate, chosen)
        assert (on.needed, on.load, on.fits, on.landed) == (
            expected.needed,
            expected.load,
            expected.fits,
            expected.landed,
        )
        assert on.std == (None if on.landed is None else on.landed / 100)
    does = [on for on in found if on.fits]
    assert list(found[: len(does)]) == sorted(does, key=lambda on: (-on.needed, on.load))


def test_beside_tasks_and_with_switches_too() -> None:
    chosen = Options(context_switch="0.000002")
    task = Task("control", Fraction(2), Fraction(1, 10**4), priority=5)
    (on,) = verdicts(where(PARTS[:1], 400, chosen, task), "larsen", Timing(4, 2, 4), lambda _: None)
    assert on.part is not None
    expected = fit(select(on_part(COUNTED, on.part), "larsen"), Timing(4, 2, 4), 400, chosen, [task])
    assert (on.needed, on.load, on.landed) == (expected.needed, expected.load, expected.landed)


def test_a_part_without_a_time_for_an_operation_is_last_with_the_reason() -> None:
    lame = replace(PARTS[0], name="lame", seconds={"add": Fraction(1, 10**6)})
    found = verdicts(where((lame, PARTS[0]), 400), "clone", Timing(4, 2, 4), lambda _: None)
    assert [on.name for on in found] == [PARTS[0].name, "lame"]
    assert "gives no time for" in found[1].remark
    assert found[1].needed is None


def test_what_is_not_for_sale_is_named_after_what_is_and_the_reason_is_told() -> None:
    view = explore(Design(hr_hz=1, N=5, M=2, costs="counted-9-3-3", method="larsen"), Given())
    patent = view.parts[-1]
    assert (patent.name, patent.fits) == ("patent", True)
    assert patent.needed is not None
    assert all(part.needed is not None and part.needed < patent.needed for part in view.parts[:-1])
    assert patent.reason.startswith("not for sale")
    assert f"{view.parts[0].name} would do" in view.answer.sentence
    alone = replace(PARTS[0], for_sale=False)
    (place,) = where((alone,), 1).places("larsen")
    assert [on.fits for on in cheapest([place], Timing(5, 2, 5), PAPERS, ())] == [True]


def test_of_costs_that_are_times_it_is_the_machine(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('name = "mine"\nunit = "us"\n[costs.standard]\npropagate = 400\nupdate = 600\n')
    given = Given(costs={"mine": read_costs(tmp_path / "mine.toml")})
    found, reason = where_of(resolved(Design(N=4, M=0, hr_hz=400, method="standard", costs="mine"), given))
    assert reason == ""
    assert found is not None
    (on,) = verdicts(found, "standard", Timing(4, 0, 4), lambda _: 0.5)
    assert (on.name, on.needed, on.landed, on.std) == ("the machine of the costs", Fraction(2, 5), 0, 0.5)


def test_they_are_all_that_were_given_whatever_the_design_runs_on() -> None:
    mine = replace(PARTS[0], name="mine")
    design = Design(hr_hz=400, measurement_hz=5, delay_ms=110, model="ins-gps")
    for processor in (None, "rp2040"):
        found, _ = where_of(resolved(replace(design, processor=processor), Given(parts={"mine": mine})))
        assert found is not None
        assert [part.name for part in found.parts] == ["mine", *(part.name for part in PARTS)]
        assert found.table.name == "counted-9-3-3"


BOARD = CostTable("board", "instruction", {"larsen": {"propagate": 9, "update": 3}}, {"target": "abacus"})
TASK = Task("control", Fraction(1), Fraction(1, 10**6), priority=5)


@pytest.mark.parametrize(
    ("more", "given", "said"),
    [
        ({"hr_hz": None}, Given(), "which do depends on the rate of the HR loop: give hr_hz"),
        ({"costs": "steffes2014"}, Given(), "steffes2014 has no counted operations: choose other costs"),
        ({"costs": "board"}, Given(costs={"board": BOARD}), "none here states the cycles of instructions of abacus"),
        (
            {"options": Options(context_switch=3)},
            Given(),
            "context_switch is no time beside counts: choose a processor",
        ),
        ({}, Given(tasks=(TASK,)), "the costs of the tasks are no times: choose a processor"),
    ],
)
def test_where_there_are_none_it_is_told_why(more: dict[str, Any], given: Given, said: str) -> None:
    asked = {"N": 4, "M": 2, "hr_hz": 400, "costs": "counted-9-3-3", "method": "larsen"} | more
    found, reason = where_of(resolved(Design(**asked), given))
    assert found is None
    assert said in reason
