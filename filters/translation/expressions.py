"""Expressions: names, fields, indices, arithmetic, comparisons."""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from filters.translation import arrays
from filters.translation.body import Body
from filters.translation.calls import call
from filters.translation.kinds import (
    FLAG,
    LONG,
    REAL,
    Array,
    Constant,
    Flag,
    Int,
    Kind,
    Real,
    Record,
    kind_of,
)
from filters.translation.made import as_real, chosen, constant, field, make_record, number_of, shape_of, truth
from filters.translation.ranges import difference, negative, product, quotient, remainder, steps_past_int, total
from filters.translation.single import check_threshold, held
from filters.translation.values import AND, COMPARED, OR, POSTFIX, PRIMARY, PRODUCT, SUM, UNARY, Value
from filters.translation.words import construct

_COMPARED = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}


def expression(body: Body, node: ast.expr, returned: bool = False) -> Value:
    """returned: whether the function may return it, so that arrays it makes are in memory of the caller.

    Raises:
        Untranslatable: it is not understood.
    """
    match node:
        case ast.Constant(value=value):
            return constant(body, _held(body, node, value))
        case ast.Name(id=name):
            return _name(body, node, name)
        case ast.Attribute(value=base, attr=name):
            return _attribute(body, node, expression(body, base, returned), name)
        case ast.Subscript(value=base, slice=index):
            return _subscript(body, node, expression(body, base, returned), index)
        case ast.UnaryOp():
            return _unary(body, node, returned)
        case ast.BinOp():
            a, b = expression(body, node.left), expression(body, node.right)
            return binary(body, node, node.op, a, b, returned)
        case ast.Compare():
            return _comparison(body, node)
        case ast.BoolOp():
            return _logic(body, node)
        case ast.IfExp():
            return _choice(body, node)
        case ast.Call():
            return call(body, node, returned)
        case ast.Tuple(elts=parts):
            return make_record(body, None, [expression(body, part, returned=returned) for part in parts])
    raise body.source.refusal(node, construct(node))


def _held(body: Body, node: ast.expr, value: Any, name: str = "") -> Any:
    return held(body.source, node, value, name) if body.unit.precision == "single" else value


def _name(body: Body, node: ast.expr, name: str) -> Value:
    if name in body.names:
        return body.names[name]
    if name in body.places:
        raise body.source.refusal(node, f"{name} may not have been assigned yet")
    try:
        return constant(body, _held(body, node, body.source.value(name), name), name)
    except KeyError:
        raise body.source.refusal(node, f"{name} is not known") from None


def _attribute(body: Body, node: ast.expr, base: Value, name: str) -> Value:
    match base.kind:
        case Array() if name == "shape":
            return shape_of(base)
        case Array():
            raise body.source.refusal(node, f"of an array its shape is known, not its {name}")
        case Record():
            return field(body, node, base, name)
        case Constant(value=value) if hasattr(value, name):
            return constant(body, _held(body, node, getattr(value, name), name), name)
    raise body.source.refusal(node, f"{name} is not known")


def _subscript(body: Body, node: ast.Subscript, base: Value, index: ast.expr) -> Value:
    items = index.elts if isinstance(index, ast.Tuple) else [index]
    match base.kind:
        case Constant(value=tuple(items_known)):
            item = items_known[_known_index(body, node, items[0], len(items_known))]
            return item if isinstance(item, Value) else constant(body, item)
        case Record(fields=fields):
            return field(body, node, base, fields[_known_index(body, node, items[0], len(fields))][0])
        case Array():
            return _element(body, node, base, base.kind, items)
    raise body.source.refusal(node, "has no items")


def _known_index(body: Body, node: ast.expr, item: ast.expr, length: int) -> int:
    match expression(body, item).kind:
        case Int(known=int(number)) if -length <= number < length:
            return number % length
    raise body.source.refusal(node, "which item is taken of a tuple must be known when it is translated")


def _element(body: Body, node: ast.expr, base: Value, kind: Array, items: list[ast.expr]) -> Value:
    """One number, one row, or a part that is itself an array."""
    if len(items) > len(kind.shape):
        raise body.source.refusal(node, f"has more indices than the array has axes, {len(kind.shape)}")
    starts: list[str] = []
    lengths: list[int | None] = []
    begins: tuple[int, ...] = (0, *(kind.skipped or [0] * len(kind.inner)))
    for item, length, begin in zip(items, kind.shape, begins, strict=False):
        part = _slice_of(body, item)
        if part is None:
            if lengths:
                raise body.source.refusal(node, "an index behind a slice leaves numbers that do not lie side by side")
            starts.append(_moved(_index(body, node, item, length, base.rows), begin))
            continue
        first, last, step = part.indices(length or LONG)
        if step != 1 or (length is None and part != slice(None)):
            raise body.source.refusal(node, "slices without a step are translated, of arrays whose length is known")
        starts.append(str(first + begin))
        lengths.append(None if length is None else max(last - first, 0))
    rest = kind.shape[len(items) :]
    at = len(starts) - len(lengths)
    text = base.within(POSTFIX) + "".join(f"[{start}]" for start in starts[:at])
    if not lengths and not rest:
        found = number_of(kind.item)
        text, level = (f"(int){text}", UNARY) if isinstance(found, Int) else (text, POSTFIX)
        return Value(text, found, level, origins=base.origins)
    begins = (*map(int, starts[at:]), *begins[len(starts) :])
    result = Array(kind.item, (*lengths, *rest), kind.inner[at:], begins[1:] if any(begins[1:]) else ())
    if begins[0]:
        return Value(f"&{text}[{begins[0]}]", result, UNARY, passing=base.passing, origins=base.origins)
    rows = base.rows if at == 0 else ""
    return Value(text, result, POSTFIX, rows=rows, passing=base.passing, origins=base.origins)


def _moved(index: str, offset: int) -> str:
    if not offset:
        return index
    return str(int(index) + offset) if index.isdecimal() else f"{index} + {offset}"


def _slice_of(body: Body, item: ast.expr) -> slice | None:
    """None for an index; raises unless the bounds are known."""
    if isinstance(item, ast.Slice):
        bounds = []
        for bound in (item.lower, item.upper, item.step):
            known = None if bound is None else expression(body, bound).kind
            if known is not None and not (isinstance(known, Int) and known.known is not None):
                raise body.source.refusal(item, "the bounds of a slice must be known when it is translated")
            bounds.append(known.known if isinstance(known, Int) else None)
        return slice(*bounds)
    match expression(body, item).kind:
        case Constant(value=slice() as found):
            return found
    return None


def _index(body: Body, node: ast.expr, item: ast.expr, length: int | None, rows: str) -> str:
    at = expression(body, item)
    if not isinstance(at.kind, Int):
        raise body.source.refusal(node, "an index must be a whole number, and one that an int of 32 bits holds")
    if length is not None and at.kind.low is not None and at.kind.low >= length:
        raise body.source.refusal(node, f"the index is {at.kind.low}, of an axis of {length}")
    if at.kind.counts:
        return at.text
    if at.kind.known is not None and length is not None:
        if at.kind.known < -length:
            raise body.source.refusal(node, f"the index is {at.kind.known}, of an axis of {length}")
        return str(at.kind.known + length)
    body.unit.helpers.add("from_end")
    return f"from_end({at.text}, {rows if length is None else length})"


def _unary(body: Body, node: ast.UnaryOp, returned: bool) -> Value:
    if isinstance(node.op, ast.Not):
        flag = condition(body, node.operand)
        if isinstance(flag.kind, Flag) and flag.kind.known is not None:
            return constant(body, not flag.kind.known)
        return Value(f"!{flag.within(UNARY)}", FLAG, UNARY)
    value = expression(body, node.operand)
    if isinstance(value.kind, Int) and value.kind.known is not None:
        known = value.kind.known
        return constant(body, {ast.USub: -known, ast.UAdd: known, ast.Invert: ~known}[type(node.op)])
    if isinstance(value.kind, Flag):
        value = Value(value.text, Int(0, 1), value.level)
    if isinstance(value.kind, Array) and isinstance(node.op, ast.USub):
        return arrays.each(body, node, "all", [value], lambda items: f"-{items[0].text}", returned)
    if not isinstance(value.kind, Int | Real) or not isinstance(node.op, ast.USub | ast.UAdd):
        raise body.source.refusal(node, "is no arithmetic of numbers or arrays")
    if isinstance(node.op, ast.UAdd):
        return value
    operand = value.within(UNARY)
    kind: Kind = negative(value.kind) if isinstance(value.kind, Int) else REAL
    return Value(f"-({operand})" if operand.startswith("-") else f"-{operand}", kind, UNARY)


def binary(body: Body, node: ast.AST, operator: ast.operator, a: Value, b: Value, returned: bool = False) -> Value:
    """a + b and so on, of two numbers."""
    if isinstance(operator, ast.MatMult):
        raise body.source.refusal(
            node, "call matmul or matvec of filters.kernels.dense, whose operations have an order"
        )
    if any(isinstance(value.kind, Array) for value in (a, b)):
        return arrays.each(
            body, node, "all", [a, b], lambda items: binary(body, node, operator, items[0], items[1]).text, returned
        )
    if not (isinstance(a.kind, Int | Real | Flag) and isinstance(b.kind, Int | Real | Flag)):
        raise body.source.refusal(node, "is no arithmetic of numbers or arrays")
    a, b = (Value(x.text, Int(0, 1), x.level) if isinstance(x.kind, Flag) else x for x in (a, b))
    whole = isinstance(a.kind, Int) and isinstance(b.kind, Int)
    if not whole and not isinstance(operator, ast.Pow):
        a, b = as_real(a), as_real(b)
    left, right = (x.kind if isinstance(x.kind, Int) else Int() for x in (a, b))
    match operator:
        case ast.Add():
            kind, sign, level = total(left, right), "+", SUM
        case ast.Sub():
            kind, sign, level = difference(left, right), "-", SUM
        case ast.Mult():
            kind, sign, level = product(left, right), "*", PRODUCT
        case ast.Div():
            if whole:
                a = as_real(a) if a.as_real else Value(f"(real){a.within(UNARY)}", REAL, UNARY)
                b = as_real(b) if b.as_real else b
            return Value(f"{a.within(PRODUCT)} / {b.within(UNARY)}", REAL, PRODUCT)
        case ast.Mod() | ast.FloorDiv():
            return _division(body, node, a, b, isinstance(operator, ast.Mod), (left, right) if whole else None)
        case ast.Pow():
            return _power(body, node, a, b)
        case _:
            raise body.source.refusal(node, "this operator is not translated")
    if whole and kind.known is not None:
        return constant(body, kind.known)
    text = f"{a.within(level)} {sign} {b.within(level - 1)}"
    if not whole:
        return Value(text, REAL, level)
    return _of_ints(Value(text, kind, level), a, b, sign)


def _of_ints(value: Value, a: Value, b: Value, sign: str) -> Value:
    """A sum or product of whole numbers, among reals where an int cannot hold it: there it is exact as far as reals
    are, as whole numbers of Python are. Where it is an int, what an array has room for fits."""
    assert isinstance(value.kind, Int)
    assert isinstance(a.kind, Int)
    assert isinstance(b.kind, Int)
    real = f"{as_real(a).within(value.level)} {sign} {as_real(b).within(value.level - 1)}"
    if not value.kind.fits or steps_past_int(a.kind, b.kind, sign):
        return Value(real, REAL, value.level)
    grows = value.kind.high is None and sign == "*"
    return replace(value, as_real=real) if grows or a.as_real or b.as_real else value


def _division(body: Body, node: ast.AST, a: Value, b: Value, is_rest: bool, whole: tuple[Int, Int] | None) -> Value:
    """a % b, or a // b. whole: their kinds, of whole numbers."""
    if whole is None:
        if not is_rest:
            raise body.source.refusal(node, "// of numbers that are not whole; use np.floor")
        body.unit.helpers.add("real_mod")
        return Value(f"real_mod({a.text}, {b.text})", REAL, POSTFIX)
    left, right = whole
    kind = remainder(left, right) if is_rest else quotient(left, right)
    if kind.known is not None:
        return Value(str(kind.known), kind, PRIMARY if kind.known >= 0 else UNARY)
    if left.counts and right.counts:
        return Value(f"{a.within(PRODUCT)} {'%' if is_rest else '/'} {b.within(UNARY)}", kind, PRODUCT)
    helper = "floor_mod" if is_rest else "floor_div"
    body.unit.helpers.add(helper)
    return Value(f"{helper}({a.text}, {b.text})", kind, POSTFIX)


def _power(body: Body, node: ast.AST, a: Value, b: Value) -> Value:
    exponent = b.kind.known if isinstance(b.kind, Int) else None
    if isinstance(a.kind, Int):
        if a.kind.known is None or exponent is None or exponent < 0:
            raise body.source.refusal(node, "a power of a whole number is not translated; multiply")
        return constant(body, a.kind.known**exponent)
    if exponent == 2:
        if a.level <= POSTFIX and "(" not in a.text:
            return Value(f"{a.text} * {a.text}", REAL, PRODUCT)
        body.unit.helpers.add("square")
        return Value(f"square({a.text})", REAL, POSTFIX)
    return Value(f"{body.unit.function_of_numbers('pow')}({a.text}, {b.text})", REAL, POSTFIX)


def _comparison(body: Body, node: ast.Compare) -> Value:
    if body.unit.precision == "single":
        check_threshold(body.source, node, body.names)
    terms = [expression(body, term) for term in (node.left, *node.comparators)]
    known = [_known(term.kind) for term in terms]
    if len(known) == 2 and None not in known and isinstance(node.ops[0], ast.Eq | ast.NotEq):
        return constant(body, (known[0] == known[1]) == isinstance(node.ops[0], ast.Eq))
    if any(isinstance(term.kind, Real) for term in terms):
        terms = [as_real(term) for term in terms]
    signs = [_COMPARED.get(type(operator)) for operator in node.ops]
    if None in signs or not all(isinstance(term.kind, Int | Real | Flag) for term in terms):
        raise body.source.refusal(node, "this comparison is not translated")
    if len(terms) > 2 and any("(" in term.text for term in terms[1:-1]):
        raise body.source.refusal(node, "give what stands in the middle a name first")
    pairs = list(zip(terms, signs, terms[1:], strict=False))
    answers = [_settled(a, str(sign), b) for a, sign, b in pairs]
    if False in answers:
        return constant(body, False)
    left = [pair for pair, answer in zip(pairs, answers, strict=True) if answer is None]
    if not left:
        return constant(body, True)
    text = " && ".join(f"{a.within(COMPARED - 1)} {sign} {b.within(COMPARED - 1)}" for a, sign, b in left)
    return Value(text, FLAG, COMPARED if len(left) == 1 else AND)


def _known(kind: Kind) -> tuple[int, ...] | None:
    """A tuple of whole numbers, all of them known."""
    match kind:
        case Constant(value=tuple(items)):
            parts = [item.kind if isinstance(item, Value) else kind_of(item, given=False) for item in items]
        case Record(fields=fields):
            parts = [part for _, part in fields]
        case _:
            return None
    numbers = [part.known for part in parts if isinstance(part, Int) and part.known is not None]
    return tuple(numbers) if len(numbers) == len(parts) else None


def _settled(a: Value, sign: str, b: Value) -> bool | None:
    """What the ranges of two whole numbers say."""
    if not (isinstance(a.kind, Int) and isinstance(b.kind, Int)):
        return None
    gap = difference(a.kind, b.kind)
    low, high = gap.low, gap.high
    above, below = low is not None and low > 0, high is not None and high < 0
    at_least, at_most = low is not None and low >= 0, high is not None and high <= 0
    yes, no = {
        "<": (below, at_least),
        "<=": (at_most, above),
        ">": (above, at_most),
        ">=": (at_least, below),
        "==": (gap.known == 0, above or below),
        "!=": (above or below, gap.known == 0),
    }[sign]
    return True if yes else False if no else None


def condition(body: Body, node: ast.expr) -> Value:
    """A truth value, of which nothing else is used.

    Raises:
        Untranslatable: it is not understood, or has none.
    """
    if isinstance(node, ast.BoolOp):
        return _joined(body, node, _operands(body, node, condition))
    return truth(body, node, expression(body, node))


def _logic(body: Body, node: ast.BoolOp) -> Value:
    """`a or b` and `a and b` where their value is used: of numbers the first that decides, or the last."""
    values = _operands(body, node, expression)
    if all(isinstance(value.kind, Flag) for value in values):
        return _joined(body, node, values)
    is_and = isinstance(node.op, ast.And)
    *before, result = values
    for value in reversed(before):
        if not isinstance(value.kind, Int | Real) or not isinstance(result.kind, Int | Real):
            raise body.source.refusal(node, "and, or of numbers and other things; use if and else")
        if "(" in value.text.removeprefix("(int)"):
            raise body.source.refusal(node, "what is both asked and used must have a name; give it one first")
        asked = truth(body, node, value)
        result = chosen(body, node, asked, *((result, value) if is_and else (value, result)))
    return result


def _operands(body: Body, node: ast.BoolOp, of: Callable[[Body, ast.expr], Value]) -> list[Value]:
    """Those that may decide: none that is known not to, and none behind one that is known to."""
    found: list[Value] = []
    for part in node.values:
        waiting = len(body.before)
        value = of(body, part)
        if len(body.before) > waiting:
            raise body.source.refusal(part, "an array is made here on some occasions only; give it a name first")
        known = value.kind.known if isinstance(value.kind, Flag | Int) else None
        if known is None or part is node.values[-1]:
            found.append(value)
        elif bool(known) != isinstance(node.op, ast.And):
            return [*found, value]
    return found


def _joined(body: Body, node: ast.BoolOp, flags: list[Value]) -> Value:
    is_and = isinstance(node.op, ast.And)
    left = [flag for flag in flags if flag.kind != Flag(is_and)]
    if not left:
        return constant(body, is_and)
    if len(left) == 1:
        return left[0]
    level = AND if is_and else OR
    inside = AND if is_and else COMPARED + 1
    return Value((" && " if is_and else " || ").join(flag.within(inside) for flag in left), FLAG, level)


def _choice(body: Body, node: ast.IfExp) -> Value:
    test = condition(body, node.test)
    assert isinstance(test.kind, Flag)
    if test.kind.known is not None:
        return expression(body, node.body if test.kind.known else node.orelse)
    waiting = len(body.before)
    a, b = expression(body, node.body), expression(body, node.orelse)
    if len(body.before) > waiting:
        raise body.source.refusal(node, "an array is made here on some occasions only; use if and else")
    return chosen(body, node, test, a, b)
