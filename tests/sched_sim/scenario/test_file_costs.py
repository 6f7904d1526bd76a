"""Costs of a scenario file: with hr_hz they are times, and say their unit."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.errors import InputError
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.scenario_file import read_scenario

TIMED = 'name = "s"\nhr_hz = 400\nsteps = 40\n'
PLAIN = 'name = "s"\nspeed = 10\nsteps = 40\n'
TASK = '[[task]]\nname = "control"\nperiod = 2\ncost = 3\npriority = 5\n'


def read(folder: Path, head: str, predictor: str, sensor: str, more: str = "") -> Scenario:
    path = folder / "s.toml"
    path.write_text(f'{head}[predictor]\n{predictor}\n[[sensor]]\nname = "gps"\nevery = 10\n{sensor}\n{more}')
    return read_scenario(path)


@pytest.mark.parametrize(("unit", "scale"), [("us", 10**6), ("ms", 10**3), ("s", 1)])
def test_a_cost_says_its_unit_or_the_file_does(tmp_path: Path, unit: str, scale: int) -> None:
    predict, gps = (Fraction(3, scale), Fraction("4.5") / scale), (Fraction(2, scale),)
    own = read(tmp_path, f"{TIMED}context_switch_{unit} = 7\n", f"cost_{unit} = [3, 4.5]", f"cost_{unit} = 2")
    of_all = read(tmp_path, f'{TIMED}unit = "{unit}"\ncontext_switch = 7\n', "cost = [3, 4.5]", "cost = 2", TASK)
    for found in (own, of_all):
        assert found.costs == {"predict": predict, "correct.gps": gps}
        assert found.context_switch == Fraction(7, scale)
    assert of_all.tasks[0].cost == Fraction(3, scale)


def test_both_may_be_given_if_they_agree(tmp_path: Path) -> None:
    found = read(tmp_path, f'{TIMED}unit = "ms"\n', "cost = 0.5\ncost_us = 500", "cost_us = 300")
    assert found.costs == {"predict": (Fraction(5, 10**4),), "correct.gps": (Fraction(3, 10**4),)}


def test_cost_units_have_no_other_unit(tmp_path: Path) -> None:
    found = read(tmp_path, f"{PLAIN}context_switch = 1\n", "cost = 3", "cost = 2", TASK)
    assert found.costs == {"predict": (3,), "correct.gps": (2,)}
    assert (found.context_switch, found.tasks[0].cost) == (1, 3)


@pytest.mark.parametrize(
    ("head", "predictor", "sensor", "more", "said"),
    [
        (
            TIMED,
            "cost = 0.5",
            "cost_us = 2",
            "",
            "predictor.cost: 0.5 has no unit, and with hr_hz costs are times: write cost_us, cost_ms or cost_s "
            'instead, or unit = "s", "ms" or "us" at the top of the file for all (given: 0.5)',
        ),
        (TIMED, "cost_us = 2", "cost = [3, 4]", "", "sensor 'gps'.cost: [3, 4] has no unit, and with hr_hz costs are"),
        (
            f"{TIMED}context_switch = 0.1\n",
            "cost_us = 2",
            "cost_us = 2",
            "",
            "context_switch: 0.1 has no unit, and with hr_hz costs are times: write context_switch_us, context_switch",
        ),
        (
            TIMED,
            "cost_us = 2",
            "cost_us = 2",
            TASK,
            "task 'control': cost = 3 has no unit, and costs are times here: write cost_us, cost_ms or cost_s, or unit",
        ),
        (
            PLAIN,
            "cost_us = 2",
            "cost = 2",
            "",
            "predictor.cost_us: it is a time, and without hr_hz no period has one: give hr_hz (steps per second) "
            "instead of speed, or cost = ... in cost units (given: 2)",
        ),
        (f"{PLAIN}context_switch_ms = 2\n", "cost = 2", "cost = 2", "", "context_switch_ms: it is a time, and without"),
        (
            f'{PLAIN}unit = "ms"\n',
            "cost = 2",
            "cost = 2",
            "",
            "unit = 'ms' makes times of costs: give hr_hz instead of speed, or delete it",
        ),
        (f'{TIMED}unit = "min"\n', "cost = 2", "cost = 2", "", "unit: choose 'us', 'ms' or 's' (given: min)"),
        (TIMED, "cost_us = 2", "cost_us = 999\ncost_ms = 1", "", "cost_us = 999 and cost_ms = 1 do not agree: leave"),
        (f'{TIMED}unit = "s"\n', "cost = 2\ncost_ms = 2", "cost = 2", "", "cost = 2 and cost_ms = 2 do not agree"),
        (TIMED, "cost_us = 0", "cost_us = 2", "", "predictor.cost_us: must be greater than 0 (given: 0)"),
        (TIMED, "cost_us = 2", "cost_ms = [1, -1]", "", "sensor 'gps'.cost_ms: entry 1 is -1: must be greater than 0"),
        (f"{TIMED}context_switch_us = -1\n", "cost_us = 2", "cost_ms = 1", "", "context_switch_us: must be at least 0"),
    ],
)
def test_a_cost_that_is_not_clear_is_refused(
    tmp_path: Path, head: str, predictor: str, sensor: str, more: str, said: str
) -> None:
    with pytest.raises(InputError, match=re.escape(said)) as caught:
        read(tmp_path, head, predictor, sensor, more)
    assert "; " not in str(caught.value).removeprefix(said)


def test_costs_that_are_no_times_say_what_to_write_with_a_rate(tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text('name = "c"\nunit = "operation"\n[samples]\npredict = [9]\ncorrect.gps = [5]\n')
    (tmp_path / "s.toml").write_text(f'{TIMED}costs = "c.toml"\n[[sensor]]\nname = "gps"\nevery = 10\n')
    with pytest.raises(InputError, match=r"give processor = \.\.\. .* write one of these units: second,"):
        read_scenario(tmp_path / "s.toml")
