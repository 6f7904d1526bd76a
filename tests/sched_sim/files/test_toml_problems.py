"""What is wrong in a file is told in the file's own words, whatever the value and wherever it stands."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator
from copy import deepcopy
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

from sched_sim.costs.sample_file import read_sampled_costs
from sched_sim.costs.table_file import read_costs
from sched_sim.errors import InputError
from sched_sim.processors.part_file import read_part
from sched_sim.scenario.scenario_file import read_scenario
from sched_sim.schedule.task_file import read_tasks
from studies.sweep.settings import settings

SCENARIO = """
name = "s"
steps = 9
seed = 1
late = "larsen"
speed = 2
costs = "c.toml"
context_switch = 0.1
cpus = 2
predictor = { priority = 10, cost = [0.3] }
sensor = [{ name = "a", every = 3, delay = { least = 1, most = 2 }, offset = 1, dropout = 0, land_by = 9, cost = 1 }]
task = [{ name = "t", period = 2, offset = 1, cost = 0.1, priority = 5, cpu = 1 }]
"""
TASKS = SCENARIO[SCENARIO.index("task =") :]
COSTS = """
name = "c"
unit = "ms"
costs = { larsen = { propagate = 0.2, update = { minimum = 1, median = 1, p95 = 1 } } }
operations = { larsen = { propagate = { multiply = 1 } } }
"""
SAMPLES = """
name = "m"
unit = "ms"
samples = { predict = [1], correct = { gps = [1, 2] } }
operations = { predict = { add = 1 }, correct = { gps = { add = 1 } } }
"""
PROCESSOR = """
name = "p"
title = "p"
precision = "single"
clock_mhz = { value = 100, source = "s" }
logic_per_arithmetic = 1
cycles = { multiply = 1, add = { cycles = 1, is = "latency" }, logic = 1 }
"""
GRID = """
N = [4]
M = "0:2"
speed = 0.5
method = ["larsen"]
statistic = "minimum"
cpus = 1
simulate = true
cycles = 3
"""
Read = Callable[[Path], Any]
READERS: dict[str, tuple[str, Read]] = {
    "scenario": (SCENARIO, read_scenario),
    "tasks": (TASKS, read_tasks),
    "costs": (COSTS, read_costs),
    "samples": (SAMPLES, read_sampled_costs),
    "processor": (PROCESSOR, read_part),
    "grid": (GRID, lambda path: settings({}, path)),
}
VALUES = ["1", "1.5", "-3", "true", '"x"', '""', "[]", "{}", "[1, 2]", "[[]]", "[{}]", "{ a = 1.5 }", "1979-05-27"]
INTERNAL = ("Input should", "Field required", "instance of", "valid ", "dictionary", "after validation", "Decimal(")


def places(value: Any, at: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    if at:
        yield at
    if isinstance(value, dict | list):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(item, (*at, key))


def written(value: Any) -> str:
    if isinstance(value, Raw):
        return value
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {written(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return f"[{', '.join(map(written, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    return str(value) if isinstance(value, int | Decimal) else f'"{value}"'


class Raw(str):
    """TOML as it stands."""


@pytest.mark.parametrize("kind", READERS)
def test_no_message_speaks_of_what_is_inside_the_program(kind: str, tmp_path: Path) -> None:
    text, read = READERS[kind]
    (tmp_path / "c.toml").write_text(SAMPLES)
    path = tmp_path / "f.toml"
    document = tomllib.loads(text, parse_float=Decimal)
    refused = 0
    for *within, key in places(document):
        for value in (None, *map(Raw, VALUES)):
            changed = deepcopy(document)
            at: Any = changed
            for part in within:
                at = at[part]
            if value is None:
                del at[key]
            else:
                at[key] = value
            path.write_text("\n".join(f"{name} = {written(item)}" for name, item in changed.items()))
            said = refusal(read, path)
            refused += bool(said)
            assert not any(words in said for words in INTERNAL), f"{path.read_text()}\n{said}"
    assert refused > 30


@pytest.mark.parametrize("text", ["", "task = []"])
def test_a_file_of_no_tasks_is_refused_either_way(text: str, tmp_path: Path) -> None:
    (tmp_path / "t.toml").write_text(text)
    assert "task: there is none: give at least one [[task]], with name and" in refusal(read_tasks, tmp_path / "t.toml")


def refusal(read: Read, path: Path) -> str:
    try:
        read(path)
    except InputError as error:
        return str(error)
    return ""


def test_the_keys_of_a_table_are_said_once(tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text(PROCESSOR.replace('title = "p"', 'titel = "p"\nvendor = "v"\nclock_mz = 3'))
    with pytest.raises(InputError) as refused:
        read_part(tmp_path / "p.toml")
    said = str(refused.value)
    assert said.count("the keys here are name, title, precision") == 1
    assert "titel: this key is not permitted; did you mean title? the keys here are" in said
    assert "vendor: this key is not permitted (given: v)" in said
    assert "clock_mz: this key is not permitted; did you mean clock_mhz? (given: 3)" in said
