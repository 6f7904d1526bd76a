"""What is not understood is refused, with file, line and what to write instead; nothing is guessed."""

from __future__ import annotations

import inspect
import re
from typing import Any

import numpy as np
import pytest

from filters.translation.kinds import kind_of
from filters.translation.refusal import Untranslatable
from filters.translation.unit import Unit
from tests.filters.translation.programs import Program
from tests.filters.translation.refused import REFUSED, helper, known_parameter_changed


def translate(function: Any, arguments: tuple[Any, ...]) -> None:
    Unit().function(function, tuple(kind_of(argument) for argument in arguments))


@pytest.mark.parametrize(("function", "arguments"), REFUSED, ids=lambda value: getattr(value, "__name__", ""))
def test_the_line_and_the_reason(function: Any, arguments: tuple[Any, ...]) -> None:
    lines, first = inspect.getsourcelines(function)
    (line, why) = next(
        (first + number, text.rpartition("# ")[2].strip()) for number, text in enumerate(lines) if "# " in text
    )
    with pytest.raises(Untranslatable, match=rf"tests/filters/translation/refused.py:{line}: .*{re.escape(why)}"):
        translate(function, arguments)


def test_a_function_that_is_given_other_arguments() -> None:
    with pytest.raises(
        Untranslatable, match=r"refused\.py:\d+: helper: is called with 1 arguments, and has 2 parameters"
    ):
        translate(helper, (1.0,))


def test_a_known_argument_that_is_changed() -> None:
    with pytest.raises(Untranslatable, match=r"refused\.py:\d+: n = n - 1: n is a parameter; give the new"):
        translate(known_parameter_changed, (1.0,))


def test_a_lambda_is_not_taken_for_what_holds_it() -> None:
    def holds(x: float) -> Any: return lambda y: x * y  # fmt: skip

    with pytest.raises(Untranslatable, match=r"test_refused\.py:\d+: .*<lambda>: write it as a def"):
        translate(holds(1.0), (1.0,))


@pytest.mark.parametrize(
    ("argument", "what"),
    [
        ("text", "'text' is a str, for which there is nothing in C"),
        (np.zeros((2, 2), complex), "an array of complex128"),
        (np.zeros((4, 4))[:, ::2], "whose rows lie side by side"),
        (None, "None is a NoneType"),
        (Program(1).text, r"Program.text is a method; write a def outside the class"),
    ],
)
def test_arguments(argument: Any, what: str) -> None:
    with pytest.raises(Untranslatable, match=what):
        kind_of(argument)
