"""The arrays of a task, and the records that point at them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from filters.jobs import Job
from filters.records import Workspace
from filters.system import System
from filters.translation.data import Data, Kept, Placing
from filters.translation.kinds import Array, Kind, Record
from studies.board.jobs import Jobs
from studies.board.template import filled

SCRATCH = "scratch"
"""The field of a model's parameters that its functions write to; nothing else of them changes."""


def add_model(data: Data, task: str, system: System, kind: Kind, name: str = "model") -> str:
    """The model as a task sees it: constants are shared, scratch is its own, for the other task may preempt it.

    Returns the name of the record, `hr_model`.
    """
    assert isinstance(kind, Record)
    data.record(f"{task}_{name}", with_own_scratch(system), kind, model_placing(task, name))
    return f"{task}_{name}"


def model_placing(task: str, name: str = "model") -> Placing:
    """Of the arrays of a model."""

    def placing(names: tuple[str, ...]) -> Kept:
        inside = names[2:]  # behind the system and its parameters
        if SCRATCH in inside:
            return Kept("_".join((task, *inside)))
        return Kept("_".join((name, *inside)), constant=True)

    return placing


def add_workspace(data: Data, task: str, work: Workspace, kind: Kind, fields: frozenset[str]) -> None:
    """The scratch arrays that its jobs use."""
    assert isinstance(kind, Record)
    data.record(f"{task}_work", work, kind, work_placing(fields))


def work_placing(fields: frozenset[str]) -> Placing:
    """Of the arrays of a workspace of which these fields are used."""

    def placing(names: tuple[str, ...]) -> Kept | None:
        return Kept("_".join(names), constant=names[-1] == "I") if names[-1] in fields else None

    return placing


def jobs_memory(system: System, jobs: Mapping[str, Job], in_c: Jobs) -> tuple[str, dict[str, int]]:
    """The file state.h of a method of which the jobs are written without tasks: the model, and each argument of the
    jobs, once for all that have it.

    Returns it, and how many numbers each of its arrays has that is no constant.
    """
    data, taken = Data(in_c.unit), dict[str, Kind]()
    for kind, job in jobs.items():
        done = in_c.by_kind[kind]
        for name, part, value in zip(done.parameters, done.kinds, job.arguments(0), strict=True):
            own = name if taken.get(name, part) == part else f"{kind}_{name}"
            if name not in done.used or own in taken or not isinstance(part, Array | Record):
                continue
            taken[own] = part
            _add_argument(data, own, system if isinstance(value, System) else value, part, in_c)
        for name, array in done.memory.items():
            data.array(Kept(f"{kind}_{name}"), np.zeros([length or 0 for length in array.shape]))
    return filled("jobs_state.h", {"memory": "\n".join(data.lines)}), data.sizes


def _add_argument(data: Data, name: str, value: Any, kind: Array | Record, in_c: Jobs) -> None:
    if isinstance(kind, Array):
        data.array(Kept(name), np.zeros_like(value), kind.item)
    elif isinstance(value, System):
        data.record(name, value, kind, model_placing("model"))
    elif isinstance(value, Workspace):
        data.record(name, value, kind, work_placing(in_c.fields(kind)))
    else:
        data.record(name, _zero(value), kind, lambda names: Kept("_".join(names)))


def with_own_scratch(system: System) -> System:
    """The system with a copy of its scratch."""
    parameters = system.parameters
    if not hasattr(parameters, SCRATCH):
        return system
    return system._replace(parameters=parameters._replace(**{SCRATCH: _copied(getattr(parameters, SCRATCH))}))


def _copied(value: Any) -> Any:
    return each_array(value, np.copy)


def _zero(value: Any) -> Any:
    return each_array(value, np.zeros_like)


def each_array(value: Any, change: Callable[[Any], Any]) -> Any:
    """The value with each array in it changed."""
    if isinstance(value, np.ndarray):
        return change(value)
    if isinstance(value, tuple):
        items = [each_array(item, change) for item in value]
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    return value
