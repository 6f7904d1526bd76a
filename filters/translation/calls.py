"""Calls: of functions that are translated too, of what Python and NumPy have, and of named tuples."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from filters.translation import arrays
from filters.translation.body import Body
from filters.translation.kinds import (
    FLAG,
    NOTHING,
    REAL,
    Array,
    Constant,
    Flag,
    Function,
    Int,
    Real,
    Record,
    exactly,
    lasts,
    parameter_of,
)
from filters.translation.made import as_real, chosen, constant, make_record, shape_of, truth
from filters.translation.names import c_name
from filters.translation.origins import in_caller
from filters.translation.source import source_of
from filters.translation.values import CHOICE, COMPARED, POSTFIX, UNARY, Value
from filters.translation.words import of_call

_OF_NUMBERS = {
    "arccos": "acos",
    "arcsin": "asin",
    "arctan": "atan",
    "arctan2": "atan2",
    "absolute": "fabs",
    **{name: name for name in ("sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "expm1", "log", "log1p")},
    **{name: name for name in ("hypot", "floor", "ceil", "trunc", "copysign", "fabs", "cbrt", "exp2", "log2", "log10")},
    **{name: name for name in ("acos", "asin", "atan", "atan2", "erf", "erfc", "fmod")},
    "rint": "rint",
    "fmax": "fmax",
    "fmin": "fmin",
}
"""The names of NumPy and `math`, and those in C."""

_FUNCTIONS = {getattr(module, name) for module in (math, np) for name in _OF_NUMBERS if hasattr(module, name)}
_QUESTIONS = {getattr(module, name) for module in (math, np) for name in ("isnan", "isinf", "isfinite")}


def call(body: Body, node: ast.Call, returned: bool) -> Value:
    """Raises Untranslatable for a call that is not understood."""
    if node.keywords and not _is_of(node, arrays.MAKERS, body):
        raise body.source.refusal(node, "arguments are translated by position only")
    if isinstance(node.func, ast.Attribute) and node.func.attr == "copy" and not node.args:
        base = body.expression(node.func.value)
        if isinstance(base.kind, Array):
            return arrays.copied(body, node, base, returned)
    callee = body.expression(node.func).kind
    if isinstance(callee, Function):
        return _translated(body, node, callee, returned)
    target = callee.value if isinstance(callee, Constant) else None
    if isinstance(target, type) and issubclass(target, tuple) and hasattr(target, "_fields"):
        if len(node.args) != len(target._fields):
            raise body.source.refusal(node, f"{target.__name__} has {len(target._fields)} fields")
        return make_record(body, target, [body.expression(part, returned=returned) for part in node.args])
    if target in arrays.MAKERS:
        return arrays.made(body, node, target, returned)
    values = [body.expression(argument) for argument in node.args]
    if target is np.shape and len(values) == 1 and isinstance(values[0].kind, Array):
        return shape_of(values[0])
    if target is len and len(values) == 1:
        return _length(body, node, values[0])
    if any(isinstance(value.kind, Array) for value in values) and isinstance(target, np.ufunc):
        return arrays.each(body, node, "all", values, lambda one: _of_numbers(body, node, target, one).text, returned)
    if any(not isinstance(value.kind, Int | Real | Flag) for value in values):
        raise body.source.refusal(
            node, of_call(target, "this call is not translated; call a kernel, or write its loops")
        )
    return _of_numbers(body, node, target, values)


def _is_of(node: ast.Call, targets: Any, body: Body) -> bool:
    callee = body.expression(node.func).kind
    return isinstance(callee, Constant) and callee.value in targets


def _length(body: Body, node: ast.Call, value: Value) -> Value:
    match value.kind:
        case Array(shape=(None, *_)):
            return Value(value.rows, Int(0))
        case Array(shape=(int(rows), *_)):
            return Value(str(rows), exactly(rows))
        case Record(fields=fields):
            return Value(str(len(fields)), exactly(len(fields)))
        case Constant(value=tuple(items)):
            return Value(str(len(items)), exactly(len(items)))
    raise body.source.refusal(node, "has no length that is known")


def _translated(body: Body, node: ast.Call, callee: Function, returned: bool) -> Value:
    """A call of a function of ours, or of the user's."""
    if body.unit.is_open(callee.function):
        raise body.source.refusal(node, f"{callee.function.__qualname__} calls itself; write a loop")
    if len(node.args) != (number := len(source_of(callee.function).parameters)):
        raise body.source.refusal(node, f"{callee.function.__qualname__} has {number} parameters")
    values = [body.expression(argument, returned=returned) for argument in node.args]
    done = body.unit.function(callee.function, tuple(parameter_of(value.kind) for value in values))
    given = dict(zip(done.parameters, values, strict=True))
    texts = []
    for name in done.used:
        value = given[name]
        if isinstance(value.kind, Record) and not value.by_pointer:
            texts.append(f"&{value.within(UNARY)}")
        else:
            texts.append(value.text)
        if value.rows:
            texts.append(value.rows)
    passing = any(value.passing for value in values)
    origins = {c_name(name): value.origins for name, value in given.items()}
    for name, kind in done.memory.items():
        memory = body.array(name, kind, returned=returned)
        texts.append(memory.text)
        passing |= memory.passing
        origins[name] = memory.origins
    if not done.is_known:
        body.calls(done, origins)
    text = f"{done.name}({', '.join(texts)})"
    if lasts(done.result) or done.result == NOTHING:
        result_origins = in_caller(done.result_origins, origins)
        return Value(text, done.result, POSTFIX, passing=passing, origins=result_origins)
    if not done.is_known:
        body.before.append(f"(void){text};")
    return constant(body, done.result.known) if isinstance(done.result, Int | Flag) else Value("", done.result)


def _of_numbers(body: Body, node: ast.Call, target: Any, values: list[Value]) -> Value:
    name = getattr(target, "__name__", "")
    first = values[0] if values else None
    if target in (abs, np.absolute) and first is not None and isinstance(first.kind, Int):
        return Value(f"abs({first.text})", Int(0), POSTFIX) if not first.kind.counts else first
    if target is abs or target in _FUNCTIONS:
        function = body.unit.function_of_numbers(_OF_NUMBERS["fabs" if target is abs else name])
        return Value(f"{function}({', '.join(as_real(value).text for value in values)})", REAL, POSTFIX)
    if target in _QUESTIONS:
        return Value(f"{name}({values[0].text})", FLAG, POSTFIX)
    if target in (min, max) and len(values) == 2:
        return _extreme(body, node, target, *values)
    if target is float and first is not None and isinstance(first.kind, Int | Real):
        if isinstance(first.kind, Real) or first.as_real:
            return as_real(first)
        return Value(f"(real){first.within(UNARY)}", REAL, UNARY)
    if target is bool and first is not None:
        return truth(body, node, first)
    if target is int and first is not None:
        if isinstance(first.kind, Int):
            return first
        if isinstance(first.kind, Flag):
            return Value(f"(int){first.within(UNARY)}", Int(0, 1), UNARY)
        body.unit.helpers.add("whole_of")
        return Value(f"whole_of({first.text})", Int(), POSTFIX)
    raise body.source.refusal(node, of_call(target))


def _extreme(body: Body, node: ast.Call, target: Callable[..., Any], a: Value, b: Value) -> Value:
    """As Python has it: the first, unless the second is less, or more."""
    sign = "<" if target is min else ">"
    if isinstance(a.kind, Int) and isinstance(b.kind, Int):
        if a.kind.known is not None and b.kind.known is not None:
            return constant(body, target(a.kind.known, b.kind.known))
        kind = _bounds(target, [a.kind.low, b.kind.low], [a.kind.high, b.kind.high])
        test = Value(f"{b.within(COMPARED - 1)} {sign} {a.within(COMPARED - 1)}", FLAG, COMPARED)
        return Value(chosen(body, node, test, b, a).text, kind, CHOICE)
    a, b = as_real(a), as_real(b)
    test = Value(f"{b.within(COMPARED - 1)} {sign} {a.within(COMPARED - 1)}", FLAG, COMPARED)
    return chosen(body, node, test, b, a)


def _bounds(target: Callable[..., Any], lows: list[int | None], highs: list[int | None]) -> Int:
    """Of the smaller, or the larger, of two whole numbers."""
    known = [[bound for bound in bounds if bound is not None] for bounds in (lows, highs)]
    if target is max:
        return Int(max(known[0], default=None), max(known[1]) if len(known[1]) == 2 else None)
    return Int(min(known[0]) if len(known[0]) == 2 else None, min(known[1], default=None))
