"""Statements, as lines of C."""

from __future__ import annotations

import ast

from filters.translation.arrays import copied, filled, item
from filters.translation.body import Body, Elsewhere, Widened
from filters.translation.declarations import variable
from filters.translation.expressions import binary, condition, expression
from filters.translation.kinds import (
    NOTHING,
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
    lasts,
    variable_of,
)
from filters.translation.library import INDENT
from filters.translation.made import as_real, constant, field, number_of
from filters.translation.names import c_name
from filters.translation.scope import TOP, Block, assigned, mentions
from filters.translation.values import POSTFIX, SUM, UNARY, Value
from filters.translation.words import construct

_SIGNS: dict[type[ast.operator], str] = {ast.Add: "+=", ast.Sub: "-=", ast.Mult: "*=", ast.Div: "/="}

GIVEN_UP = "return @;"
"""Of a function that cannot go on; what it returns is known when all of it is translated."""


def block(body: Body, statements: Block) -> tuple[list[str], bool]:
    """Its lines, and whether it ends the block that it is in: nothing behind it is reached."""
    lines: list[str] = []
    for index, statement in enumerate(statements):
        here = {name for name, place in body.places.items() if place == (id(statements), index)}
        undeclared = set(here)
        text, ends = _statement(body, statement, undeclared)
        for name in sorted(undeclared):
            value = body.names.get(name)
            if value is not None and lasts(value.kind) and value.text == c_name(name):
                lines.append(f"{variable(value.kind, value.text, body.unit.record_name)};")
        comment = body.source.comments.get(statement.lineno)
        if comment and text:
            text[0] += f" /* {comment} */"
        lines += text
        if ends:
            return lines, True
    return lines, False


def _statement(body: Body, statement: ast.stmt, undeclared: set[str]) -> tuple[list[str], bool]:
    waiting, body.before = body.before, []
    lines, ends = _translated(body, statement, undeclared)
    if body.before and isinstance(statement, ast.While):
        raise body.source.refusal(statement.test, "an array is made in each round; make it in the loop")
    lines, body.before = [*body.before, *lines], waiting
    return lines, ends


def _translated(body: Body, statement: ast.stmt, undeclared: set[str]) -> tuple[list[str], bool]:
    match statement:
        case ast.Expr(value=ast.Constant()) | ast.Pass() | ast.AnnAssign(value=None):
            return [], False
        case ast.Expr(value=value):
            text = expression(body, value).text
            return [f"{text};"] if text else [], False
        case ast.Assign(targets=targets, value=value):
            return _assignment(body, statement, targets, value, undeclared), False
        case ast.AnnAssign(target=target, value=ast.expr() as value):
            return _assignment(body, statement, [target], value, undeclared), False
        case ast.AugAssign():
            return _augmented(body, statement), False
        case ast.For():
            return _loop(body, statement), False
        case ast.While(test=test, body=inside, orelse=[]):
            with_test = condition(body, test).text
            return _braced(f"while ({with_test})", _in_loop(body, inside)), False
        case ast.If():
            return _branch(body, statement)
        case ast.Return():
            return _return(body, statement), True
        case ast.Raise():
            return [f'FAULT("{_message(body, statement)}");', GIVEN_UP], True
        case ast.Break():
            return ["break;"], True
        case ast.Continue():
            return ["continue;"], True
    raise body.source.refusal(statement, construct(statement))


def _braced(head: str, lines: list[str]) -> list[str]:
    return [f"{head} {{", *(INDENT + line for line in lines), "}"]


def _in_loop(body: Body, inside: Block) -> list[str]:
    body.loops.append(set(body.names))
    lines, _ = block(body, inside)
    body.loops.pop()
    return lines


def _branch(body: Body, statement: ast.If) -> tuple[list[str], bool]:
    test = condition(body, statement.test)
    if isinstance(test.kind, Flag) and test.kind.known is not None:
        return block(body, statement.body if test.kind.known else statement.orelse)
    then, then_ends = block(body, statement.body)
    lines = _braced(f"if ({test.text})", then)
    if not statement.orelse:
        return lines, False
    other, other_ends = block(body, statement.orelse)
    if len(statement.orelse) == 1 and isinstance(statement.orelse[0], ast.If) and other and other[0].startswith("if "):
        return [*lines[:-1], f"}} else {other[0]}", *other[1:]], then_ends and other_ends
    return [*lines[:-1], *_braced("} else", other)], then_ends and other_ends


def _loop(body: Body, statement: ast.For) -> list[str]:
    if statement.orelse or not isinstance(statement.target, ast.Name):
        raise body.source.refusal(statement.iter, "a loop over one name and without else is translated")
    name = statement.target.id
    if name in body.assigned:
        raise body.source.refusal(statement.iter, f"{name} is also assigned elsewhere; give it another name there")
    _check_unused_behind(body, name)
    text, kept = c_name(name), body.names.get(name)
    match statement.iter:
        case ast.Call(func=ast.Name(id="range"), args=bounds) if "range" not in body.names:
            lines = _counting(body, statement, name, text, bounds)
        case over:
            lines = _over_items(body, statement, name, text, expression(body, over))
    if kept is None:
        body.names.pop(name, None)
    else:
        body.names[name] = kept
    return lines


def _check_unused_behind(body: Body, name: str) -> None:
    """The variable of a loop must be read in loops over it alone, for in C it ends with the loop."""

    def outside(node: ast.AST) -> bool:
        if isinstance(node, ast.For) and isinstance(node.target, ast.Name) and node.target.id == name:
            return any(outside(part) for part in (node.iter, *node.orelse))
        if isinstance(node, ast.Name):
            return node.id == name
        return any(outside(child) for child in ast.iter_child_nodes(node))

    for statement in body.source.body:
        if name not in body.source.parameters and outside(statement):
            raise body.source.refusal(statement, f"{name} is used behind its loop; give what is needed another name")


def _counting(body: Body, statement: ast.For, name: str, text: str, bounds: list[ast.expr]) -> list[str]:
    values = [expression(body, bound) for bound in bounds]
    start = values[0] if len(values) > 1 else Value("0", exactly(0))
    stop = values[1] if len(values) > 1 else values[0]
    step = values[2] if len(values) > 2 else Value("1", exactly(1))
    first, last = start.kind, stop.kind
    if not (isinstance(first, Int) and isinstance(last, Int) and isinstance(step.kind, Int)):
        raise body.source.refusal(statement.iter, "the bounds of a range must be whole numbers")
    stride = step.kind.known
    if stride == 0 or (stride is None and not step.kind.counts):
        raise body.source.refusal(statement.iter, "whether the step of a range is positive is not known, or it is 0")
    if _never_runs(first, last, stride):
        return []
    lines = []
    changing = stop.text in {c_name(changed) for changed in assigned(statement.body)}
    if last.known is None and (changing or not stop.text.isidentifier()):  # it is read once
        limit = body.fresh(f"{text}_end")
        lines.append(f"const int {limit} = {stop.text};")
        stop = Value(limit, last)
    if stride is None or stride > 0:
        body.names[name] = Value(text, Int(first.low, None if last.high is None else last.high - 1))
        test = f"{text} < {stop.within(SUM)}"
    else:
        body.names[name] = Value(text, Int(None if last.low is None else last.low + 1, first.high))
        test = f"{text} >= 0" if last.known == -1 else f"{text} > {stop.within(SUM)}"
    if stride in (1, -1):
        move = f"{text}++" if stride == 1 else f"{text}--"
    else:
        move = f"{text} += {step.text}" if stride is None or stride > 0 else f"{text} -= {-stride}"
    return [*lines, *_braced(f"for (int {text} = {start.text}; {test}; {move})", _in_loop(body, statement.body))]


def _never_runs(first: Int, last: Int, stride: int | None) -> bool:
    """Whether no number of the range is reached, wherever within its bounds it begins and ends."""
    if stride is not None and stride < 0:
        first, last = last, first
    return first.low is not None and last.high is not None and first.low >= last.high


def _over_items(body: Body, statement: ast.For, name: str, text: str, over: Value) -> list[str]:
    if not isinstance(over.kind, Array):
        raise body.source.refusal(statement.iter, "a loop over a range or an array is translated")
    index = body.fresh(f"{text}_index")
    rows = over.rows or str(over.kind.shape[0])
    if rows == "0":
        return []
    rest = over.kind.shape[1:]
    item: Kind = Array(over.kind.item, rest, over.kind.inner[1:]) if rest else number_of(over.kind.item)
    body.names[name] = Value(text, item, origins=over.origins)
    declared = f"{variable(item, text, body.unit.record_name)} = {over.within(POSTFIX)}[{index}];"
    inside = _in_loop(body, statement.body)
    return _braced(f"for (int {index} = 0; {index} < {rows}; {index}++)", [declared, *inside])


def _return(body: Body, statement: ast.Return) -> list[str]:
    if statement.value is None or (isinstance(statement.value, ast.Constant) and statement.value.value is None):
        return ["return;"]
    value = expression(body, statement.value, returned=True)
    kind = value.kind
    if isinstance(kind, Function | Constant):
        raise body.source.refusal(statement, "a function or a constant of Python is returned")
    if body.result == NOTHING:
        body.result = kind
    elif body.result != kind:
        body.result = _common(body, statement, body.result, kind)
    if isinstance(kind, Array | Record):
        if any(path and path[0] in body.own for _, path in value.origins):
            raise body.source.refusal(statement, "returns part of an array of its own; return a copy of the part")
        body.result_origins |= value.origins
    text = f"*{value.within(UNARY)}" if value.by_pointer else value.text
    return [f"return {text};" if text else "return;"]


def _common(body: Body, statement: ast.stmt, a: Kind, b: Kind) -> Kind:
    """The kind of what may be either."""
    if isinstance(a, Int) and isinstance(b, Int):
        return Int(0) if a.counts and b.counts else Int()
    if isinstance(a, Int | Real) and isinstance(b, Int | Real):
        return REAL
    if isinstance(a, Flag) and isinstance(b, Flag):
        return Flag()
    raise body.source.refusal(statement, "returns another kind of value, or of another shape, than elsewhere")


def _message(body: Body, statement: ast.Raise) -> str:
    """What is said, if it is known; else the line itself."""
    text = ast.unparse(statement)
    match statement.exc:
        case ast.Call(args=[ast.Constant() | ast.Name() | ast.Attribute() as said, *_]):
            kind = expression(body, said).kind
            text = kind.value if isinstance(kind, Constant) and isinstance(kind.value, str) else text
    return text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")


def _augmented(body: Body, statement: ast.AugAssign) -> list[str]:
    target, value = expression(body, statement.target), expression(body, statement.value)
    sign = _SIGNS.get(type(statement.op))
    result = binary(body, statement, statement.op, target, value)
    if isinstance(statement.target, ast.Subscript) or isinstance(target.kind, Array):
        body.writes |= target.origins
    if isinstance(target.kind, Array):
        shape = [target.rows if length is None else length for length in target.kind.shape]
        return filled(target, shape, lambda index: item(result, index).text)
    if isinstance(statement.target, ast.Name):
        _check_fits(body, statement, statement.target.id, target, variable_of(result.kind))
    if sign is None:
        return [f"{_place(target)} = {result.text};"]
    return [f"{_place(target)} {sign} {(as_real(value) if isinstance(target.kind, Real) else value).text};"]


def _place(element: Value) -> str:
    """A number where it is written to, not as it is read."""
    return element.text.removeprefix("(int)")


def _check_fits(body: Body, statement: ast.stmt, name: str, known: Value, kind: Kind) -> None:
    """Raises Widened if the variable cannot hold it, or a refusal if it is a parameter, which the caller knows."""
    is_parameter = name in body.source.parameters
    if is_parameter and not lasts(known.kind):
        raise body.source.refusal(statement, f"{name} is a parameter; give the new value another name")
    if known.kind == kind or (isinstance(known.kind, Real) and isinstance(kind, Int)):
        return
    if isinstance(known.kind, Int) and isinstance(kind, Int):
        if kind.counts or not known.kind.counts:
            return
        raise Widened(name, Int())
    if isinstance(known.kind, Int | Flag) and isinstance(kind, Int | Real):
        if is_parameter:
            raise body.source.refusal(statement, f"{name} is a parameter; give the new value another name")
        raise Widened(name, kind)


def _assignment(
    body: Body, statement: ast.stmt, targets: list[ast.expr], value: ast.expr, undeclared: set[str]
) -> list[str]:
    match targets:
        case [ast.Tuple(elts=parts)]:
            return _unpacked(body, statement, parts, value, undeclared)
        case [ast.Name(id=name)]:
            body.target = name
            right = expression(body, value, returned=name in body.escaping)
            body.target = ""
            return _to_name(body, statement, name, right, undeclared)
        case [ast.Subscript() as element]:
            return _to_element(body, statement, element, expression(body, value))
    right = expression(body, value, returned=any(isinstance(t, ast.Name) and t.id in body.escaping for t in targets))
    lines: list[str] = []
    for target in targets:  # a = b[i] = value: what is a name comes first, and is read from there
        if isinstance(target, ast.Name):
            lines += _to_name(body, statement, target.id, right, undeclared)
            right = body.names[target.id]
    if not lines and right.level > POSTFIX:
        raise body.source.refusal(statement, "give the value a name first")
    for target in targets:
        if isinstance(target, ast.Subscript):
            lines += _to_element(body, statement, target, right)
    return lines


def _to_name(body: Body, statement: ast.stmt, name: str, value: Value, undeclared: set[str]) -> list[str]:
    text, known = c_name(name), body.names.get(name)
    once = body.assigned[name] == 1 and name not in body.source.parameters
    if not lasts(value.kind) and (once or not isinstance(value.kind, Int | Flag)):
        if known is not None and known.kind != value.kind and not once:
            raise body.source.refusal(statement, f"{name} is one thing here and another elsewhere")
        body.names[name] = value
        return []
    if value.rows:
        if not once:
            raise body.source.refusal(statement, f"{name} is an array of many rows, and is assigned more than once")
        body.names[name] = value
        return []
    kind = body.wide.get(name, variable_of(value.kind))
    if isinstance(kind, Array) and value.passing and not _is_within_loop(body, name):
        raise body.source.refusal(statement, f"{name} is kept from one round of the loop to the next; copy the numbers")
    if isinstance(known.kind if known else kind, Real):
        value = as_real(value)
    right = f"*{value.within(UNARY)}" if value.by_pointer else value.text
    if known is None:
        origins = value.origins | body.also.get(name, frozenset())
        body.names[name] = Value(text, kind, passing=value.passing, origins=origins)
        if name in undeclared:
            undeclared.discard(name)
            const = "const " if once and not isinstance(kind, Array) else ""
            return [f"{const}{variable(kind, text, body.unit.record_name)} = {right};"]
        return [f"{text} = {right};"]
    _check_fits(body, statement, name, known, variable_of(value.kind))
    if known.by_pointer:
        raise body.source.refusal(statement, f"{name} is a parameter; give the new value another name")
    numbers = isinstance(known.kind, Int | Real | Flag) and isinstance(value.kind, Int | Real | Flag)
    if variable_of(value.kind) != known.kind and not numbers:
        raise body.source.refusal(statement, f"{name} gets another kind of value, or another shape, than before")
    if isinstance(kind, Array | Record) and not value.origins <= known.origins:
        raise Elsewhere(name, value.origins | known.origins)
    return [f"{text} = {right};"]


def _is_within_loop(body: Body, name: str) -> bool:
    """Whether the variable begins anew in each round of the innermost loop."""
    return not body.loops or (name not in body.loops[-1] and body.places.get(name, TOP) != TOP)


def _to_element(body: Body, statement: ast.stmt, target: ast.Subscript, value: Value) -> list[str]:
    left = expression(body, target)
    body.writes |= left.origins
    if not isinstance(left.kind, Array):
        if not isinstance(value.kind, Int | Real | Flag):
            raise body.source.refusal(statement, "one number is given something that is none")
        return [f"{_place(left)} = {(as_real(value) if isinstance(left.kind, Real) else value).text};"]
    if isinstance(value.kind, Array):
        if value.kind.shape != left.kind.shape:
            raise body.source.refusal(statement, f"{value.kind.shape} numbers are put in place of {left.kind.shape}")
        if value.text not in body.own and value.text not in body.memory:
            value = copied(body, statement, value)  # it may be part of what is written
    elif not isinstance(value.kind, Int | Real | Flag):
        raise body.source.refusal(statement, "an array is given something that is no number")
    elif left.kind.item == "real":
        value = as_real(value)
    shape = [left.rows if length is None else length for length in left.kind.shape]
    return filled(left, shape, lambda index: item(value, index).text)


def _unpacked(
    body: Body, statement: ast.stmt, targets: list[ast.expr], value: ast.expr, undeclared: set[str]
) -> list[str]:
    if isinstance(value, ast.Tuple) and len(value.elts) == len(targets):
        return _in_parallel(body, statement, targets, value.elts, undeclared)
    return _parts_to(body, statement, targets, expression(body, value), undeclared)


def _parts_to(
    body: Body, statement: ast.stmt, targets: list[ast.expr], value: Value, undeclared: set[str]
) -> list[str]:
    """The items of a tuple to names or elements."""
    match value.kind:
        case Constant(value=tuple(known)):
            items = [part if isinstance(part, Value) else constant(body, part) for part in known]
            return _each(body, statement, targets, items, undeclared)
        case Record(fields=fields):
            lines = []
            if value.level > POSTFIX or "(" in value.text:
                name = body.fresh("parts")
                lines.append(f"const {variable(value.kind, name, body.unit.record_name)} = {value.text};")
                value = Value(name, value.kind, passing=value.passing, origins=value.origins)
            items = [field(body, statement, value, name) for name, _ in fields]
            return lines + _each(body, statement, targets, items, undeclared)
    raise body.source.refusal(statement, "what is unpacked must be a tuple whose length is known")


def _in_parallel(
    body: Body, statement: ast.stmt, targets: list[ast.expr], values: list[ast.expr], undeclared: set[str]
) -> list[str]:
    """a, b = b, a: what a later value reads is kept before it is overwritten."""
    lines: list[str] = []
    rights = [
        expression(body, value, returned=isinstance(target, ast.Name) and target.id in body.escaping)
        for target, value in zip(targets, values, strict=True)
    ]
    for index, right in enumerate(rights):
        written = targets[:index]
        if lasts(right.kind) and any(_may_change(target, values[index]) for target in written):
            name = body.fresh(f"value_{index}")
            text = f"*{right.within(UNARY)}" if right.by_pointer else right.text
            kind = variable_of(right.kind)
            const = "" if isinstance(kind, Array) else "const "
            lines.append(f"{const}{variable(kind, name, body.unit.record_name)} = {text};")
            rights[index] = Value(name, right.kind, passing=right.passing, origins=right.origins)
    return lines + _each(body, statement, targets, rights, undeclared)


def _may_change(target: ast.expr, value: ast.expr) -> bool:
    if isinstance(target, ast.Name):
        return mentions(value, target.id)
    return any(isinstance(part, ast.Subscript | ast.Call) for part in ast.walk(value))


def _each(
    body: Body, statement: ast.stmt, targets: list[ast.expr], values: list[Value], undeclared: set[str]
) -> list[str]:
    if len(targets) != len(values):
        raise body.source.refusal(statement, f"{len(values)} values are unpacked into {len(targets)} names")
    lines = []
    for target, value in zip(targets, values, strict=True):
        match target:
            case ast.Name(id=name):
                lines += _to_name(body, statement, name, value, undeclared)
            case ast.Subscript():
                lines += _to_element(body, statement, target, value)
            case ast.Tuple(elts=parts):
                lines += _parts_to(body, statement, parts, value, undeclared)
            case _:
                raise body.source.refusal(statement, "unpack into names or elements")
    return lines
