"""A C file and its header in the making: each function once for each set of kinds that it is called with."""

from __future__ import annotations

import re
from types import FunctionType

from filters.translation.body import Body, Elsewhere, Widened
from filters.translation.declarations import memory, variable
from filters.translation.expressions import expression
from filters.translation.kinds import Array, Kind, lasts
from filters.translation.library import INDENT, Library
from filters.translation.names import c_name
from filters.translation.origins import Origins
from filters.translation.prototype import given_up, wrapped
from filters.translation.scope import TOP
from filters.translation.statements import GIVEN_UP, block
from filters.translation.translated import Translated


class Unit(Library):
    """See `Library`; functions are translated statement by statement."""

    def _translate(self, function: FunctionType, kinds: tuple[Kind, ...]) -> Translated:
        wide: dict[str, Kind] = {}
        also: dict[str, Origins] = {}
        while True:
            body = Body(self, function, kinds, expression, wide, also)
            try:
                lines, _ = block(body, body.source.body)
            except Widened as found:
                wide[found.name] = found.kind
                continue
            except Elsewhere as found:
                also[found.name] = found.origins
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
        is_public = body.function in self.public
        name = self._fresh(body.function.__name__ if is_public else _version(body))
        if lines and lines[-1] == "return;":
            lines.pop()
        kinds = dict(zip(body.source.parameters, body.kinds, strict=True))
        own += [
            f"(void){c_name(name)}_rows;"
            for name in used
            if isinstance(kind := kinds[name], Array)
            and kind.is_long
            and not re.search(rf"\b{c_name(name)}_rows\b", text)
        ]
        lines = [part for line in lines for part in (line, *_unused(line, text))]
        lines = [line.replace(GIVEN_UP, given_up(body.result, self.record_name)) for line in lines]
        inside = "\n".join(wrapped(INDENT + line) if line else "" for line in [*own, *lines])
        return Translated(
            name,
            body.function,
            body.source.parameters,
            body.kinds,
            tuple(used),
            dict(body.memory),
            body.result,
            is_public,
            inside,
            body.effects(),
            body.result_origins,
        )


_DECLARED = re.compile(r"(?:const )?\w+ \(?\*?(\w+)\)?(?:\[\d+\])* = .*\(")


def _unused(line: str, text: str) -> list[str]:
    """What tells compilers that a variable is not read: the call that it is from may leave something behind."""
    declared = _DECLARED.match(line)
    return [f"(void){declared[1]};"] if declared and len(re.findall(rf"\b{declared[1]}\b", text)) == 1 else []


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
