"""What a person gives to studies in Python: errors name the argument, and what there is to choose from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from filters import example_system
from sched_sim import InputError, Task, load_costs, load_part, write_costs
from studies import measure, measure_filter, run_sweep

SYSTEM = example_system(2, 1, 1)


def measured(**settings: Any) -> Any:
    return measure(SYSTEM, **({"backend": "counted", "name": "mine", "methods": ["larsen"]} | settings))


@pytest.mark.parametrize("more", [{"x0": [1, 2]}, {"x0": np.ones(2)}, {"seed": np.int64(3)}, {"methods": ("larsen",)}])
def test_what_is_measured(more: dict[str, Any]) -> None:
    assert measured(**more).costs == measured().costs


@pytest.mark.parametrize(
    "M",
    [{2, 1}, (m for m in (1, 2)), iter("12"), frozenset(["1", "2"]), range(1, 3)],
    ids=lambda values: type(values).__name__,
)
def test_values_of_an_axis(M: Any) -> None:
    assert run_sweep(N=4, M=M).table.equals(run_sweep(N=4, M=[1, 2]).table)


def test_files_are_strings_or_paths(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    write_costs(replace(load_costs("steffes2014"), name="mine"), path)
    assert run_sweep(N=4, M=1, costs=path).table.equals(run_sweep(N=4, M=1, costs=str(path)).table)
    both = run_sweep(N=4, M=1, costs=(path, "steffes2014"))
    assert len(both) == 2 * len(run_sweep(N=4, M=1))


BAD: dict[str, tuple[Callable[[], Any], str]] = {
    "a string": (lambda: measured(methods="larsen"), "methods='larsen': give a list of some of standard, recalculate"),
    "no methods": (lambda: measured(methods=[]), "methods=[]: give a list of some of standard, recalculate"),
    "method": (lambda: measured(methods=["larson"]), "methods='larson' is unknown; give one of standard, recalculate"),
    "backend": (lambda: measured(backend="gpu"), "backend='gpu' is unknown; give one of compiled, counted, numpy"),
    "update": (lambda: measured(update="long"), "update='long' is unknown; give one of textbook, joseph, short"),
    "x0": (lambda: measured(x0=[1, 2, 3]), "x0 has the shape (3,); give (2,), a value for each state of the system"),
    "text": (lambda: measured(x0="zero"), "x0 is no array of numbers"),
    "seed": (lambda: measured(seed="1"), "seed='1' must be a whole number, at least 0"),
    "system": (lambda: measure("mine", name="mine"), "give a filters.system.System"),  # type: ignore[arg-type]
    "backend of parts": (
        lambda: measure_filter(None, "numpy", name="mine"),  # type: ignore[arg-type]
        "backend='numpy' is unknown; give one of compiled, counted",
    ),
    "workers": (lambda: run_sweep(N=4, workers=-1), "workers is -1: give a whole number, 0 or more"),
    "half a worker": (lambda: run_sweep(N=4, workers=0.5), "workers is 0.5: give a whole number"),  # type: ignore[arg-type]
    "results": (lambda: run_sweep(N=4, results=5), "results is 5: give the path of an SQLite file"),  # type: ignore[arg-type]
    "no results": (lambda: run_sweep(N=4, results=""), "results is '': give the path of an SQLite file"),
    "a table": (
        lambda: run_sweep(N=4, costs=load_costs("steffes2014")),
        "costs is a CostTable: give its file's path, or the name of a shipped cost table",
    ),
    "a part": (
        lambda: run_sweep(N=4, processor=["leon3", load_part("leon3")]),
        "processor is a Part: give its file's path, or the name of a shipped processor",
    ),
    "a task": (lambda: run_sweep(N=4, tasks=[Task("a", 2, 1, 5)]), "give the path of a TOML file"),
    "no values": (lambda: run_sweep(N=set()), "N is empty: give at least one value"),
}


@pytest.mark.parametrize("case", BAD)
def test_errors_name_the_argument(case: str) -> None:
    call, message = BAD[case]
    with pytest.raises(InputError) as caught:
        call()
    assert message in str(caught.value)
