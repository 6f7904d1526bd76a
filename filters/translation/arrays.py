"""Arrays that a function makes: in memory of its own, or of its caller if it returns them."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np

from filters.translation.body import Body
from filters.translation.kinds import Array, Constant, Int, Real
from filters.translation.library import INDENT
from filters.translation.made import number_of
from filters.translation.values import POSTFIX, Value

MAKERS = (np.array, np.asarray, np.zeros, np.ones, np.empty, np.eye, np.identity, np.diag, np.zeros_like, np.empty_like)
Entries: TypeAlias = "np.ndarray[Any, np.dtype[np.object_]]"
"""The text of each number; None where it is left as it is."""


def made(body: Body, node: ast.Call, maker: Any, returned: bool) -> Value:
    """np.zeros((2, 3)), np.array([[a, b], [c, d]]), np.diag([a, b]), ...; always of reals.

    Raises:
        Untranslatable: its shape or its numbers are not known one by one.
    """
    for keyword in node.keywords:
        kind = body.expression(keyword.value).kind
        if keyword.arg != "dtype" or not (isinstance(kind, Constant) and kind.value in (float, np.float64)):
            raise body.source.refusal(node, f"an array of reals is made; leave {keyword.arg} out")
    entries = _entries(body, node, maker)
    kind = Array("real", entries.shape, entries.shape[1:])
    array = body.array("made", kind, returned=returned)
    zero = body.unit.number(0.0)
    if (entries == zero).sum() > entries.size / 2:
        body.before += filled(array, entries.shape, lambda _: zero)
        entries[entries == zero] = None
    for index in np.ndindex(entries.shape):
        if entries[index] is not None:
            body.before.append(f"{array.text}{''.join(f'[{i}]' for i in index)} = {entries[index]};")
    return array


def copied(body: Body, node: ast.AST, value: Value, returned: bool = False) -> Value:
    """value.copy()."""
    return each(body, node, "copied", [value], lambda items: items[0].text, returned)


def each(
    body: Body,
    node: ast.AST,
    wanted: str,
    operands: list[Value],
    number: Callable[[list[Value]], str],
    returned: bool = False,
) -> Value:
    """A new array of reals, number by number from operands of one shape, or numbers; what NumPy does with them.

    number(items): what one is, from an item of each operand.
    """
    shapes = {operand.kind.shape for operand in operands if isinstance(operand.kind, Array)}
    if len(shapes) != 1 or None in (shape := shapes.pop()):
        raise body.source.refusal(node, "arrays of one shape, that is known, and numbers go together")
    kind = Array("real", shape, tuple(length or 0 for length in shape[1:]))
    array = body.array(wanted, kind, returned=returned)
    body.before += filled(array, shape, lambda index: number([item(operand, index) for operand in operands]))
    return array


def item(value: Value, index: str) -> Value:
    """One number of an array; a number stays as it is."""
    if not isinstance(value.kind, Array):
        return value
    parts = index[1:-1].split("][")
    for axis, skipped in enumerate(value.kind.skipped, 1):
        parts[axis] += f" + {skipped}" if skipped else ""
    text = f"{value.within(POSTFIX)}[{']['.join(parts)}]"
    return Value(text, number_of(value.kind.item), POSTFIX, origins=value.origins)


def filled(array: Value, shape: Sequence[int | str | None], number: Callable[[str], str]) -> list[str]:
    """Lines that write each number of an array. number(index): what it is."""
    index = "".join(f"[i{axis}]" for axis in range(len(shape)))
    heads = [
        INDENT * axis + f"for (int i{axis} = 0; i{axis} < {length}; i{axis}++) {{" for axis, length in enumerate(shape)
    ]
    ends = [INDENT * axis + "}" for axis in reversed(range(len(shape)))]
    return [*heads, INDENT * len(shape) + f"{item(array, index).text} = {number(index)};", *ends]


def _entries(body: Body, node: ast.Call, maker: Any) -> Entries:
    one, zero = body.unit.number(1.0), body.unit.number(0.0)
    if maker in (np.zeros_like, np.empty_like):
        like = body.expression(node.args[0]).kind
        if not isinstance(like, Array) or None in like.shape:
            raise body.source.refusal(node, "is like nothing whose shape is known")
        return np.full(like.shape, zero if maker is np.zeros_like else None, dtype=object)
    if maker in (np.array, np.asarray):
        return _listed(body, node, node.args[0])
    if maker is np.diag:
        inner = node.args[0]
        if not isinstance(inner, ast.List | ast.Tuple):
            raise body.source.refusal(node, "np.diag is translated of a list of numbers")
        diagonal = _listed(body, node, inner)
        entries = np.full((len(diagonal), len(diagonal)), zero, dtype=object)
        np.fill_diagonal(entries, diagonal)
        return entries
    shape = _shape(body, node)
    if maker in (np.eye, np.identity):
        entries = np.full((shape[0], shape[-1]), zero, dtype=object)
        np.fill_diagonal(entries, one)
        return entries
    filling = {np.zeros: zero, np.ones: one, np.empty: None}[maker]
    return np.full(shape, filling, dtype=object)


def _shape(body: Body, node: ast.Call) -> tuple[int, ...]:
    first = node.args[0]
    parts = first.elts if isinstance(first, ast.Tuple) else node.args
    lengths = []
    for part in parts:
        kind = body.expression(part).kind
        if not isinstance(kind, Int) or kind.known is None or kind.known < 0:
            raise body.source.refusal(node, "the shape of an array must be known when it is translated")
        lengths.append(kind.known)
    return tuple(lengths)


def _listed(body: Body, node: ast.Call, list_: ast.expr) -> Entries:
    rows = _numbers(body, node, list_)
    try:
        entries = np.array(rows, dtype=object)
    except ValueError:
        entries = np.empty(0, dtype=object)
    if not all(isinstance(entry, str) for entry in entries.flat) or not entries.ndim:
        raise body.source.refusal(node, "np.array is translated of a list of numbers, or of rows of one length")
    return entries


def _numbers(body: Body, node: ast.Call, part: ast.expr) -> Any:
    if isinstance(part, ast.List | ast.Tuple):
        return [_numbers(body, node, item) for item in part.elts]
    value = body.expression(part)
    if not isinstance(value.kind, Int | Real):
        raise body.source.refusal(node, "np.array is translated of a list of numbers, or of rows of one length")
    if isinstance(value.kind, Real):
        return value.text
    return body.unit.number(float(value.kind.known)) if value.kind.known is not None else f"(real)({value.text})"
