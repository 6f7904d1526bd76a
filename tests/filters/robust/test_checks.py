"""Messages say which matrix is wrong and what to do."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.robust.model import prepared, weights
from filters.robust.records import Predicted, RobustModel
from filters.robust.run import run
from filters.robust.step import step
from tests.filters.robust.cases import attitude_model, random_model, start

MODEL = random_model(0, 3, 2, 2, 1, 1)
Y, C = np.zeros(2), np.zeros(3)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"Q": np.diag([1.0, -1.0])}, "Q is not positive definite .* leave out its column of G"),
        ({"R": np.diag([1.0, 0.0])}, "R is not positive definite .* leave out its column of D"),
        ({"Q": np.array([[1.0, 0.5], [0.0, 1.0]])}, r"Q is not symmetric; give \(Q \+ Q.T\) / 2"),
        ({"G": np.ones((2, 2))}, r"G has shape \(2, 2\), needed is \(3, 2\)"),
        ({"H": np.ones((2, 4))}, r"H has shape \(2, 4\), needed is \(2, 3\)"),
        ({"E_G": np.ones((2, 2))}, r"E_G has shape \(2, 2\), needed is \(1, 2\)"),
        ({"M2": np.ones((3, 1))}, r"M2 has shape \(3, 1\), needed is \(2, 1\)"),
        ({"D": np.ones(2)}, r"D has shape \(2,\); needed is a matrix"),
        ({"F": np.full((3, 3), np.nan)}, "F holds a value that is not finite"),
    ],
)
def test_models(changed: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        prepared(MODEL._replace(**changed))


def test_no_state() -> None:
    empty = RobustModel(*(np.zeros((0, 0)) for _ in RobustModel._fields))
    with pytest.raises(ValueError, match="F is empty"):
        prepared(empty)


@pytest.mark.parametrize("mu", [0.0, -1.0, np.nan])
def test_mu(mu: float) -> None:
    with pytest.raises(ValueError, match=r"mu=.* must be positive"):
        weights(MODEL, mu)


@pytest.mark.parametrize("xi", [0.0, -1.0, np.nan, np.inf])
def test_xi(xi: float) -> None:
    with pytest.raises(ValueError, match=r"xi=.* must be positive and finite"):
        prepared(MODEL, 1.0, xi)


def test_existence() -> None:
    """A row of E_H and E_D that follows from the measurement is no equation more; with a finite mu it may stay."""
    model = MODEL._replace(D=np.eye(2), E_D=np.array([[2.0, 1.0]]), E_H=np.array([[2.0, 1.0]]) @ MODEL.H)
    with pytest.raises(ValueError, match=r"rank 3, but there are 4.* give a finite mu"):
        prepared(model)
    assert len(prepared(model, 1e3).E_H) == 1
    assert len(prepared(attitude_model("all")).E_H) == 1


@pytest.mark.parametrize(
    ("before", "y", "message"),
    [
        (Predicted(np.zeros(3), np.diag([1.0, 1.0, 0.0])), Y, "P is not positive definite"),
        (Predicted(np.zeros(3), np.eye(3) + np.eye(3, k=1)), Y, "P is not symmetric"),
        (Predicted(np.zeros(2), np.eye(3)), Y, r"x has shape \(2,\), the model needs \(3,\)"),
        (Predicted(np.zeros(3), np.eye(2)), Y, r"P has shape \(2, 2\)"),
        (start(3), np.zeros(3), r"y has shape \(3,\), the model needs \(2,\)"),
        (start(3), np.array([0.0, np.inf]), "y holds a value that is not finite"),
    ],
)
def test_steps(before: Predicted, y: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        step(MODEL, before, y, C)


def test_c() -> None:
    with pytest.raises(ValueError, match=r"c has shape \(2,\), the model needs \(3,\)"):
        step(MODEL, start(3), Y, np.zeros(2))


def test_small_units_are_positive_definite_too() -> None:
    """Latitudes in radians: variances of 1e-15 beside 1."""
    P = np.diag([1e-15, 1.0, 1e-12])
    assert np.isfinite(step(MODEL, Predicted(np.zeros(3), P), Y, C, mu=10.0).P).all()


def test_runs() -> None:
    with pytest.raises(ValueError, match="there are 5 measurements, but 2 models and 5 rows of c"):
        run([MODEL, MODEL], np.zeros(3), np.eye(3), np.zeros((5, 2)))
    with pytest.raises(ValueError, match="models differ in shape"):
        run([MODEL, random_model(0, 3, 2, 2, 0, 1)], np.zeros(3), np.eye(3), np.zeros((2, 2)))
    with pytest.raises(ValueError, match=r"measurements has shape \(5, 3\), the system needs \(5, 2\)"):
        run(MODEL, np.zeros(3), np.eye(3), np.zeros((5, 3)))
