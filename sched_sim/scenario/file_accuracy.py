"""[accuracy] of a scenario file, checked: of which model, and at which outputs."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from sched_sim.files.toml_numbers import number
from sched_sim.scenario.accuracy_asked import AccuracyAsked, Rows, Seen
from sched_sim.scenario.file_entries import Entry


def _numbers(value: Any) -> tuple[float, ...]:
    if not isinstance(value, list) or not value:
        raise ValueError("must be a list of numbers, one for each state, such as [1, 1, 0.1]")
    return tuple(_finite(item, f"entry {place}") for place, item in enumerate(value))


def _rows(value: Any) -> Rows:
    if not isinstance(value, list) or not value or not all(isinstance(row, list) and row for row in value):
        raise ValueError("must be a matrix, a list of rows, such as [[1, 0, 0]]")
    if len({len(row) for row in value}) > 1:
        raise ValueError("has rows of different lengths")
    return tuple(
        tuple(_finite(item, f"row {line}, entry {place}") for place, item in enumerate(row))
        for line, row in enumerate(value)
    )


def _finite(value: Any, where: str) -> float:
    try:
        return float(number(value))
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from None


_Rows = Annotated[Any, BeforeValidator(_rows)]
_Numbers = Annotated[Any, BeforeValidator(_numbers)]
_Text = Annotated[str, Field(min_length=1)]


class _SeenEntry(Entry):
    """[accuracy.sensors.NAME]."""

    H: _Rows | None = None
    R: _Rows | None = None


class AccuracyEntry(Entry):
    """[accuracy]."""

    model: _Text | None = None
    output: _Text | None = None
    unit: str | None = None
    initial_std: _Numbers | None = None
    sensors: dict[str, _SeenEntry] = Field(default_factory=dict)

    def asked(self) -> AccuracyAsked:
        sensors = {name: Seen(entry.H, entry.R) for name, entry in self.sensors.items()}
        return AccuracyAsked(self.model, self.output, self.unit, self.initial_std, sensors)
