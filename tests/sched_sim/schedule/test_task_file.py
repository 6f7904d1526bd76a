"""Task files: times in Hz, ms and us are HR periods and cost units, and what is not clear is told, each once."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.errors import InputError
from sched_sim.schedule.task_file import read_tasks
from sched_sim.schedule.tasks import Task

NAMED = '[[task]]\nname = "control"\npriority = 5\n'


def read(folder: Path, entry: str, head: str = "", hr_hz: int | None = 400, unit_s: float | None = 1) -> Task:
    (folder / "t.toml").write_text(f"{head}{NAMED}{entry}")
    (task,) = read_tasks(folder / "t.toml", hr_hz=hr_hz, unit_s=unit_s)
    return task


def test_times_are_turned_into_steps_and_cost_units(tmp_path: Path) -> None:
    """At 400 Hz a step is 2.5 ms; a cost unit is a millisecond here."""
    entry = "hz = 100\noffset_ms = 1\njitter_ms = 0.5\ndeadline_ms = 5\ncost_us = 200\npreemptive = false\n"
    found = read(tmp_path, entry, unit_s=0.001)
    assert found == Task(
        "control",
        Fraction(4),
        Fraction(1, 5),
        5,
        Fraction(2, 5),
        jitter=Fraction(1, 5),
        deadline=Fraction(2),
        preemptive=False,
    )


@pytest.mark.parametrize("period", ["hz = 100", "period_ms = 10", "period = 4", "period = 4\nperiod_ms = 10\nhz = 100"])
@pytest.mark.parametrize(
    ("head", "cost"),
    [("", "cost_us = 300"), ("", "cost_ms = 0.3"), ("", "cost_s = 3e-4"), ('unit = "us"\n', "cost = 300")],
)
def test_each_unit_says_the_same(tmp_path: Path, period: str, head: str, cost: str) -> None:
    found = read(tmp_path, f"{period}\n{cost}\n", head)
    assert found == Task("control", Fraction(4), Fraction(3, 10**4), 5)
    assert (found.offset, found.due, found.jitter, found.preemptive) == ("any", 4, 0, True)


def test_without_units_nothing_else_is_needed(tmp_path: Path) -> None:
    found = read(tmp_path, 'period = 4\ncost = 3\noffset = "any"\n', hr_hz=None, unit_s=None)
    assert found == Task("control", Fraction(4), Fraction(3), 5)


REFUSED: dict[str, tuple[str, int | None, float | None, str]] = {
    "periods that differ": ("period_ms = 10\nhz = 50\ncost_us = 1", 400, 1, "period_ms = 10 and hz = 50 do not agree"),
    "offsets that differ": (
        "period = 4\noffset = 1\noffset_ms = 1\ncost_us = 1", 400, 1, "offset = 1 and offset_ms = 1 do not agree",
    ),
    "no hr_hz": ("hz = 100\ncost = 1", None, None, "hz = 100 needs hr_hz, the HR periods in a second: give it, or"),
    "no hr_hz for a jitter": ("period = 4\njitter_ms = 1\ncost = 1", None, None, "jitter_ms = 1 needs hr_hz"),
    "no unit": ("period = 4\ncost = 1", 400, 1, "cost = 1 has no unit, and costs are times here: write cost_us,"),
    "a time where none is": ("period = 4\ncost_us = 1", 400, None, "cost_us = 1 is a time: give unit_s, the seconds"),
    "no cost": ("period = 4", 400, 1, "give one of cost, cost_us, cost_ms and cost_s, not none"),
    "two costs": ("period = 4\ncost_us = 1\ncost_ms = 1", 400, 1, "cost_s, not cost_us and cost_ms"),
    "no period": ("cost_us = 1", 400, 1, "the period is missing: give hz = ..., period_ms = ..., or period = ..."),
    "a negative jitter": ("period = 4\njitter = -1\ncost_us = 1", 400, 1, "jitter -1 must be 0 or more"),
    "a jitter beyond the deadline": (
        "period = 4\ndeadline = 2\njitter = 2\ncost_us = 1", 400, 1, "jitter 2 must be 0 or more and less than the",
    ),
    "a deadline above the period": (
        "period = 4\ndeadline_ms = 20\ncost_us = 1", 400, 1, "deadline_ms = 20 must be at most the period, period = 4",
    ),
    "a deadline above the period in hz": (
        "hz = 50\ndeadline_ms = 25\ncost_us = 1", 400, 1, "25 must be at most the period, hz = 50 (20 ms)",
    ),
    "a jitter beyond the period": (
        "period_ms = 10\njitter_ms = 12\ncost_us = 1", 400, 1,
        "jitter_ms = 12 must be 0 or more and less than the deadline, by default the period, period_ms = 10",
    ),
    "a jitter beyond a deadline in periods": (
        "hz = 100\ndeadline = 2\njitter_ms = 6\ncost_us = 1", 400, 1, "less than the deadline, deadline = 2 (5 ms)",
    ),
    "a negative offset": ("hz = 100\noffset_ms = -1\ncost_us = 1", 400, 1, "offset_ms = -1 must be 0 or more"),
    "another processor": (
        "hz = 100\noffset_ms = -1\ncost_us = 1\ncpu = 3", 400, 1, "offset_ms = -1 must be 0 or more; cpu 3 must be 1",
    ),
    "two times without a rate": (
        "hz = 100\nperiod_ms = 10\ncost = 1", None, None, "period_ms = 10 and hz = 100 need hr_hz, the HR periods in a",
    ),
    "all that a task has": ("hz = 100\ncost_us = 1\ncolour = 3", 400, 1, "or cost_us, cost_ms, cost_s), and priority"),
    "a phase that is none": ('period = 4\noffset = "some"\ncost_us = 1', 400, 1, "offset"),
}  # fmt: skip


@pytest.mark.parametrize(("entry", "hr_hz", "unit_s", "said"), REFUSED.values(), ids=REFUSED)
def test_what_is_not_clear_is_told_once(
    tmp_path: Path, entry: str, hr_hz: int | None, unit_s: float | None, said: str
) -> None:
    with pytest.raises(InputError, match=re.escape(said)) as caught:
        read(tmp_path, f"{entry}\n", hr_hz=hr_hz, unit_s=unit_s)
    assert str(caught.value).count("'control'") == 1


def test_all_that_is_wrong_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"deadline_ms = 1 needs hr_hz.*; cost_us = 1 is a time") as caught:
        read(tmp_path, "period = 4\ndeadline_ms = 1\ncost_us = 1\n", hr_hz=None, unit_s=None)
    assert str(caught.value).count("'control'") == 1
