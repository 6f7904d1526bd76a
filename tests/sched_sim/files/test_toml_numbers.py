"""Numbers of the user's files, and what is none."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from sched_sim.files.toml_numbers import number, whole
from sched_sim.schedule.task_file import read_tasks
from tests.command_line import Run, is_refused


@pytest.mark.parametrize(
    ("given", "found"),
    [(3, Fraction(3)), (Decimal("0.78"), Fraction(39, 50)), ("77/100", Fraction(77, 100)), ("-1/3", Fraction(-1, 3))],
)
def test_decimals_and_quotients_are_exact(given: Any, found: Fraction) -> None:
    assert number(given) == found


@pytest.mark.parametrize("given", [True, "1.5", "", "x", [1], {"a": 1}, None])
def test_what_is_no_number(given: Any) -> None:
    with pytest.raises(ValueError, match="must be a number"):
        number(given)


@pytest.mark.parametrize("given", [True, "5", Decimal("5"), [5], None])
def test_what_is_no_whole_number(given: Any) -> None:
    with pytest.raises(ValueError, match="must be a whole number"):
        whole(given)


@pytest.mark.parametrize("given", ["1/0", "a/b", "1/2/3", Decimal("NaN"), Decimal("-Infinity")])
def test_what_is_no_finite_number(given: Any) -> None:
    with pytest.raises(ValueError, match="give a finite number such as"):
        number(given)


def test_quotients_in_task_files(tmp_path: Path) -> None:
    (tmp_path / "t.toml").write_text(
        '[[task]]\nname = "a"\nperiod = "7/3"\ncost = "1/3"\npriority = 5\noffset = "2/3"\n'
    )
    (task,) = read_tasks(tmp_path / "t.toml")
    assert (task.period, task.cost, task.offset) == (Fraction(7, 3), Fraction(1, 3), Fraction(2, 3))


@pytest.mark.parametrize("number", ["nan", "-inf"])
@pytest.mark.parametrize(
    ("line", "text"),
    [
        ("minimum -N 4 -M 1 --tasks", '[[task]]\nname = "a"\ncost = 1\npriority = 5\nperiod = {}'),
        ("minimum -N 4 -M 1 --costs", 'name = "c"\nunit = "u"\n[costs.standard]\nupdate = 1\npropagate = {}'),
        ("simulate --scenario", 'name = "s"\nsteps = 9\nspeed = {}\n[predictor]\n[[sensor]]\nname = "a"\nevery = 1'),
        ("sweep --results r.sqlite", "N = 4\nM = 1\nspeed = [{}]"),
    ],
)
def test_the_remedy_is_one_for_a_file(sched_sim: Run, tmp_path: Path, number: str, line: str, text: str) -> None:
    (tmp_path / "f.toml").write_text(text.format(number))
    is_refused(sched_sim(f"{line} f.toml"), ["f.toml", 'give a finite number such as 0.78 or "77/100"'])
