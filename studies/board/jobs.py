"""Jobs in C, and how they are called."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from types import FunctionType
from typing import NamedTuple

from filters.jobs import Job
from filters.translation.kinds import Kind, Record, kind_of
from filters.translation.library import Precision
from filters.translation.names import c_name
from filters.translation.translated import Translated
from filters.translation.unit import Unit


class Jobs(NamedTuple):
    """unit: the file in the making. by_kind: each job in C."""

    unit: Unit
    by_kind: dict[str, Translated]

    def parameter(self, kind: str, name: str) -> Kind:
        """What a parameter of a job is in C."""
        job = self.by_kind[kind]
        return dict(zip(job.parameters, job.kinds, strict=True))[name]

    def fields(self, record: Record) -> frozenset[str]:
        """Those of its fields, and of those of the records in it, that anything in the file reads or writes."""
        text = self.unit.source("")
        return frozenset(name for name in _names(record) if re.search(rf"(->|\.){c_name(name)}\b", text))


def _names(record: Record) -> Iterator[str]:
    for name, kind in record.fields:
        yield name
        if isinstance(kind, Record):
            yield from _names(kind)


def translated(jobs: Mapping[str, Job], precision: Precision) -> Jobs:
    """Raises:
    Untranslatable: something in a job, or in the model, cannot be translated; with its file and line.
    """
    functions: dict[str, FunctionType] = {kind: plain(job) for kind, job in jobs.items()}
    unit = Unit(precision, frozenset(functions.values()))
    return Jobs(
        unit,
        {
            kind: unit.function(function, tuple(kind_of(argument) for argument in jobs[kind].arguments(0)))
            for kind, function in functions.items()
        },
    )


def call(job: Translated, arguments: Mapping[str, str], memory: Mapping[str, str]) -> str:
    """The call of a job. arguments: the text of each parameter that may be left; memory: of what it returns."""
    texts = [arguments[name] for name in job.used] + [memory[name] for name in job.memory]
    return f"{job.name}({', '.join(texts)})"


def plain(job: Job) -> FunctionType:
    """The function itself."""
    assert isinstance(job.function, FunctionType)
    return job.function


def named(jobs: Mapping[str, Job], *, all_of_them: bool = False) -> dict[str, Job]:
    """The jobs, each with a function by its own name where several have the same one, or all of them."""
    functions = [job.function for job in jobs.values()]
    return {
        kind: _named(job, kind) if all_of_them or functions.count(job.function) > 1 else job
        for kind, job in jobs.items()
    }


def _named(job: Job, name: str) -> Job:
    function = plain(job)
    own = FunctionType(function.__code__, function.__globals__, name, function.__defaults__, function.__closure__)
    own.__module__, own.__qualname__ = function.__module__, function.__qualname__
    return job._replace(function=own)
