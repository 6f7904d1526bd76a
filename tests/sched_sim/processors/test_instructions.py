"""Instructions of an emulated core on a part: by its clock and the cycles that are stated."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.table import Cost, CostTable
from sched_sim.errors import InputError
from sched_sim.processors.part import Calibration, CyclesPerInstruction, Part, on_part, ranged
from sched_sim.processors.part_file import load_part, shipped_parts

BOARD = """
name = "board"
title = "my board"
precision = "single"
clock_mhz = 100
logic_per_arithmetic = 0
{stated}
[cycles]
multiply = 1
add = 1
"""
STATED = 'cycles_per_instruction = { target = "cortex-m4f", least = 1, most = "3/2", source = "timed" }'


def table(**about: object) -> CostTable:
    return CostTable(
        "counted",
        "instruction",
        {"standard": {"propagate": Cost(Fraction(100), Fraction(150), Fraction(200)), "update": Cost.of(Fraction(7))}},
        {"target": "cortex-m4f", "precision": "single", **about},
    )


@pytest.fixture
def board(tmp_path: Path) -> Part:
    return written(tmp_path, STATED)


def written(folder: Path, stated: str) -> Part:
    (folder / "board.toml").write_text(BOARD.replace("{stated}", stated))
    return load_part(folder / "board.toml")


def test_an_instruction_takes_the_most_cycles_that_are_stated(board: Part) -> None:
    found = on_part(table(), board)
    cycle = Fraction(1, 10**8)
    assert found.unit == "second"
    assert found.entry("standard", "propagate") == Cost(150 * cycle, 225 * cycle, 300 * cycle)
    assert found.target == "cortex-m4f"
    assert found.provenance["processor"]["cycles_per_instruction"] == "1 to 1.5"
    assert found.provenance["processor"]["cycles_per_instruction_source"] == "timed"


def test_the_range_is_from_the_least_cycles_to_the_most(board: Part) -> None:
    assert ranged(table(), board).calibration == Calibration(Fraction(2, 3), Fraction(1))
    counted = CostTable("counted", "operation", {}, {}, operations={})
    assert ranged(counted, board) == board


@given(st.fractions(min_value=Fraction(1, 10), max_value=10), st.fractions(min_value=1, max_value=10**9))
def test_times_grow_with_the_cycles_and_fall_with_the_clock(most: Fraction, clock_hz: Fraction) -> None:
    stated = CyclesPerInstruction(most / 2, most, "cortex-m4f")
    part = Part("any", "any", "unstated", clock_hz, {}, Fraction(0), {}, cycles_per_instruction=stated)
    assert on_part(table(), part).entry("standard", "update").minimum == 7 * most / clock_hz


@pytest.mark.parametrize(
    ("about", "stated", "said"),
    [
        ({}, "", "does not state the cycles of such"),
        ({"target": "cortex-m7"}, STATED, "has instructions of cortex-m7, and processor 'board' does not state"),
        ({"precision": "double"}, STATED, "in double precision, and processor 'board' computes in single"),
    ],
)
def test_instructions_of_another_core_or_precision_are_refused(
    tmp_path: Path, about: dict[str, str], stated: str, said: str
) -> None:
    with pytest.raises(InputError, match=said):
        on_part(table(**about), written(tmp_path, stated))


def test_instructions_of_no_core_are_refused(board: Part) -> None:
    with pytest.raises(InputError, match="does not say of which core"):
        on_part(replace(table(), provenance={}), board)


def test_a_part_without_a_clock_is_refused(board: Part) -> None:
    with pytest.raises(InputError, match="has no clock"):
        on_part(table(), replace(board, clock_hz=None))


@pytest.mark.parametrize(
    ("stated", "said"),
    [
        ('cycles_per_instruction = { target = "a", least = 2, most = 1 }', "most is 1: it must be at least least, 2"),
        ('cycles_per_instruction = { target = "a", least = 0, most = 1 }', "least is 0"),
        ("cycles_per_instruction = { least = 1, most = 2 }", "target: is missing"),
    ],
)
def test_what_is_wrong_in_a_file_is_named(tmp_path: Path, stated: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        written(tmp_path, stated)


def test_cycles_per_instruction_need_a_clock(tmp_path: Path) -> None:
    text = BOARD.replace("{stated}", STATED).replace("clock_mhz = 100\n", "").replace("[cycles]", "[microseconds]")
    (tmp_path / "board.toml").write_text(text)
    with pytest.raises(InputError, match="need the clock"):
        load_part(tmp_path / "board.toml")


def test_shipped_parts_that_state_cycles_say_why() -> None:
    stated = {name: cycles for name in shipped_parts() if (cycles := load_part(name).cycles_per_instruction)}
    assert set(stated) == {"cortex-m33", "cortex-m4f", "cortex-m7", "cortex-m7-single"}
    for cycles in stated.values():
        assert cycles.source
        assert cycles.least <= 1 < cycles.most
