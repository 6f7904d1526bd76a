"""A C file and its header in the making: each function once for each set of kinds that it is called with."""

from __future__ import annotations

import re
from types import FunctionType

from filters.translation.body import Body, Widened
from filters.translation.declarations import memory, parameter, scalar, variable
from filters.translation.expressions import expression
from filters.translation.kinds import Array, Kind, Nothing, Record, lasts
from filters.translation.library import INDENT, Library, Translated
from filters.translation.names import c_name
from filters.translation.scope import TOP
from filters.translation.statements import GIVEN_UP, block

WIDTH = 110


class Unit(Library):
    """See `Library`; functions are translated statement by statement."""

    def _translate(self, function: FunctionType, kinds: tuple[Kind, ...]) -> Translated:
        wide: dict[str, Kind] = {}
        while True:
            body = Body(self, function, kinds, expression, wide)
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
        passed = [part for name in used for part in self._passed(kinds[name], c_name(name))] + list(body.memory)
        declared = [part for name in used for part in self._parameter(kinds[name], c_name(name))]
        declared += [parameter(kind, name) for name, kind in body.memory.items()]
        is_public = body.function in self.public
        name = self._fresh(body.function.__name__ if is_public else _version(body))
        prototype = self._prototype(body.result, name, declared, is_public)
        if lines and lines[-1] == "return;":
            lines.pop()
        lines = [line.replace(GIVEN_UP, self._given_up(body.result)) for line in lines]
        inside = "\n".join(wrapped(INDENT + line) if line else "" for line in [*own, *lines])
        return Translated(
            name,
            body.source.parameters,
            body.kinds,
            tuple(used),
            dict(body.memory),
            tuple(declared),
            tuple(passed),
            body.result,
            prototype,
            f"{_comment(body.source.doc)}{prototype}\n{{\n{inside}\n}}\n",
            tuple(dict.fromkeys(self._calls[-1])),
        )

    def _given_up(self, result: Kind) -> str:
        match result:
            case Nothing():
                return "return;"
            case Record() if not lasts(result):
                return "return;"
            case Record():
                return f"return ({self.record_name(result)}){{0}};"
        return "return 0;"

    def _parameter(self, kind: Kind, name: str) -> list[str]:
        match kind:
            case Array():
                return [parameter(kind, name), *([f"int {name}_rows"] if kind.is_long else [])]
            case Record():
                return [f"const {self.record_name(kind)} *{name}"]
        return [f"{scalar(kind)} {name}"]

    def _passed(self, kind: Kind, name: str) -> list[str]:
        return [name, f"{name}_rows"] if isinstance(kind, Array) and kind.is_long else [name]

    def _prototype(self, result: Kind, name: str, declared: list[str], is_public: bool) -> str:
        match result:
            case Array():
                inner = "".join(f"[{length or 1}]" for length in result.inner)
                head, tail = (f"{result.item} (*{name}(", f")){inner}") if inner else (f"{result.item} *{name}(", ")")
            case Record() if not lasts(result):
                head, tail = f"void {name}(", ")"
            case Record():
                head, tail = f"{self.record_name(result)} {name}(", ")"
            case _:
                head, tail = f"{scalar(result)} {name}(", ")"
        return wrapped(f"{'' if is_public else 'static '}{head}{', '.join(declared) or 'void'}{tail}")


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


def wrapped(line: str) -> str:
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
