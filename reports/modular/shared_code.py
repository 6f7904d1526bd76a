"""What the report on modular filters says of the poster's code: which systems the same parts run, how many lines they
take, and what compiling gains."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from reports.modular.results import Results
from reports.pages.machine import marked, timed_on
from reports.pages.measurements import counted_on
from reports.pages.numbers import significant, span
from reports.pages.stored import Rows
from studies.machines.parts import PartTimes
from studies.machines.ranges import range_of
from studies.modular.flight_times import FLOWN_S, PREDICTORS, STATES, WAYS
from studies.modular.shared_code import PARTS, POINTS, code_lines, systems

PYTHON, NUMPY, COMPILED = WAYS
SLOWER = (PYTHON, NUMPY)


def system_rows() -> Rows:
    """A row for each system that the same parts run."""
    rows: Rows = [["System", "states", "predictor", "correctors", "its own lines"]]
    for each in systems():
        states = span(*map(str, each.states))
        rows.append([each.name, states, ", ".join(each.predictors), ", ".join(each.correctors), each.lines])
    return rows


def flight_rows(results: Results) -> Rows:
    """Times of a flight by the way it is run, and how many times compiled code is faster: ranges over all
    measurements."""
    heads = ("Python, s", "NumPy, s", "compiled, s", "times faster than Python", "than NumPy")
    rows: Rows = [["Predictor", *map(marked, heads)]]
    for kind in PREDICTORS:
        times = [_range(results, seconds(kind, way), 3) for way in WAYS]
        rows.append([kind, *times, *(_range(results, gain(kind, way), 2) for way in SLOWER)])
    return rows


def shared_code_words(results: Results) -> dict[str, Any]:
    """Lines, and what compiling gains of the filter that is flown."""
    return {
        "systems": len(systems()),
        "lines": code_lines(*PARTS),
        "points": code_lines(*POINTS),
        "flown_s": FLOWN_S,
        "gain": {
            name: _range(results, gain("unscented", way), 2)
            for name, way in zip(("python", "numpy"), SLOWER, strict=True)
        },
        "measured_on": counted_on(results.flights),
        "timed_on": timed_on(results.flown.provenance),
    }


def seconds(kind: str, way: str) -> Callable[[PartTimes], float]:
    """The least time of a measurement."""
    return lambda times: 1e-6 * times.parts[kind, STATES, way].least


def gain(kind: str, way: str) -> Callable[[PartTimes], float]:
    """How many times as long that way takes as compiled code, both of one measurement."""
    return lambda times: seconds(kind, way)(times) / seconds(kind, COMPILED)(times)


def _range(results: Results, figure: Callable[[PartTimes], float], digits: int) -> str:
    return span(*(significant(end, digits) for end in range_of(figure, results.flights)))
