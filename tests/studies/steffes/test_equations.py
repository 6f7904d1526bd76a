"""Every equation of the paper from (5) on has its line, which says so where it has a comment."""

from __future__ import annotations

import inspect
import re

import pytest

from filters.delayed.high_rate import hr_update
from studies.steffes.equations import EQUATIONS, ROOT, Equation

RUN = [one for one in EQUATIONS if one.function is not None]


def test_all_equations_from_5_on_are_there_in_order() -> None:
    assert [one.number for one in EQUATIONS] == list(range(5, 25))


@pytest.mark.parametrize("equation", RUN, ids=lambda one: str(one.number))
def test_its_line_stands_in_the_function(equation: Equation) -> None:
    assert equation.function is not None
    (text,) = [line for line in inspect.getsource(equation.function).splitlines() if equation.line in line][:1]
    marks = re.findall(r"# .*?\((\d+)\)", text)
    assert marks in ([], [str(equation.number)])
    assert (ROOT / equation.file).read_text(encoding="utf-8").count(text)


@pytest.mark.parametrize("equation", RUN, ids=lambda one: str(one.number))
def test_the_function_names_its_equation(equation: Equation) -> None:
    """By number, alone or in a range such as Eqs. (9) to (12)."""
    said = inspect.getsource(equation.function)
    ranges = [range(int(a), int(b) + 1) for a, b in re.findall(r"\((\d+)\) to \((\d+)\)", said)]
    named = " ".join(re.findall(r"Eqs?\. [\d, ()]+|\(\d+\)", said))
    numbers = {int(number) for number in re.findall(r"\d+", named)}
    assert equation.number in numbers or any(equation.number in of for of in ranges)


def test_equations_that_no_line_runs_say_why() -> None:
    assert [one.number for one in EQUATIONS if one.function is None] == [7, 22]
    assert all(one.note for one in EQUATIONS if one.function is None)


def test_a_line_that_is_no_more_is_not_quoted() -> None:
    with pytest.raises(LookupError, match=r"Eq. \(99\): no line of hr_update"):
        _ = Equation(99, "", hr_update, "form.nothing(").line
