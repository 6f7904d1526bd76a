"""What is said of several measurements is how many there are, of which machines, and which there are not."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from reports.pages.machine import MARK
from reports.pages.measurements import counted_on, measurement_rows, who_measured
from sched_sim.costs.table import Cost, CostTable

EPYC, XEON = "AMD EPYC", "Intel(R) Xeon(R) CPU @ 2.20GHz"


def timed(machine: str, date: str, seconds: int = 1) -> CostTable:
    costs = {"standard": {"update": Cost.of(Fraction(seconds))}}
    return CostTable("t", "second", costs, {"machine": machine, "date": date})


ONE = [timed(EPYC, "2026-11-28")]
THREE = [timed(EPYC, "2026-11-22"), timed(EPYC, "2026-11-22", 2), *ONE]
BOTH = [*THREE, timed(XEON, "2026-12-01", 3)]


@pytest.mark.parametrize(
    ("measurements", "said"),
    [
        (ONE, "1 measurement on 1 machine (AMD EPYC)"),
        (THREE, "3 measurements on 1 machine (AMD EPYC)"),
        (BOTH, f"4 measurements on 2 machines (AMD EPYC 3, {XEON} 1)"),
    ],
)
def test_how_many_and_on_which_machines(measurements: list[CostTable], said: str) -> None:
    assert counted_on(measurements) == said
    assert f"ranges over {said}, " in who_measured(measurements)
    assert MARK in who_measured(measurements)


def test_when() -> None:
    assert "(AMD EPYC), 2026-11-28, each" in who_measured(ONE)
    assert "(AMD EPYC), 2026-11-22 to 2026-11-28, each" in who_measured(THREE)
    assert ", 2026-11-22 to 2026-12-01, each" in who_measured(BOTH)


def test_that_one_machine_is_alone_and_no_xeon_is_said_until_there_is_one() -> None:
    assert "No other machine has measured yet, no Intel Xeon either: its times may differ more." in who_measured(THREE)
    assert "No other machine has measured yet: its times" in who_measured(BOTH[-1:])
    assert "yet" not in who_measured(BOTH)


def test_each_measurement_has_a_row_that_says_so_if_the_machine_was_busy() -> None:
    busy = replace(ONE[0], provenance={**ONE[0].provenance, "busy": "load average 9"})
    rows = measurement_rows(
        [*THREE[:2], busy, BOTH[-1]], {"update": lambda table: f"{table.entry('standard', 'update').minimum} s"}
    )
    assert rows[0] == ["machine †", "date †", "update †"]
    assert rows[1:] == [
        [EPYC, "2026-11-22", "1 s"],
        [EPYC, "2026-11-22", "2 s"],
        [EPYC, "2026-11-28, busy", "1 s"],
        [XEON, "2026-12-01", "3 s"],
    ]
