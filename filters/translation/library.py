"""What the functions of one C file share: names, types, constants, helpers; and each function once."""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from types import FunctionType
from typing import Any, Literal, TypeAlias

import numpy as np

from filters.translation.declarations import memory, variable
from filters.translation.helpers import HELPERS
from filters.translation.kinds import Array, Kind, Record, lasts
from filters.translation.names import c_name
from filters.translation.overlaps import Pair, apart
from filters.translation.prototype import prototype
from filters.translation.source import source_of
from filters.translation.translated import Translated

Precision: TypeAlias = Literal["single", "double"]
INDENT = "    "


@dataclass
class Library(ABC):
    """precision: of `real`. public: the functions that others call, whose names stay as they are.

    overlapping: what may share memory among the arguments of these; None: anything.
    """

    precision: Precision = "double"
    public: frozenset[FunctionType] = frozenset()
    overlapping: frozenset[Pair] | None = None
    records: dict[Record, str] = field(default_factory=dict)
    helpers: set[str] = field(default_factory=set)

    _functions: dict[tuple[FunctionType, tuple[Kind, ...]], Translated] = field(default_factory=dict)
    _open: list[FunctionType] = field(default_factory=list)
    _taken: dict[str, int] = field(default_factory=dict)
    _constants: dict[str, str] = field(default_factory=dict)
    _tables: dict[bytes, tuple[str, str]] = field(default_factory=dict)

    def function(self, function: FunctionType, kinds: tuple[Kind, ...]) -> Translated:
        """The function for arguments of these kinds, translated when it is first asked for.

        Raises:
            Untranslatable: something in it is not understood, or it calls itself.
        """
        if (function, kinds) not in self._functions:
            self._open.append(function)
            try:
                self._functions[function, kinds] = self._translate(function, kinds)
            finally:
                self._open.pop()
        return self._functions[function, kinds]

    def is_open(self, function: FunctionType) -> bool:
        """Whether it is being translated: a call of it is a call of itself."""
        return function in self._open

    def number(self, value: float) -> str:
        """A number as it is written in C."""
        as_real = "" if self.precision == "single" else "(double)"  # in C they are floats
        if math.isnan(value):
            return f"{as_real}NAN"
        if math.isinf(value):
            return f"{'' if value > 0 else '-'}{as_real}INFINITY"
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

    def functions(self) -> dict[str, Translated]:
        """Those of the file, by their name in C."""
        return {each.name: each for each in self._reached()}

    def apart(self) -> dict[str, frozenset[str]]:
        """By function, its parameters that share no memory with others, see `overlaps`."""
        reached, known = self._reached(), self.overlapping
        called = {each.name: each.effects.pairs() if known is None else known for each in reached if each.is_public}
        return apart({each.name: each.effects for each in reached}, called)

    def header(self, guard: str) -> str:
        """What others see: types and public functions."""
        apart = self.apart()
        functions = "\n\n".join(
            f"{prototype(each, self.record_name, apart[each.name])};" for each in self._reached() if each.is_public
        )
        real = {"single": "float", "double": "double"}[self.precision]
        return (
            f"#ifndef {guard}\n#define {guard}\n\n#include <stdbool.h>\n#include <stdint.h>\n\ntypedef {real} real;\n\n"
            f"/* What happens where a function finds that it cannot go on. */\n"
            f"#ifndef FAULT\n#define FAULT(message) for (;;) {{}}\n#endif\n\n"
            f"{self._types()}\n{functions}\n\n#endif\n"
        )

    def source(self, header: str) -> str:
        """The file itself."""
        apart = self.apart()
        bodies = "\n".join(
            f"{_comment(source_of(each.function).doc)}{prototype(each, self.record_name, apart[each.name])}\n"
            f"{{\n{each.inside}\n}}\n"
            for each in self._reached()
        )
        helpers = "\n".join(
            text.replace("{f}", "f" if self.precision == "single" else "")
            for name, text in HELPERS.items()
            if name in self.helpers and f"{name}(" in bodies
        )
        constants = "".join(
            f"#define {name} {text}\n" for name, text in self._constants.items() if re.search(rf"\b{name}\b", bodies)
        )
        tables = "".join(f"{text}\n" for name, text in self._tables.values() if re.search(rf"\b{name}\b", bodies))
        includes = "#include <math.h>\n" + ("#include <stdlib.h>\n" if re.search(r"\babs\(", bodies) else "")
        parts = [f'#include "{header}"\n\n{includes}', constants, tables, helpers, bodies]
        return "\n".join(part for part in parts if part)

    def _reached(self) -> list[Translated]:
        """Those that public ones need: a translation that was begun again may have left others."""
        by_name = {each.name: each for each in self._functions.values()}
        needed: set[str] = set()
        waiting = [each.name for each in by_name.values() if each.is_public]
        while waiting:
            name = waiting.pop()
            if name not in needed:
                needed.add(name)
                waiting += by_name[name].calls
        return [each for each in by_name.values() if each.name in needed]

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

    def _fresh(self, wanted: str) -> str:
        name = c_name(wanted)
        self._taken[name] = self._taken.get(name, 0) + 1
        return name if self._taken[name] == 1 else self._fresh(f"{name}_{self._taken[name]}")

    def _listed(self, values: np.ndarray[Any, Any]) -> str:
        if values.ndim == 0:
            return self.number(float(values)) if values.dtype.kind == "f" else str(int(values))
        return "{" + ", ".join(self._listed(item) for item in values) + "}"

    @abstractmethod
    def _translate(self, function: FunctionType, kinds: tuple[Kind, ...]) -> Translated:
        """The function for arguments of these kinds."""


def _comment(doc: str) -> str:
    lines = doc.replace("*/", "* /").splitlines()
    return "/* " + "\n".join([*lines[:1], *(f"   {line}".rstrip() for line in lines[1:])]) + " */\n" if doc else ""
