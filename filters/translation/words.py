"""What is not translated, in the words of those who write it, and what to write instead."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable
from types import MethodType
from typing import Any

import numpy as np

_CONSTRUCTS: dict[type[ast.AST], str] = {
    ast.JoinedStr: "an f-string is not translated",
    ast.ListComp: "a list comprehension is not translated; write a loop",
    ast.GeneratorExp: "a generator is not translated; write a loop",
    ast.SetComp: "a set is not translated; write a loop",
    ast.DictComp: "a dictionary is not translated; give values as fields of a named tuple",
    ast.Dict: "a dictionary is not translated; give values as fields of a named tuple",
    ast.Set: "a set is not translated",
    ast.List: "a list is not translated; write np.array",
    ast.NamedExpr: "an assignment within an expression, :=, is not translated; assign in a line of its own",
    ast.Lambda: "a lambda is not translated; write a def outside",
    ast.FunctionDef: "a function within a function is not translated; write it outside",
    ast.ClassDef: "a class is not translated",
    ast.Try: "try is not translated; ask with if",
    ast.With: "with is not translated",
    ast.Assert: "assert is not translated; write if and raise",
    ast.Delete: "del is not translated; leave it out",
    ast.Global: "global is not translated; give it as an argument",
    ast.Nonlocal: "nonlocal is not translated; give it as an argument",
    ast.Import: "an import within a function is not translated; write it at the top of the file",
    ast.ImportFrom: "an import within a function is not translated; write it at the top of the file",
    ast.Match: "match is not translated; write if and else",
    ast.While: "a while with an else is not translated",
    ast.Starred: "a star before an argument is not translated",
    ast.Yield: "yield is not translated; write into an array",
}

_CALLS: dict[Callable[..., Any], str] = {
    np.clip: "np.clip is not translated; write min(max(x, least), most), of arrays in a loop",
    np.where: "np.where is not translated; write a if condition else b, of arrays in a loop",
    np.maximum: "np.maximum is not translated; write max(a, b), of arrays in a loop",
    np.minimum: "np.minimum is not translated; write min(a, b), of arrays in a loop",
    np.sign: "np.sign is not translated; write if and else",
    np.round: "np.round is not translated; write np.rint(x)",
    round: "round is not translated; write np.rint(x), or int(np.rint(x)) for a whole number",
    max: "max is translated of two numbers; write max(a, max(b, c)), of arrays a loop",
    min: "min is translated of two numbers; write min(a, min(b, c)), of arrays a loop",
    pow: "pow is not translated; write a ** b",
    print: "print is not translated; leave it out",
    sum: "sum is not translated; write a loop",
    np.sum: "np.sum is not translated; write a loop",
    math.fsum: "math.fsum is not translated; write a loop",
}


def construct(node: ast.AST) -> str:
    """Why such a part of a function is refused."""
    return _CONSTRUCTS.get(type(node), "this is not translated")


def of_call(target: Any, otherwise: str = "this call is not translated") -> str:
    """Why a call of this function is refused."""
    if isinstance(target, MethodType):
        return f"{target.__qualname__} is a method; write a def outside the class"
    return _CALLS.get(target, otherwise) if callable(target) else otherwise
