"""Bad input is refused: what is wrong is named, and what to do."""

from __future__ import annotations

import numpy as np
import pytest

from filters.accuracy import linear_model, linearised, lossless, lossless_each, with_low_rate_noise, with_wrong_noise
from filters.accuracy.model import output_rows
from filters.systems.linear import linear_system
from tests.filters.accuracy.cases import CV


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"Phi": [[1, np.nan], [0, 1]]}, r"Phi holds a value that is not finite, at \[0, 1\]; give numbers"),
        ({"Phi": [[1, 1]]}, r"Phi has shape \(1, 2\), needed is \(1, 1\)"),
        ({"Q": np.eye(3)}, r"Q has shape \(3, 3\), needed is \(2, 2\)"),
        ({"Q": -np.eye(2)}, "Q is no covariance: its smallest eigenvalue is -1"),
        ({"H": [[1, 0, 0]]}, r"H has shape \(1, 3\), needed is \(1, 2\)"),
        ({"R": [[0]]}, "^R is not positive definite.*give each measurement noise of its own"),
        ({"H": np.eye(2), "R": np.ones((2, 2))}, "^R is not positive definite"),
        ({"R": [["x"]]}, "R is no array of numbers"),
        ({"names": ["position"]}, r"names=\('position',\) are 1, the model has 2 states; give one for each"),
    ],
)
def test_a_model_is_checked(change: dict[str, object], message: str) -> None:
    good = {"Phi": CV.Phi, "Q": CV.Q, "H": CV.H, "R": CV.R}
    with pytest.raises(ValueError, match=message):
        linear_model(**{**good, **change})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("outputs", "message"),
    [
        ([2], "give numbers of states, from 0 to 1"),
        ([-1], "give numbers of states, from 0 to 1"),
        ([0.5], "give numbers of states, from 0 to 1"),
        ([], "give numbers of states, from 0 to 1"),
        ([[1, 0, 0]], r"outputs has shape \(1, 3\): give finite rows of 2 numbers, one for each state"),
        ([[np.nan, 0]], r"outputs has shape \(1, 2\): give finite rows of 2 numbers"),
    ],
)
def test_outputs_are_checked(outputs: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        lossless(CV, outputs, 10, 4)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("N", "L", "message"),
    [
        (0, 1, "N=0 must be a whole number of steps, at least 1"),
        (2.5, 1, "N=2.5 must be a whole number of steps, at least 1"),
        (True, 1, "N=True must be a whole number of steps"),
        (10, -1, "L=-1 must be a whole number of steps, at least 0"),
        (10, 4.0, "L=4.0 must be a whole number of steps"),
    ],
)
def test_steps_are_checked(N: int, L: int, message: str) -> None:
    for figure in (lossless, lambda *given: with_low_rate_noise(*given, "sum")):
        with pytest.raises(ValueError, match=message):
            figure(CV, [0], N, L)
    with pytest.raises(ValueError, match=message):
        lossless_each(CV, [0], N, [L])


def test_assumed_noises_are_checked() -> None:
    with pytest.raises(ValueError, match=r"low_rate_noise='none' is unknown; give one of exact, sum, euler"):
        with_low_rate_noise(CV, [0], 10, 4, "none")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"R has shape \(2, 2\), needed is \(1, 1\)"):
        with_wrong_noise(CV, [0], 10, 4, np.eye(2))
    with pytest.raises(ValueError, match=r"^R is not positive definite"):
        with_wrong_noise(CV, [0], 10, 4, [[0]])


def test_an_exact_low_rate_noise_is_no_other_method() -> None:
    assert with_low_rate_noise(CV, [0], 10, 8, "exact") == lossless(CV, [0], 10, 8)


def test_outputs_by_number_are_rows() -> None:
    np.testing.assert_array_equal(output_rows([1, 0], 3), [[0, 1, 0], [1, 0, 0]])
    np.testing.assert_array_equal(output_rows([[1, 2, 3]], 3), [[1, 2, 3]])
    with pytest.raises(ValueError, match=r"outputs \[0, 2, 0\]: state 0 is there twice: give each state once"):
        output_rows([0, 2, 0], 3)


@pytest.mark.parametrize("state", [-1, 3, 0.5, 1e20, float("nan"), float("inf")])
def test_what_is_no_number_of_a_state_is_refused(state: float) -> None:
    with pytest.raises(ValueError, match="give numbers of states, from 0 to 2"):
        output_rows([0, state], 3)


def test_a_system_is_taken_as_it_is_in_step_0() -> None:
    system = linear_system(np.array([CV.Phi, 2 * CV.Phi]), [[0], [1]], CV.H, CV.Q, CV.R)
    found = linearised(system)
    for matrix, expected in zip(found[:4], CV[:4], strict=True):
        np.testing.assert_array_equal(matrix, expected)
    with pytest.raises(ValueError, match=r"x has shape \(3,\), the system needs \(2,\)"):
        linearised(system, [0, 0, 0])
    with pytest.raises(ValueError, match="u holds a value that is not finite"):
        linearised(system, u=[np.nan])
