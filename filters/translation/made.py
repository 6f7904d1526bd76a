"""Values that are made of others: constants, records and their fields, truth values, choices."""

from __future__ import annotations

import ast
from types import FunctionType
from typing import Any

import numpy as np

from filters.backends.dependencies import is_of_library
from filters.translation.body import Body
from filters.translation.kinds import (
    FLAG,
    REAL,
    Array,
    Constant,
    Flag,
    Function,
    Int,
    Kind,
    Real,
    Record,
    exactly,
    kind_of,
    lasts,
    variable_of,
)
from filters.translation.names import c_name
from filters.translation.origins import TABLES, Origins, as_field, of_field, wholly
from filters.translation.values import CHOICE, COMPARED, OR, POSTFIX, PRIMARY, UNARY, Value


def constant(body: Body, value: Any, name: str = "") -> Value:
    """A value of Python that is known; name: of a constant, which keeps it."""
    if isinstance(value, bool | np.bool_):
        return Value("true" if value else "false", Flag(bool(value)))
    if isinstance(value, int | np.integer):
        return Value(str(int(value)), exactly(int(value)), PRIMARY if value >= 0 else UNARY)
    if isinstance(value, float | np.floating):
        text = body.unit.number(float(value))
        if name.isupper() and len(name) > 1 and np.isfinite(value):
            return Value(body.unit.constant(name, text), REAL)
        return Value(text, REAL, UNARY if text.startswith("-") else PRIMARY)
    if isinstance(value, FunctionType) and not is_of_library(value):
        return Value("", Function(value))
    if isinstance(value, np.ndarray):
        kind = kind_of(value)
        assert isinstance(kind, Array)
        return Value(body.unit.table(name, value, kind), kind, origins=wholly(TABLES))
    return Value("", Constant(value))


def make_record(body: Body, made_by: type[Any] | None, values: list[Value]) -> Value:
    """A new named tuple of these parts; of no class: a tuple."""
    names = made_by._fields if made_by else [f"f{i}" for i in range(len(values))]
    fields = tuple((name, value.kind) for name, value in zip(names, values, strict=True))
    kind = Record(made_by.__name__, fields, made_by) if made_by else Record("Tuple", fields)
    if not lasts(kind):
        return Value("", kind)
    texts = []
    origins: Origins = frozenset()
    for name, value in zip(names, values, strict=True):
        if isinstance(value.kind, Array | Record):
            origins |= as_field(value.origins, name)
        if lasts(value.kind):
            texts.append(f"*{value.within(UNARY)}" if value.by_pointer else value.text)
            texts += [value.rows] if value.rows else []
    return Value(
        f"({body.unit.record_name(kind)}){{{', '.join(texts)}}}",
        kind,
        POSTFIX,
        passing=any(value.passing for value in values),
        origins=origins,
    )


def shape_of(base: Value) -> Value:
    """The shape of an array, as a tuple that is known but for the rows of a long one."""
    assert isinstance(base.kind, Array)
    lengths = [Value(str(n), exactly(n)) if n is not None else Value(base.rows, Int(0)) for n in base.kind.shape]
    return Value("", Constant(tuple(lengths)))


def field(body: Body, node: ast.AST, base: Value, name: str) -> Value:
    """A field of a record."""
    assert isinstance(base.kind, Record)
    kind = base.kind.kind_of_field(name)
    match kind:
        case None:
            raise body.source.refusal(node, f"{base.kind.name} has no field {name}")
        case Int() | Flag() if kind.known is not None:
            return constant(body, kind.known)
    text = f"{base.within(POSTFIX)}{'->' if base.by_pointer else '.'}{c_name(name)}"
    rows = f"{text}_rows" if isinstance(kind, Array) and kind.is_long else ""
    origins = of_field(base.origins, name)
    return Value(text if lasts(kind) else "", kind, POSTFIX, rows=rows, passing=base.passing, origins=origins)


def number_of(item: str) -> Kind:
    kinds: dict[str, Kind] = {"real": REAL, "bool": FLAG}
    return kinds.get(item, Int())


def truth(body: Body, node: ast.AST, value: Value) -> Value:
    """The value as a truth value."""
    match value.kind:
        case Flag():
            return value
        case Int(known=int(number)):
            return Value("true" if number else "false", Flag(bool(number)))
        case Int() | Real():
            return Value(f"{value.within(COMPARED)} != 0", FLAG, COMPARED + 1)
    raise body.source.refusal(node, "has no truth value that is translated")


def as_real(value: Value) -> Value:
    """A number among reals: C says where a whole number becomes one."""
    if not isinstance(value.kind, Int) or value.kind.known is not None:
        return value
    if value.as_real:
        return Value(value.as_real, REAL, value.level)
    return Value(f"(real){value.within(UNARY)}", REAL, UNARY)


def chosen(body: Body, node: ast.AST, test: Value, a: Value, b: Value) -> Value:
    """test ? a : b."""
    if isinstance(a.kind, Int) and isinstance(b.kind, Int):
        low = None if a.kind.low is None or b.kind.low is None else min(a.kind.low, b.kind.low)
        high = None if a.kind.high is None or b.kind.high is None else max(a.kind.high, b.kind.high)
        kind: Kind = Int(low, high)
    elif isinstance(a.kind, Int | Real) and isinstance(b.kind, Int | Real):
        kind, a, b = REAL, as_real(a), as_real(b)
    elif variable_of(a.kind) == variable_of(b.kind) and isinstance(a.kind, Flag):
        kind = FLAG
    else:
        raise body.source.refusal(node, "chooses among things that are no numbers; use if and else")
    return Value(f"{test.within(OR)} ? {a.within(OR)} : {b.within(OR)}", kind, CHOICE)
