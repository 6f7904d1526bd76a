"""What an explorer was started with: own cost tables, parts, models and tasks, which no link can name otherwise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache, lru_cache
from pathlib import Path

from filters.accuracy.shipped import SHIPPED_MODELS
from sched_sim.bounds import short
from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import load_costs, shipped_tables
from sched_sim.errors import InputError, option
from sched_sim.processors.part import Part, on_part
from sched_sim.processors.part_file import load_part, shipped_parts
from sched_sim.schedule.task_file import read_tasks
from sched_sim.schedule.tasks import Task
from sched_sim.text import did_you_mean
from studies.explorer.design import Design
from studies.selection.costs import tables_for
from studies.selection.model import Model, load_model
from studies.selection.outputs import Outputs, outputs_of

START = Design(hr_hz=400, measurement_hz=5, delay_ms=110, model="ins-gps")
"""What is looked at first where nothing was asked for."""


@dataclass(frozen=True, eq=False)
class Given:
    """Beside what ships: costs, parts and models, by the names that designs have for them; the first of a kind are
    offered first.

    tasks: the path of a file, or tasks with costs in the unit of the cost table, seconds with a processor.
    start: the design that is meant by an empty query.
    """

    costs: Mapping[str, CostTable] = field(default_factory=dict)
    parts: Mapping[str, Part] = field(default_factory=dict)
    models: Mapping[str, Model] = field(default_factory=dict)
    tasks: Sequence[Task] | Path = ()
    start: Design = START

    @property
    def table_names(self) -> list[str]:
        """Of those with a method of a late measurement."""
        return list(dict.fromkeys([*self.costs, *_shipped_of_late_methods()]))

    @property
    def part_names(self) -> list[str]:
        return list(dict.fromkeys([*self.parts, *_shipped_parts()]))

    @property
    def model_names(self) -> list[str]:
        return list(dict.fromkeys([*self.models, *SHIPPED_MODELS]))

    def table(self, name: str, part: str | None = None) -> CostTable:
        """In seconds on the part, if one is named. Raises InputError for a name that is none: no link names a file."""
        _check_name("costs", name, self.table_names)
        if part is not None:
            return _table_on_part(self, name, part)
        return self.costs[name] if name in self.costs else _shipped_table(name)

    def part(self, name: str) -> Part:
        """As `table`."""
        _check_name("processor", name, self.part_names)
        return self.parts[name] if name in self.parts else _shipped_part(name)

    def model(self, name: str, hr_hz: Fraction | None) -> Model:
        """As `table`, a shipped one at a rate of the HR loop, by default its own."""
        _check_name("model", name, self.model_names)
        return self.models[name] if name in self.models else _shipped_model(name, hr_hz)

    def outputs(self, model: str, hr_hz: Fraction | None, output: str | None) -> Outputs:
        """Of the model at a rate, by default its first. Raises InputError for what the model does not have."""
        return _outputs(self, model, hr_hz, output)

    def counts(self, model: str, part: str | None = None) -> CostTable:
        """Operations of filters of a model's size, in the textbook form of the covariance update; in seconds on the
        part, if one is named. Raises InputError for a model whose operations cannot be counted."""
        return _counts(self, model) if part is None else _counts_on_part(self, model, part)

    def tasks_in(self, unit: str, unit_s: Fraction | None, hr_hz: Fraction | None) -> tuple[Task, ...]:
        """With costs in this unit of so many seconds. Raises InputError as `read_tasks` does."""
        if isinstance(self.tasks, Path):
            return _tasks(self, unit, unit_s, hr_hz)
        return tuple(self.tasks)


def _check_name(what: str, name: str, known: Sequence[str]) -> None:
    if name not in known:
        raise InputError(
            f"{option(what)} {short(repr(name))} is unknown: {did_you_mean(name, known)}choose from "
            f"{', '.join(known)}; your own are given when the explorer is started"
        )


@cache
def _shipped_of_late_methods() -> tuple[str, ...]:
    return tuple(name for name in shipped_tables() if {*DELAYED_METHODS} & {*load_costs(name).costs})


_shipped_table = cache(load_costs)
_shipped_parts = cache(shipped_parts)
_shipped_part = cache(load_part)
_shipped_model = lru_cache(maxsize=64)(load_model)


@lru_cache(maxsize=64)
def _outputs(given: Given, model: str, hr_hz: Fraction | None, output: str | None) -> Outputs:
    return outputs_of(given.model(model, hr_hz), output)


@lru_cache(maxsize=16)
def _counts(given: Given, model: str) -> CostTable:
    return tables_for(given.model(model, None), None, ("textbook",))[0]


@lru_cache(maxsize=64)
def _counts_on_part(given: Given, model: str, part: str) -> CostTable:
    return on_part(given.counts(model), given.part(part))


@lru_cache(maxsize=64)
def _table_on_part(given: Given, name: str, part: str) -> CostTable:
    return on_part(given.table(name), given.part(part))


@lru_cache(maxsize=64)
def _tasks(given: Given, unit: str, unit_s: Fraction | None, hr_hz: Fraction | None) -> tuple[Task, ...]:
    assert isinstance(given.tasks, Path)
    return tuple(read_tasks(given.tasks, hr_hz=hr_hz, unit_s=unit_s, cost_unit=unit))
