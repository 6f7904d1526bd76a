"""Calls of translated jobs as C: their arguments as data, and a list of what to run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from filters.translation.declarations import memory, variable
from filters.translation.kinds import Array, Kind, Nothing, Real, Record, lasts
from filters.translation.translated import Translated
from filters.translation.unit import Unit


@dataclass
class Calls:
    """shows: whether the board prints the arrays of each call after it.

    An array that several arguments share is written once, so that they share it on the board too.
    """

    unit: Unit
    shows: bool = False
    _data: list[str] = field(default_factory=list)
    _calls: list[str] = field(default_factory=list)
    _jobs: list[str] = field(default_factory=list)
    _names: dict[int, str] = field(default_factory=dict)
    _kept: list[Any] = field(default_factory=list)

    def add(self, job: Translated, arguments: tuple[Any, ...]) -> None:
        """One call of a job."""
        given = dict(zip(job.parameters, arguments, strict=True))
        kinds = dict(zip(job.parameters, job.kinds, strict=True))
        texts = [text for name in job.used for text in self._argument(given[name], kinds[name])]
        for kind in job.memory.values():
            texts.append(self._new("m"))
            self._data.append(f"static {memory(kind, texts[-1])};")
        number = len(self._jobs)
        call = f"{job.name}({', '.join(texts)});"
        if not isinstance(job.result, Nothing):
            result = self._new("result")
            self._data.append(f"static {variable(job.result, result, self.unit.record_name)};")
            call = f"{result} = {call}"
        self._calls.append(f"static void job_{number}(void)\n{{\n    {call}\n}}\n")
        shown = "0, 0"
        if self.shows:
            items = [
                f"{{{self._names[id(array)]}, {size}}}"
                for array, size in self._sizes(tuple(given[name] for name in job.used))
            ]
            self._calls.append(f"static const Shown shown_{number}[] = {{{', '.join(items)}}};\n")
            shown = f"shown_{number}, {len(items)}"
        self._jobs.append(f"{{job_{number}, {shown}}}")

    def text(self, header: str) -> str:
        """The C file."""
        jobs = f"const Job jobs[] = {{{', '.join(self._jobs)}}};\nconst int job_count = {len(self._jobs)};\n"
        return "\n".join([f'#include "{header}"\n\n#include <math.h>\n', *self._data, "", *self._calls, jobs])

    def _argument(self, value: Any, kind: Kind) -> list[str]:
        if isinstance(kind, Record):
            name = self._new("r")
            self._data.append(f"static const {self.unit.record_name(kind)} {name} = {self._value(value, kind)};")
            return [f"&{name}"]
        return [self._value(value, kind), *([str(len(value))] if isinstance(kind, Array) and kind.is_long else [])]

    def _value(self, value: Any, kind: Kind) -> str:
        match kind:
            case Array():
                return self._array(value, kind)
            case Record(fields=fields):
                texts = []
                for item, (_, part) in zip(value, fields, strict=True):
                    if lasts(part):
                        texts.append(self._value(item, part))
                        texts += [str(len(item))] if isinstance(part, Array) and part.is_long else []
                return "{" + ", ".join(texts) + "}"
            case Real():
                return self._number(float(value))
        return str(int(value))

    def _array(self, value: Any, kind: Array) -> str:
        if id(value) not in self._names:
            self._kept.append(value)
            name = self._names[id(value)] = self._new("a")
            whole = Array(kind.item, value.shape, value.shape[1:])
            self._data.append(f"static {memory(whole, name)}{f' = {self._listed(value)}' if value.any() else ''};")
        return self._names[id(value)]

    def _listed(self, value: Any) -> str:
        if value.ndim:
            return "{" + ", ".join(self._listed(item) for item in value) + "}"
        return self._number(float(value)) if value.dtype.kind == "f" else str(int(value))

    def _number(self, value: float) -> str:
        if self.unit.precision == "double":
            return value.hex() if np.isfinite(value) else self.unit.number(value)
        with np.errstate(over="ignore"):  # what a job is going to fill may hold anything
            nearest = float(np.float32(value))
        return f"{nearest.hex()}f" if np.isfinite(nearest) else self.unit.number(nearest)

    def _sizes(self, value: Any) -> Iterator[tuple[Any, str]]:
        """Arrays that the program has, and their size in C."""
        if isinstance(value, tuple):
            for item in value:
                yield from self._sizes(item)
        elif isinstance(value, np.ndarray) and value.size and id(value) in self._names:
            yield value, f"sizeof {self._names[id(value)]}"

    def _new(self, what: str) -> str:
        self._kept.append(what)
        return f"{what}_{len(self._kept)}"
