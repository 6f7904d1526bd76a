"""A C file and its header in the making: each function once for each set of kinds that it is called with."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from types import FunctionType
from typing import Any, Literal, TypeAlias

import numpy as np

from filters.translation.arrays import INDENT
from filters.translation.body import Body, Widened
from filters.translation.declarations import memory, parameter, scalar, variable
from filters.translation.helpers import HELPERS
from filters.translation.kinds import Array, Kind, Record, lasts
from filters.translation.names import c_name
from filters.translation.refusal import Untranslatable
from filters.translation.scope import TOP
from filters.translation.statements import block

Precision: TypeAlias = Literal["single", "double"]
WIDTH = 110


@dataclass(frozen=True)
class Translated:
    """A function in C.

    parameters: as in Python. used: those that are left in C. memory: arrays that the caller gives behind them.
    calls: what it calls itself.
    """

    name: str
    parameters: tuple[str, ...]
    kinds: tuple[Kind, ...]
    used: tuple[str, ...]
    memory: dict[str, Array]
    result: Kind
    prototype: str
    text: str
    calls: tuple[str, ...]


@dataclass
class Unit:
    """precision: of `real`. public: the functions that others call, whose names stay as they are."""

    precision: Precision = "double"
    public: frozenset[FunctionType] = frozenset()
    records: dict[Record, str] = field(default_factory=dict)
    helpers: set[str] = field(default_factory=set)

    _functions: dict[tuple[FunctionType, tuple[Kind, ...]], Translated] = field(default_factory=dict)
    _open: list[FunctionType] = field(default_factory=list)
    _taken: dict[str, int] = field(default_factory=dict)
    _constants: dict[str, str] = field(default_factory=dict)
    _tables: dict[bytes, tuple[str, str]] = field(default_factory=dict)
    _calls: list[list[str]] = field(default_factory=list)

    def function(self, function: FunctionType, kinds: tuple[Kind, ...]) -> Translated:
        """The function for arguments of these kinds, translated when it is first asked for.

        Raises:
            Untranslatable: something in it is not understood, or it calls itself.
        """
        if function in self._open:
            raise Untranslatable(f"{function.__module__}.{function.__qualname__} calls itself; write a loop")
        if (function, kinds) not in self._functions:
            self._open.append(function)
            self._calls.append([])
            try:
                self._functions[function, kinds] = self._translate(function, kinds)
            finally:
                self._open.pop()
                self._calls.pop()
        done = self._functions[function, kinds]
        if self._calls:
            self._calls[-1].append(done.name)
        return done

    def number(self, value: float) -> str:
        """A number as it is written in C."""
        if math.isnan(value):
            return "NAN"
        if math.isinf(value):
            return "INFINITY" if value > 0 else "-INFINITY"
        return repr(value) + ("f" if self.precision == "single" else "")

    def constant(self, name: str, text: str) -> str:
        """The name of a constant, defined once."""
        if self._constants.setdefault(name, text) == text:
            return name
        return text

    def table(self, name: str, values: np.ndarray[Any, Any], kind: Array) -> str:
        """The name of an array of numbers that never change."""
        key = repr((kind, values.tolist())).encode()
        if key not in self._tables:
            chosen = self._fresh(name.lower() or "table")
            self._tables[key] = chosen, f"static {memory(kind, chosen)} = {self._listed(values)};"
        return self._tables[key][0]

    def function_of_numbers(self, name: str) -> str:
        """sqrt, or sqrtf."""
        return name + ("f" if self.precision == "single" else "")

    def record_name(self, record: Record) -> str:
        """Its name in C."""
        if record not in self.records:
            for _, kind in record.fields:
                if isinstance(kind, Record) and lasts(kind):
                    self.record_name(kind)
            self.records[record] = self._fresh(record.name)
        return self.records[record]

    def header(self, guard: str) -> str:
        """What others see: types and public functions."""
        functions = "\n\n".join(f"{each.prototype};" for each in self._reached() if self._is_public(each))
        real = {"single": "float", "double": "double"}[self.precision]
        return (
            f"#ifndef {guard}\n#define {guard}\n\n#include <stdbool.h>\n#include <stdint.h>\n\ntypedef {real} real;\n\n"
            f"/* What happens where a function finds that it cannot go on. */\n"
            f"#ifndef FAULT\n#define FAULT(message) for (;;) {{}}\n#endif\n\n"
            f"{self._types()}\n{functions}\n\n#endif\n"
        )

    def source(self, header: str) -> str:
        """The file itself."""
        reached = self._reached()
        bodies = "\n".join(each.text for each in reached)
        helpers = "\n".join(
            text.replace("{f}", "f" if self.precision == "single" else "")
            for name, text in HELPERS.items()
            if name in self.helpers and f"{name}(" in bodies
        )
        constants = "".join(
            f"#define {name} {text}\n" for name, text in self._constants.items() if re.search(rf"\b{name}\b", bodies)
        )
        tables = "".join(f"{text}\n" for name, text in self._tables.values() if re.search(rf"\b{name}\b", bodies))
        parts = [f'#include "{header}"\n\n#include <math.h>\n', constants, tables, helpers, bodies]
        return "\n".join(part for part in parts if part)

    def _reached(self) -> list[Translated]:
        """Those that public ones need: a translation that was begun again may have left others."""
        by_name = {each.name: each for each in self._functions.values()}
        needed: set[str] = set()
        waiting = [each.name for each in by_name.values() if self._is_public(each)]
        while waiting:
            name = waiting.pop()
            if name not in needed:
                needed.add(name)
                waiting += by_name[name].calls
        return [each for each in by_name.values() if each.name in needed]

    def _is_public(self, each: Translated) -> bool:
        return not each.prototype.startswith("static")

    def _types(self) -> str:
        texts = []
        for record, name in self.records.items():
            fields = []
            for field_name, kind in record.fields:
                if lasts(kind):
                    text = c_name(field_name)
                    fields.append(f"{INDENT}{variable(kind, text, self.record_name)};")
                    if isinstance(kind, Array) and kind.is_long:
                        fields.append(f"{INDENT}int {text}_rows;")
            texts.append("typedef struct {\n" + "\n".join(fields) + f"\n}} {name};\n")
        return "\n".join(texts)

    def _translate(self, function: FunctionType, kinds: tuple[Kind, ...]) -> Translated:
        wide: dict[str, Kind] = {}
        while True:
            body = Body(self, function, kinds, wide)
            try:
                lines, _ = block(body, body.source.body)
            except Widened as found:
                wide[found.name] = found.kind
                continue
            return self._finished(body, lines)

    def _finished(self, body: Body, lines: list[str]) -> Translated:
        text = "\n".join(lines)
        own = [f"{memory(kind, name)};" for name, kind in body.own.items()]
        for name, place in body.places.items():
            value = body.names.get(name)
            if place == TOP and value is not None and lasts(value.kind):
                own.append(f"{variable(value.kind, value.text, self.record_name)};")
        used = [
            name
            for name, kind in zip(body.source.parameters, body.kinds, strict=True)
            if lasts(kind) and re.search(rf"\b{c_name(name)}(_rows)?\b", text)
        ]
        kinds = dict(zip(body.source.parameters, body.kinds, strict=True))
        declared = [part for name in used for part in self._parameter(kinds[name], c_name(name))]
        declared += [parameter(kind, name) for name, kind in body.memory.items()]
        is_public = body.function in self.public
        name = self._fresh(body.function.__name__ if is_public else _version(body))
        prototype = self._prototype(body.result, name, declared, is_public)
        if lines and lines[-1] == "return;":
            lines.pop()
        inside = "\n".join(_wrapped(INDENT + line) if line else "" for line in [*own, *lines])
        return Translated(
            name,
            body.source.parameters,
            body.kinds,
            tuple(used),
            dict(body.memory),
            body.result,
            prototype,
            f"{_comment(body.source.doc)}{prototype}\n{{\n{inside}\n}}\n",
            tuple(dict.fromkeys(self._calls[-1])),
        )

    def _parameter(self, kind: Kind, name: str) -> list[str]:
        match kind:
            case Array():
                return [parameter(kind, name), *([f"int {name}_rows"] if kind.is_long else [])]
            case Record():
                return [f"const {self.record_name(kind)} *{name}"]
        return [f"{scalar(kind)} {name}"]

    def _prototype(self, result: Kind, name: str, declared: list[str], is_public: bool) -> str:
        match result:
            case Array():
                inner = "".join(f"[{length}]" for length in result.inner)
                head, tail = (f"{result.item} (*{name}(", f")){inner}") if inner else (f"{result.item} *{name}(", ")")
            case Record():
                head, tail = f"{self.record_name(result)} {name}(", ")"
            case _:
                head, tail = f"{scalar(result)} {name}(", ")"
        return _wrapped(f"{'' if is_public else 'static '}{head}{', '.join(declared) or 'void'}{tail}")

    def _fresh(self, wanted: str) -> str:
        name = c_name(wanted)
        self._taken[name] = self._taken.get(name, 0) + 1
        return name if self._taken[name] == 1 else self._fresh(f"{name}_{self._taken[name]}")

    def _listed(self, values: np.ndarray[Any, Any]) -> str:
        if values.ndim == 0:
            return self.number(float(values)) if values.dtype.kind == "f" else str(int(values))
        return "{" + ", ".join(self._listed(item) for item in values) + "}"


def _comment(doc: str) -> str:
    lines = doc.replace("*/", "* /").splitlines()
    return "/* " + "\n".join([*lines[:1], *(f"   {line}".rstrip() for line in lines[1:])]) + " */\n" if doc else ""


def _version(body: Body) -> str:
    """The name of a function for arrays of these lengths: matmul_9x3."""
    own = body.function.__name__.strip("_")
    if body.function.__name__.startswith("_") or len(own) < 3:  # of a model: not to be taken for a variable
        own = f"{body.function.__module__.rpartition('.')[2].strip('_')}_{own}"
    lengths: list[int] = []
    for kind in body.kinds:
        if isinstance(kind, Array):
            for length in kind.shape:
                if length is not None and length not in lengths:
                    lengths.append(length)
    return f"{own}_{'x'.join(map(str, lengths))}" if lengths else own


def _wrapped(line: str) -> str:
    """Broken behind commas where it is too long."""
    if len(line) <= WIDTH or ", " not in line or "/*" in line:
        return line
    indent = " " * (len(line) - len(line.lstrip()) + 4)
    lines, rest = [], line
    while len(rest) > WIDTH:
        at = rest.rfind(", ", len(indent), WIDTH)
        if at < 0:
            break
        lines.append(rest[: at + 1])
        rest = indent + rest[at + 2 :]
    return "\n".join([*lines, rest])
