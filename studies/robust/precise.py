"""The robust filter of a linear system in a hundred digits, so that rounding decides nothing.

In its steady state P may be singular: in the limit, mu = inf, each uncertain row ties a noise down, and where none is
left over P comes to nothing along every state that decays by itself. Double precision leaves rounding there, of either
sign, and a filter that looks for a covariance refuses it.
"""

from __future__ import annotations

from decimal import Decimal, localcontext
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray
from filters.robust.model import prepared, weights
from filters.robust.records import RobustModel

DIGITS = 100
CLOSE = 1e-6
"""Of P, or of 1 where P is less, the variance of a noise: what is nearer is one P."""
FIRST, LAST = 2**6, 2**18
"""Steps after which P is looked at: the first, and twice as many each time."""

Digits: TypeAlias = NDArray[Any]
"""An array of `Decimal`."""


class Predictor(NamedTuple):
    """The step as a Kalman filter's that measures H x, uncertain rows among it, with noises of variances R (l,) that
    depend on nothing else: x becomes F x, with noise Q."""

    F: Digits
    Q: Digits
    H: Digits
    R: Digits


class Steady(NamedTuple):
    """steps: after which P is the same from each start, and the same as after half of them. P (n, n): this one. closed
    (n, n): how the next estimate depends on the last."""

    steps: int
    P: FloatArray
    closed: FloatArray


def steady_state(model: RobustModel, mu: float, starts: tuple[float, float]) -> Steady | None:
    """P begins as so many times the unit matrix; None if it has not come to one within `LAST` steps.

    model: with at most one uncertain row, of the state's equation; D and R are diagonal.
    """
    with localcontext() as context:
        context.prec = DIGITS
        predictor = as_predictor(model, mu)
        found = [_exact(start * np.eye(len(model.F))) for start in starts]
        steps, next_steps = 0, FIRST
        while next_steps <= LAST:
            before = found[0]
            for _ in range(next_steps - steps):
                found = [following(predictor, P) for P in found]
            steps, next_steps = next_steps, 2 * next_steps
            if _close(found[0], found[1]) and _close(found[0], before):
                return Steady(steps, _rounded(found[0]), _rounded(_closed(predictor, found[0])))
    return None


def as_predictor(model: RobustModel, mu: float) -> Predictor:
    """In the digits of the context, of the numbers that the filter computes with."""
    ready = prepared(model, mu)
    weighing = weights(ready, mu)
    F, G, H, D, Q, R, E_F, E_G = map(_exact, ready[:8])
    process = G @ Q @ G.T + _exact(weighing.Phi1)
    measured = np.diag(D @ R @ D.T + _exact(weighing.Phi2))
    if not len(E_F):
        return Predictor(F, process, H, measured)
    row = (E_G @ Q @ E_G.T)[0, 0] + Decimal(weighing.inverse_lambda)
    common = G @ Q @ E_G.T
    return Predictor(
        F - common @ E_F / row, process - common @ common.T / row, np.vstack([H, E_F]), np.append(measured, row)
    )


def following(predictor: Predictor, P: Digits) -> Digits:
    """P (n, n) a step later."""
    for h, r in zip(predictor.H, predictor.R, strict=True):
        gain = P @ h
        P = P - np.outer(gain, gain) / (h @ gain + r)
    after: Digits = predictor.F @ P @ predictor.F.T + predictor.Q
    return (after + after.T) / 2


def _closed(predictor: Predictor, P: Digits) -> Digits:
    left = _exact(np.eye(len(P)))
    for h, r in zip(predictor.H, predictor.R, strict=True):
        gain = P @ h
        left = left - np.outer(gain, h @ left) / (h @ gain + r)
        P = P - np.outer(gain, gain) / (h @ gain + r)
    closed: Digits = predictor.F @ left
    return closed


def _close(P: Digits, other: Digits) -> bool:
    return bool(np.abs(P - other).max() <= Decimal(CLOSE) * max(Decimal(1), np.abs(other).max()))


def _exact(matrix: FloatArray) -> Digits:
    return np.array([Decimal(value) for value in matrix.ravel()], dtype=object).reshape(matrix.shape)


def _rounded(matrix: Digits) -> FloatArray:
    return matrix.astype(np.float64)
