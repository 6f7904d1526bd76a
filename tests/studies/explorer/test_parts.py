"""Verdicts on parts: those of `fit`, cheapest first, with the accuracy where they land."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim import Options, fit, load_costs, on_part, read_costs, select
from sched_sim.costs.table import CostTable
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task
from studies.explorer.parts import known_parts, verdicts
from tests.studies.explorer.questions import PARTS, options

COUNTED = load_costs("counted-9-3-3")


@settings(max_examples=15)
@given(
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
    found = verdicts(COUNTED, parts, method, timing, Fraction(rate), chosen, "minimum", (), lambda L: L / 100)
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
    (on,) = verdicts(
        COUNTED, PARTS[:1], "larsen", Timing(4, 2, 4), Fraction(400), chosen, "minimum", [task], lambda _: None
    )
    assert on.part is not None
    expected = fit(select(on_part(COUNTED, on.part), "larsen"), Timing(4, 2, 4), 400, chosen, [task])
    assert (on.needed, on.load, on.landed) == (expected.needed, expected.load, expected.landed)


def test_a_part_without_a_time_for_an_operation_is_last_with_the_reason() -> None:
    lame = replace(PARTS[0], name="lame", seconds={"add": Fraction(1, 10**6)})
    found = verdicts(
        COUNTED, [lame, PARTS[0]], "clone", Timing(4, 2, 4), Fraction(400), Options(), "minimum", (), lambda _: None
    )
    assert [on.name for on in found] == [PARTS[0].name, "lame"]
    assert "gives no time for" in found[1].remark
    assert found[1].needed is None


def test_of_costs_that_are_times_it_is_the_machine(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('name = "mine"\nunit = "us"\n[costs.standard]\npropagate = 400\nupdate = 600\n')
    table = read_costs(tmp_path / "mine.toml")
    assert known_parts(table, PARTS, Fraction(400)) == ((), "")
    (on,) = verdicts(table, (), "standard", Timing(4, 0, 4), Fraction(400), Options(), "minimum", (), lambda _: 0.5)
    assert (on.name, on.needed, on.landed, on.std) == ("the machine of the costs", Fraction(2, 5), 0, 0.5)


@pytest.mark.parametrize(
    ("table", "rate", "said"),
    [
        (COUNTED, None, "give hr_hz"),
        (load_costs("steffes2014"), Fraction(400), "no counted operations: choose other costs, such as"),
        (
            CostTable("board", "instruction", {"larsen": {"update": 3}}, {"target": "cortex-m4f"}),
            Fraction(400),
            "none here states the cycles of instructions of cortex-m4f",
        ),
    ],
)  # fmt: skip
def test_where_there_are_none_it_is_told_why(table: CostTable, rate: Fraction | None, said: str) -> None:
    parts, reason = known_parts(table, [replace(part, cycles_per_instruction=None) for part in PARTS], rate)
    assert parts == ()
    assert said in reason
