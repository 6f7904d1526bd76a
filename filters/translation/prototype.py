"""Functions as they are declared in C."""

from __future__ import annotations

from collections.abc import Callable, Collection

from filters.translation.declarations import parameter, scalar
from filters.translation.kinds import Array, Kind, Nothing, Record, lasts
from filters.translation.names import c_name
from filters.translation.translated import Translated

WIDTH = 120


def prototype(each: Translated, record_name: Callable[[Record], str], apart: Collection[str] = ()) -> str:
    """Its first line. apart: the parameters that share no memory with others, see `overlaps`."""
    inside = ", ".join(declared(each, record_name, apart)) or "void"
    match each.result:
        case Array(item=item, inner=lengths):
            inner = "".join(f"[{length or 1}]" for length in lengths)
            head, tail = (f"{item} (*{each.name}(", f")){inner}") if inner else (f"{item} *{each.name}(", ")")
        case Record() if is_void(each.result):
            head, tail = f"void {each.name}(", ")"
        case Record():
            head, tail = f"{record_name(each.result)} {each.name}(", ")"
        case _:
            head, tail = f"{scalar(each.result)} {each.name}(", ")"
    return wrapped(f"{'' if each.is_public else 'static '}{head}{inside}{tail}")


def declared(each: Translated, record_name: Callable[[Record], str], apart: Collection[str] = ()) -> list[str]:
    """Its parameters with their types."""
    kinds = dict(zip(each.parameters, each.kinds, strict=True))
    own = [part for name in each.used for part in _parameter(kinds[name], c_name(name), record_name, apart)]
    return own + [parameter(kind, name, apart=name in apart) for name, kind in each.memory.items()]


def passed(each: Translated) -> list[str]:
    """What is given for them, of the same names."""
    kinds = dict(zip(each.parameters, each.kinds, strict=True))
    own = [part for name in each.used for part in _passed(kinds[name], c_name(name))]
    return own + list(each.memory)


def _parameter(kind: Kind, name: str, record_name: Callable[[Record], str], apart: Collection[str]) -> list[str]:
    match kind:
        case Array():
            return [parameter(kind, name, apart=name in apart), *([f"int {name}_rows"] if kind.is_long else [])]
        case Record():
            return [f"const {record_name(kind)} *{name}"]
    return [f"{scalar(kind)} {name}"]


def _passed(kind: Kind, name: str) -> list[str]:
    return [name, f"{name}_rows"] if isinstance(kind, Array) and kind.is_long else [name]


def given_up(result: Kind, record_name: Callable[[Record], str]) -> str:
    """What ends a function that cannot go on."""
    if is_void(result):
        return "return;"
    return f"return ({record_name(result)}){{0}};" if isinstance(result, Record) else "return 0;"


def is_void(result: Kind) -> bool:
    """Whether a function with this result returns nothing in C."""
    return isinstance(result, Nothing) or (isinstance(result, Record) and not lasts(result))


def wrapped(line: str) -> str:
    """Broken behind commas where it is too long; a string in two that C takes for one."""
    if len(line) <= WIDTH or ", " not in line or "/*" in line:
        return line
    indent = " " * (len(line) - len(line.lstrip()) + 4)
    lines, rest = [], line
    while len(rest) > WIDTH:
        at = rest.rfind(", ", len(indent), WIDTH)
        if at < 0:
            break
        if rest[:at].replace('\\"', "").count('"') % 2:
            lines.append(f'{rest[: at + 2]}"')
            rest = f'{indent}"{rest[at + 2 :]}'
        else:
            lines.append(rest[: at + 1])
            rest = indent + rest[at + 2 :]
    return "\n".join([*lines, rest])
