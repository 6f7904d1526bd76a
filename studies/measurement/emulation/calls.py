"""Calls of translated jobs as C: their arguments as data, and a list of what to run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from filters.translation.data import Data, Kept
from filters.translation.declarations import memory, variable
from filters.translation.kinds import Array, Kind, Nothing, Record
from filters.translation.translated import Translated
from filters.translation.unit import Unit


@dataclass
class Calls:
    """shows: whether the board prints the arrays of each call after it.

    An array that several arguments share is written once, so that they share it on the board too.
    """

    unit: Unit
    shows: bool = False
    _data: Data = field(init=False)
    _calls: list[str] = field(default_factory=list)
    _jobs: list[str] = field(default_factory=list)
    _count: int = 0

    def __post_init__(self) -> None:
        self._data = Data(self.unit, refuses=False)  # what a job is going to fill may hold anything

    def add(self, job: Translated, arguments: tuple[Any, ...]) -> None:
        """One call of a job."""
        given = dict(zip(job.parameters, arguments, strict=True))
        kinds = dict(zip(job.parameters, job.kinds, strict=True))
        texts = [text for name in job.used for text in self._argument(given[name], kinds[name])]
        for kind in job.memory.values():
            texts.append(self._new("m"))
            self._data.lines.append(f"static {memory(kind, texts[-1])};")
        number = len(self._jobs)
        call = f"{job.name}({', '.join(texts)});"
        if not isinstance(job.result, Nothing):
            result = self._new("result")
            self._data.lines.append(f"static {variable(job.result, result, self.unit.record_name)};")
            call = f"{result} = {call}"
        self._calls.append(f"static void job_{number}(void)\n{{\n    {call}\n}}\n")
        shown = "0, 0"
        if self.shows:
            items = [f"{{{name}, sizeof {name}}}" for name in self._arrays(tuple(given[name] for name in job.used))]
            self._calls.append(f"static const Shown shown_{number}[] = {{{', '.join(items)}}};\n")
            shown = f"shown_{number}, {len(items)}"
        self._jobs.append(f"{{job_{number}, {shown}}}")

    def text(self, header: str) -> str:
        """The C file."""
        jobs = f"const Job jobs[] = {{{', '.join(self._jobs)}}};\nconst int job_count = {len(self._jobs)};\n"
        return "\n".join([f'#include "{header}"\n\n#include <math.h>\n', *self._data.lines, "", *self._calls, jobs])

    def _argument(self, value: Any, kind: Kind) -> list[str]:
        if isinstance(kind, Record):
            name = self._new("r")
            self._data.record(name, value, kind, self._placing)
            return [f"&{name}"]
        text = self._data.text(value, kind, (), self._placing)
        return [text, *([str(len(value))] if isinstance(kind, Array) and kind.is_long else [])]

    def _placing(self, _names: tuple[str, ...]) -> Kept:
        return Kept(self._new("a"))

    def _arrays(self, value: Any) -> Iterator[str]:
        """Those that the program has, by their names in C."""
        if isinstance(value, tuple):
            for item in value:
                yield from self._arrays(item)
        elif isinstance(value, np.ndarray) and value.size and (name := self._data.name(value)):
            yield name

    def _new(self, what: str) -> str:
        self._count += 1
        return f"{what}_{self._count}"
