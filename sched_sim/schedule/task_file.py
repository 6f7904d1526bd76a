"""Reading the user's other periodic tasks from TOML: `[[task]]` name, period, offset, cost, priority, cpu."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from sched_sim.errors import InputError, option
from sched_sim.files.toml_numbers import Number, Positive, Whole
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.schedule.tasks import Task, wrong_together


class TaskEntry(BaseModel):
    """One [[task]]."""

    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    name: str
    period: Positive
    cost: Positive
    priority: Whole
    offset: Number = Fraction(0)
    cpu: Whole = 1

    @model_validator(mode="after")
    def _possible(self) -> Self:
        try:
            self.task()
        except InputError as error:
            raise ValueError(str(error).removeprefix(f"task {self.name!r}: ")) from None
        return self

    def task(self) -> Task:
        return Task(**dict(self))


class _TaskFile(BaseModel):
    model_config = ConfigDict(extra="forbid")
    task: Annotated[list[TaskEntry], Field(min_length=1)]


def read_tasks(path: str | Path) -> list[Task]:
    """The tasks in `path`; raises InputError that lists every wrong entry with its value."""
    what = f"{option('tasks')} {str(path)!r}"
    document = read_toml(Path(path), what, "give the path of a TOML file with [[task]] entries")
    try:
        tasks = [entry.task() for entry in _TaskFile.model_validate(document).task]
    except ValidationError as error:
        wrong = problems(error, _TaskFile, document)
        raise InputError(
            f"{what}: {wrong}; each [[task]] has name, period and offset in HR periods, cost "
            f"in the unit of the cost table, and priority (smaller is more urgent; HR jobs 10, LR jobs 20)"
        ) from None
    if together := wrong_together(tasks):
        raise InputError(f"{what}: {'; '.join(together)}")
    return tasks
