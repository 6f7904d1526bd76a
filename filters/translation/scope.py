"""Where each variable of a function is declared: in the innermost block that mentions it, or at the top."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from typing import TypeAlias

Block: TypeAlias = Sequence[ast.stmt]
Place: TypeAlias = tuple[int, int]
"""The identity of a block, and the number of the statement before which, or in which, the variable is declared."""

TOP: Place = (0, 0)
"""Of a variable that is declared at the top, without a value."""


def places(body: Block) -> dict[str, Place]:
    """By name. A variable that a block may read before it has written it is declared at the top."""
    return {name: _place(name, body) or TOP for name in assigned(body)}


def assigned(block: Block) -> Counter[str]:
    """How often each name is written in it, other than the variables of `for`."""
    nodes = [*_nodes(block)]
    loops = {id(node.target) for node in nodes if isinstance(node, ast.For)}
    return Counter(
        node.id
        for node in nodes
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and id(node) not in loops
    )


def mentions(node: ast.AST, name: str) -> bool:
    """Whether the name stands anywhere in it."""
    return name in _mentioned(node)


@cache  # asked for each name of a function, which may be long
def _mentioned(node: ast.AST) -> frozenset[str]:
    return frozenset(part.id for part in ast.walk(node) if isinstance(part, ast.Name))


def escaping(body: Block) -> set[str]:
    """The names whose values a function returns, or other names for these."""
    found: set[str] = set()
    for node in _nodes(body):
        if isinstance(node, ast.Return) and node.value is not None:
            found |= {part.id for part in ast.walk(node.value) if isinstance(part, ast.Name)}
    while True:
        more = {
            node.value.id
            for node in _nodes(body)
            if isinstance(node, ast.Assign)
            and isinstance(node.value, ast.Name)
            and any(isinstance(target, ast.Name) and target.id in found for target in node.targets)
        }
        if more <= found:
            return found
        found |= more


def _nodes(block: Block) -> Iterator[ast.AST]:
    for statement in block:
        yield from ast.walk(statement)


def _place(name: str, block: Block) -> Place | None:
    """None if the block may read it first."""
    inside = [index for index, statement in enumerate(block) if mentions(statement, name)]
    statement = block[inside[0]]
    if _writes_first(name, statement):
        return id(block), inside[0]
    if len(inside) == 1:
        blocks = [each for each in _blocks(statement) if any(mentions(part, name) for part in each)]
        if len(blocks) == 1 and not any(mentions(part, name) for part in _head(statement)):
            return _place(name, blocks[0])
    return None


def _writes_first(name: str, statement: ast.stmt) -> bool:
    match statement:
        case ast.Assign(targets=targets, value=value):
            names = {part.id for target in targets for part in _names(target)}
            return name in names and not mentions(value, name)
        case ast.AnnAssign(target=ast.Name(id=target), value=ast.expr() as value):
            return target == name and not mentions(value, name)
        case ast.If(test=test, body=body, orelse=orelse):
            return not mentions(test, name) and all(
                (place := _place(name, part)) is not None and place[0] == id(part)
                if any(mentions(each, name) for each in part)
                else False
                for part in (body, orelse)
            )
    return False


def _names(target: ast.expr) -> list[ast.Name]:
    """Those that an assignment to it writes."""
    parts = target.elts if isinstance(target, ast.Tuple) else [target]
    return [part for part in parts if isinstance(part, ast.Name)]


def _blocks(statement: ast.stmt) -> list[Block]:
    return [getattr(statement, part) for part in ("body", "orelse") if getattr(statement, part, None)]


def _head(statement: ast.stmt) -> list[ast.expr]:
    """What of a compound statement is no block."""
    return [value for value in vars(statement).values() if isinstance(value, ast.expr)]
