"""A function as it was written."""

from __future__ import annotations

import ast
import builtins
import inspect
import io
import textwrap
import tokenize
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any

from filters.translation.refusal import Untranslatable


@dataclass(frozen=True, eq=False)
class Source:
    """body: without the docstring. comments: what is said behind a line, by its number in the tree."""

    function: FunctionType
    parameters: tuple[str, ...]
    body: tuple[ast.stmt, ...]
    doc: str
    comments: dict[int, str]
    file: str
    first_line: int

    def refusal(self, node: ast.AST, why: str) -> Untranslatable:
        line = self.first_line + getattr(node, "lineno", 1) - 1
        return Untranslatable(f"{self.file}:{line}: {ast.unparse(node).splitlines()[0]:.100}: {why}")

    def value(self, name: str) -> Any:
        """What the name stands for outside the function; raises KeyError."""
        for free, cell in zip(self.function.__code__.co_freevars, self.function.__closure__ or (), strict=True):
            if free == name:
                return cell.cell_contents
        if name in self.function.__globals__:
            return self.function.__globals__[name]
        return vars(builtins)[name]


@cache
def source_of(function: FunctionType) -> Source:
    """Raises Untranslatable unless it is a def with positional parameters, whose source can be read."""
    try:
        lines, first = inspect.getsourcelines(function)
        text = textwrap.dedent("".join(lines))
        tree = ast.parse(text).body[0]
    except (OSError, TypeError, SyntaxError) as error:
        raise Untranslatable(f"{function.__module__}.{function.__qualname__}: its source cannot be read") from error
    file = _shown(function.__code__.co_filename)
    if not isinstance(tree, ast.FunctionDef) or tree.name != function.__code__.co_name:  # of a lambda: what holds it
        raise Untranslatable(f"{file}:{first}: {function.__qualname__}: write it as a def")
    given = tree.args
    if given.vararg or given.kwarg or given.kwonlyargs or given.defaults:
        raise Untranslatable(f"{file}:{first}: {function.__qualname__}: has other than positional parameters")
    has_doc = ast.get_docstring(tree) is not None
    return Source(
        function,
        tuple(each.arg for each in (*given.posonlyargs, *given.args)),
        tuple(tree.body[has_doc:]),
        inspect.getdoc(function) or "" if has_doc else "",
        _comments(text),
        file,
        first,
    )


def _comments(text: str) -> dict[int, str]:
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    return {
        token.start[0]: token.string.lstrip("# ").replace("*/", "* /")
        for token in tokens
        if token.type == tokenize.COMMENT and not token.string.startswith(("# type:", "# noqa"))
    }


def _shown(file: str) -> str:
    """From the folder of the project on, so that what is generated is the same wherever it lies."""
    root = Path(__file__).resolve().parents[2]
    path = Path(file)
    return str(path.relative_to(root)) if path.is_relative_to(root) else path.name
