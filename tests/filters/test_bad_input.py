"""Errors name the argument, its value and what is needed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.backends.choose import function_for
from filters.delayed import dual_rate, larsen
from filters.problem import check_problem
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from tests.strategies import problem

MATRICES: dict[str, Any] = {
    "Phi": np.eye(3), "B": np.ones((3, 2)), "H": np.ones((1, 3)), "Q": np.eye(3), "R": np.eye(1),
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("Phi", np.ones((3, 2)), r"Phi has shape \(3, 2\), needed is \(3, 3\)"),
        ("B", np.ones((2, 2)), r"B has shape \(2, 2\), needed is \(3, 2\)"),
        ("H", np.ones((5, 1, 4)), r"H has shape \(1, 4\), needed is \(1, 3\)"),
        ("Q", np.eye(2), r"Q has shape \(2, 2\), needed is \(3, 3\)"),
        ("R", np.eye(2), r"R has shape \(2, 2\), needed is \(1, 1\)"),
        ("R", np.ones(1), r"R has shape \(1,\); needed is a matrix \(2-D\), or one per step \(3-D\)"),
        ("Q", np.full((3, 3), np.nan), "Q holds a value that is not finite"),
        ("Q", np.diag([1.0, 1.0, -1.0]), "Q is no covariance: its smallest eigenvalue is -1"),
        ("R", [[-1.0]], "R is no covariance: its smallest eigenvalue is -1"),
        ("Q", [np.eye(3), np.tri(3)], "linear_system: Q of step 1 is not symmetric"),
        (
            "R",
            [[[1.0]], [[1.0]], [[-1.0]]],
            "linear_system: R of step 2 is no covariance: its smallest eigenvalue is -1",
        ),
        ("Q", {}, "Q is no array of numbers"),
        ("B", "none", "B is no array of numbers"),
    ],
)
def test_matrices_of_a_linear_system(name: str, value: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        linear_system(**{**MATRICES, name: value})


def test_matrices_may_vary_with_different_periods() -> None:
    system = linear_system(**{**MATRICES, "Phi": np.array([1, 2, 3])[:, None, None] * np.eye(3)})
    assert [system.F(j, np.zeros(3), np.zeros(2), system.parameters)[0, 0] for j in range(5)] == [1, 2, 3, 1, 2]
    assert system.Q(4, system.parameters).shape == (3, 3)


def test_a_linear_system_does_not_share_its_matrices() -> None:
    Phi = np.eye(3)
    system = linear_system(**{**MATRICES, "Phi": Phi})
    Phi[0, 0] = 5.0
    assert system.parameters.Phi[0, 0, 0] == 1.0


def test_sizes_of_the_example_system() -> None:
    with pytest.raises(
        ValueError, match="states=0, inputs=3, measurements=3: there must be at least one state and one measurement"
    ):
        example_system(0)


GOOD = problem(example_system(3, 2, 1), 5, 2, 4, 12, seed=0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"N": 0}, "N=0 must be at least 1"),
        ({"M": -1}, "M=-1, L=4, N=5 must satisfy 0 <= M <= L$"),
        ({"M": 5}, "M=5, L=4, N=5 must satisfy 0 <= M <= L$"),
        ({"P0": np.diag([1.0, 1.0, -1.0])}, "P0 is no covariance: its smallest eigenvalue is -1"),
        ({"P0": np.triu(np.ones((3, 3)))}, "P0 is not symmetric"),
        ({"P0": np.full((3, 3), np.nan)}, "P0 holds a value that is not finite"),
        ({"x0": np.zeros(2)}, r"x0 has shape \(2,\), the system needs \(3,\)"),
        ({"P0": np.zeros((3, 2))}, r"P0 has shape \(3, 2\), the system needs \(3, 3\)"),
        ({"inputs": np.zeros((12, 3))}, r"inputs has shape \(12, 3\), the system needs \(12, 2\)"),
        ({"measurements": np.zeros(3)}, r"measurements has shape \(3,\), the system needs \(3, 1\)"),
        ({"measurements": np.array(3.0)}, r"measurements has shape \(\), the system needs \(any, 1\)"),
        ({"measurements": None}, r"measurements is None; give a row for each, .* \[\] if there are none"),
        ({"measurements": 7}, "measurements is 7; give a row for each"),
        ({"measurements": np.zeros((3, 1)) + 1j}, "measurements holds a value that is no number: it is complex"),
        ({"measurements": [np.zeros(1) + 1j]}, "measurements holds a value that is no number: it is complex"),
        (
            {"measurements": np.zeros((4, 1))},
            "measurements has 4 rows, and in 12 steps 3 are taken with N=5",
        ),
        ({"inputs": None}, "inputs is None; give a row of 2 numbers for each step$"),
        ({"inputs": np.zeros(12)}, r"inputs has shape \(12,\); give a row of 2 numbers for each step$"),
        ({"x0": np.zeros(3) + 1j}, "x0 is no array of numbers: it is complex"),
        ({"system": None}, "system is None; give a filters.system.System"),
        ({"system": example_system}, r"system is the function example_system, .* call it: system = example_system\("),
        ({"system": (GOOD.system, np.zeros(3))}, "system is a tuple with the System in it; unpack it: system, x0 ="),
    ],
)
def test_arguments_of_a_run(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        larsen.run(*GOOD._replace(**change))


@pytest.mark.parametrize("change", [{"L": 6}, {"M": 6, "L": 6}])
def test_a_filter_with_one_measurement_at_a_time_names_those_with_several(change: dict[str, Any]) -> None:
    with pytest.raises(
        ValueError,
        match="must satisfy 0 <= M <= L <= N; with more than N, use recalculate, larsen, clone, carried_gain",
    ):
        check_problem(*GOOD._replace(**change))


MASKED = np.ma.array(np.eye(3), mask=np.eye(3) == 1.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x0": MASKED[1]}, r"x0 is masked at \[1\]; give a number there"),
        ({"x0": [0.0, np.ma.masked, 0.0]}, r"x0\[1\] is masked"),
        ({"P0": MASKED}, r"P0 is masked at \[0, 0\]"),
        ({"P0": list(MASKED)}, r"P0\[0\] is masked at \[0\]"),
        ({"inputs": MASKED[:, :2]}, r"inputs is masked at \[0, 0\]"),
        (
            {"system": GOOD.system._replace(R=lambda _k, _p: np.ma.array([[1.0]], mask=[[True]]))},
            r"R\(k, p\) is masked at \[0, 0\]",
        ),
    ],
)
def test_masked_numbers(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        larsen.run(*GOOD._replace(**change))


def test_masked_matrices_of_a_linear_system() -> None:
    with pytest.raises(ValueError, match=r"linear_system: Q is masked at \[0, 0\]; give a number there"):
        linear_system(**{**MATRICES, "Q": MASKED})


@pytest.mark.parametrize(
    ("change", "options", "message"),
    [
        ({"L": 2}, {}, "L=2 must be > M=2"),
        ({"M": 5, "L": 5}, {}, "L=5 must be > M=5"),
        ({}, {"feedback": "never"}, "feedback='never' is unknown; give one of next-step, same-step"),
        ({}, {"gain": "later"}, "gain='later' is unknown"),
        ({}, {"low_rate_noise": "none"}, "low_rate_noise='none' is unknown"),
        ({}, {"update": "fast"}, "update='fast' is unknown; give one of textbook, joseph, short"),
        ({}, {"backend": "gpu"}, "backend='gpu' is unknown; give one of reference, compiled, numpy"),
    ],
)
def test_options_of_the_dual_rate_filter(change: dict[str, Any], options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        dual_rate.run(*GOOD._replace(**change), **options)


@pytest.mark.parametrize("value", [None, ["textbook"], {}, np.zeros(3)])
@pytest.mark.parametrize("option", ["update", "backend", "low_rate_noise", "gain", "feedback"])
def test_an_option_that_is_no_name(option: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"{option}=.* is unknown; give one of"):
        dual_rate.run(*GOOD, **{option: value})


@pytest.mark.parametrize("function", ["f", "F", "Q", "h", "H", "R"])
def test_a_system_is_made_of_functions(function: str) -> None:
    with pytest.raises(ValueError, match=rf"(?s){function} of the system is array\(.*; give a function"):
        larsen.run(*GOOD._replace(system=GOOD.system._replace(**{function: np.eye(3)})))


def test_only_plain_functions_can_be_run_by_a_backend() -> None:
    with pytest.raises(TypeError, match="is not a plain Python function"):
        function_for("compiled", max)
