"""What a person gives to the library: numbers as they write them, and errors that name the argument."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sched_sim
from sched_sim import (
    InputError,
    Options,
    Task,
    Timing,
    achieved_l,
    fit,
    least_speed,
    less_work,
    load_costs,
    select,
    simulate,
)

TABLE = load_costs("steffes2014")
COSTS = select(TABLE, "dual-rate")
TIMING = Timing(N=10, M=4, L=8)
CONTROL = Task("control", 2, 0.1, 5)


@pytest.mark.parametrize("speed", [0.8, "4/5", "0.8", Decimal("0.8"), Fraction(4, 5), np.float64(0.8)], ids=repr)
def test_a_speed_is_what_it_writes(speed: Any) -> None:
    assert simulate(COSTS, TIMING, speed, 3) == simulate(COSTS, TIMING, Fraction(4, 5), 3)
    assert achieved_l(COSTS, TIMING, speed) == achieved_l(COSTS, TIMING, Fraction(4, 5))
    assert fit(COSTS, TIMING, speed) == fit(COSTS, TIMING, Fraction(4, 5))


def test_numbers_of_records() -> None:
    assert Timing(np.int64(10), np.int32(4), 8) == TIMING
    assert Task("control", 2, 0.1, 5) == Task("control", Fraction(2), Fraction(1, 10), 5)
    assert Options(context_switch="1/100") == Options(context_switch=Fraction(1, 100))
    tasks = [Task("control", 2, 0.1, 5)]
    assert least_speed(COSTS, TIMING, tasks=tasks).speed > least_speed(COSTS, TIMING).speed


def test_tasks_may_come_one_by_one() -> None:
    assert least_speed(COSTS, TIMING, tasks=iter([CONTROL])) == least_speed(COSTS, TIMING, tasks=[CONTROL])
    assert fit(COSTS, TIMING, 1, tasks=iter([CONTROL])) == fit(COSTS, TIMING, 1, tasks=[CONTROL])
    assert simulate(COSTS, TIMING, 1, tasks=iter([CONTROL])) == simulate(COSTS, TIMING, 1, tasks=[CONTROL])


def test_costs_in_python_are_numbers() -> None:
    costs = {"propagate": 0.21, "propagate_accumulate": "3/10", "update": 0.42}
    work = select(sched_sim.CostTable("mine", "ms", {"larsen": costs}), "larsen")
    assert least_speed(work, Timing(N=80, M=40, L=60)).speed == Fraction(72, 100)


def test_a_path_is_text_or_a_path(tmp_path: Path) -> None:
    for path in (tmp_path / "a.toml", str(tmp_path / "b.toml")):
        sched_sim.write_costs(TABLE, path)
        assert sched_sim.read_costs(path).costs == TABLE.costs


BAD: dict[str, tuple[Callable[[], Any], str]] = {
    "speed": (lambda: simulate(COSTS, TIMING, -1), "speed is -1: it must be greater than 0"),
    "no speed": (lambda: achieved_l(COSTS, TIMING, "fast"), "speed is 'fast': give a finite number"),
    "a least speed": (
        lambda: simulate(COSTS, TIMING, least_speed(COSTS, TIMING)),
        "speed is LeastSpeed(speed=Fraction(77, 100), binding='lr_update'): give its .speed",
    ),
    "hr_hz": (lambda: fit(COSTS, TIMING, 0), "hr_hz is 0"),
    "cycles": (lambda: simulate(COSTS, TIMING, 1, 0), "cycles is 0: give at least 1"),
    "cycles as text": (lambda: simulate(COSTS, TIMING, 1, "3"), "cycles is '3': give a whole number"),
    "a table": (lambda: simulate(TABLE, TIMING, 1), "costs is a CostTable: give those of one method"),
    "a table too": (lambda: least_speed(TABLE, TIMING), "costs is a CostTable"),
    "a table four": (lambda: less_work(TABLE, TIMING, 1), "costs is a CostTable"),
    "speed of less work": (lambda: less_work(COSTS, TIMING, 0), "speed is 0"),
    "tries": (lambda: less_work(COSTS, TIMING, 1, tries="64"), "tries is '64': give a whole number"),
    "a table three": (lambda: achieved_l(TABLE, TIMING, 1), "costs is a CostTable"),
    "N": (lambda: Timing(10.5, 4, 8), "N is 10.5: give a whole number"),
    "M": (lambda: Timing(10, "4", 8), "M is '4': give a whole number"),
    "policy": (lambda: Options(policy="first"), "policy is 'first': choose from 'fixed', 'edf'"),
    "gain": (lambda: Options(gain="early"), "gain is 'early': choose from"),
    "cpus": (lambda: Options(cpus=3), "cpus is 3: choose from 1, 2"),
    "period": (lambda: Task("a", "soon", 1, 5), "task 'a': period is 'soon'"),
    "method": (lambda: select(TABLE, "dualrate"), "method 'dualrate' is unknown: choose from"),
    "no costs": (lambda: load_costs("none"), "cost table 'none' not found: give one of"),
    "no file of costs": (
        lambda: sched_sim.read_costs("steffes2014"),
        "cost table 'steffes2014' not found: give the path of a TOML file; `load_costs` also takes the names ",
    ),
    "no tasks": (lambda: sched_sim.read_tasks("none.toml"), "tasks 'none.toml' not found"),
    "no scenario": (lambda: sched_sim.read_scenario("none.toml"), "scenario 'none.toml' not found"),
    "no closed form": (
        lambda: achieved_l(COSTS, TIMING, 1, Options(policy="edf")),
        "options with context_switch=0 and policy='edf' have no closed form: `simulate` says",
    ),
    "cost": (lambda: sched_sim.CostTable("a", "ms", {"larsen": {"update": -1}}), "[costs.larsen] update is -1"),
    "timing": (lambda: least_speed(COSTS, (10, 4, 8)), "timing is (10, 4, 8): give Timing(N, M, L)"),
    "options": (lambda: simulate(COSTS, TIMING, 1, 1, "edf"), "options is 'edf': give Options"),
    "no options": (lambda: select(TABLE, "larsen", "p95"), "options is 'p95': give Options"),
    "statistic": (lambda: select(TABLE, "larsen", statistic="mean"), "statistic is 'mean': choose from"),
    "table": (lambda: select("steffes2014", "larsen"), "table is 'steffes2014': give a cost table"),
    "part": (lambda: sched_sim.on_part(TABLE, "cortex-m7"), "processor is 'cortex-m7': give a part"),
    "tasks": (lambda: fit(COSTS, TIMING, 1, tasks="tasks.toml"), "tasks is 'tasks.toml': give a list of Task"),
    "a task": (lambda: least_speed(COSTS, TIMING, tasks=[{"name": "a"}]), "a task is {'name': 'a'}: give Task("),
    "one task": (lambda: least_speed(COSTS, TIMING, tasks=CONTROL), "give a list of Task"),
    "two tasks": (lambda: least_speed(COSTS, TIMING, tasks=[CONTROL, CONTROL]), "'control' is used twice"),
    "priority": (lambda: Task("a", 1, 1, "5"), "task 'a': priority is '5': give a whole number"),
    "staircase": (lambda: sched_sim.staircase(COSTS, 10, -1), "M=-1 must be at least 0"),
    "no stair": (lambda: sched_sim.staircase(COSTS, 0, 0), "N=0 must be at least 1"),
    "another cpu": (
        lambda: simulate(COSTS, TIMING, 1, tasks=[Task("a", 2, 1, 5, cpu=2)]),
        "give cpus 2",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_errors_name_the_argument(case: str) -> None:
    call, message = BAD[case]
    with pytest.raises(InputError) as caught:
        call()
    assert str(caught.value).startswith(message) or message in str(caught.value)


def test_a_trace_names_itself(tmp_path: Path) -> None:
    with (
        pytest.raises(InputError, match=r"trace '.*slices\.txt': the name must end in"),
        sched_sim.open_trace(str(tmp_path / "slices.txt")),
    ):
        pass
