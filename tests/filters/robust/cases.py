"""Models to try the robust filter on."""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.robust.blocks import NATURAL, assemble, block_sizes, block_starts
from filters.robust.model import prepared, weights, without_measurement
from filters.robust.records import Predicted, RobustModel
from filters.robust.uncertain import linearised
from filters.systems.attitude import AttitudeRows, attitude, attitude_scaling, attitude_uncertainty
from filters.systems.position import PositionRows, position, position_scaling, position_uncertainty

Array = Any


def sayed(**changed: Any) -> RobustModel:
    """The example of Sayed, "A framework for state-space estimation with uncertain models" (2001), without E rows."""
    model = RobustModel(
        F=np.array([[0.9802, 0.0196], [0.0, 0.9802]]),
        G=np.eye(2),
        H=np.array([[1.0, -1.0]]),
        D=np.eye(1),
        Q=np.array([[1.9608, 0.0195], [0.0195, 1.9608]]),
        R=np.eye(1),
        E_F=np.zeros((0, 2)),
        E_G=np.zeros((0, 2)),
        E_H=np.zeros((0, 2)),
        E_D=np.zeros((0, 1)),
        M1=np.array([[0.0198], [0.0]]),
        M2=np.zeros((1, 1)),
    )
    return model._replace(**{name: np.array(value, dtype=float) for name, value in changed.items()})


def sayed_measurements(steps: int) -> Array:
    i = np.arange(steps)[:, np.newaxis]
    return np.sin(0.3 * i) + 0.5 * np.cos(0.11 * i)


CERTAIN = sayed()
NOISE_TOO = {"E_F": [[0, 5]], "E_G": [[0.5, 0.25]]}
VECTOR_CASES: dict[str, tuple[RobustModel, float]] = {
    "T1": (CERTAIN, np.inf),
    "T2": (sayed(**NOISE_TOO), np.inf),
    "T3": (sayed(E_F=[[0, 5]], E_G=[[0, 0]]), np.inf),
    "T4": (sayed(**NOISE_TOO, E_H=[[0.1, 0.2]], E_D=[[0.3]], M2=[[0.4]]), np.inf),
    "T5": (sayed(E_F=[[0, 5]], E_G=[[0, 0]]), 1.0),
    "T7": (CERTAIN, 2.0),
}


def random_model(seed: int, n: int, m: int, p: int, t1: int, t2: int) -> RobustModel:
    """Dense matrices, as many measurement noises as measurements."""
    random = np.random.default_rng(seed)

    def normal(*shape: int) -> Array:
        return random.normal(size=shape)

    def covariance(size: int) -> Array:
        A = normal(size, size)
        return A @ A.T + np.eye(size)

    return RobustModel(
        F=normal(n, n) + 2 * np.eye(n),
        G=normal(n, m),
        H=normal(p, n),
        D=normal(p, p) + 2 * np.eye(p),
        Q=covariance(m),
        R=covariance(p),
        E_F=normal(t1, n),
        E_G=normal(t1, m),
        E_H=normal(t2, n),
        E_D=normal(t2, p),
        M1=normal(n, 2),
        M2=normal(p, 1),
    )


def start(n: int, seed: int = 0) -> Predicted:
    random = np.random.default_rng([seed, 1])
    A = random.normal(size=(n, n))
    return Predicted(random.normal(size=n), A @ A.T + 0.5 * np.eye(n))


def attitude_model(rows: AttitudeRows) -> RobustModel:
    """Scaled; n = 6, m = 6, p = 3."""
    x, turn_rates = np.array([0.1, -0.05, 1.2, 0.01, -0.02, 0.03]), np.array([0.2, -0.1, 0.3])
    return linearised(attitude(), attitude_scaling(), attitude_uncertainty(rows), x, turn_rates)


def position_model(rows: PositionRows) -> RobustModel:
    """Scaled; n = 9, m = 6, p = 6."""
    latitude, longitude, height = np.radians(-22.0075), np.radians(-47.8909), 850.0
    x = np.array([latitude, longitude, height, 8, -5, 0.3, 0.04, -0.03, 0.05])
    u = np.array([0.5, -0.2, -9.7, 0.02, -0.03, 0.6])
    scaling = position_scaling(latitude, longitude, height)
    return linearised(position(latitude, height), scaling, position_uncertainty(rows), x, u)


def prediction_model() -> RobustModel:
    """The position between fixes: nothing is measured."""
    return without_measurement(position_model("bias"))


def block_system(
    model: RobustModel, before: Predicted, y: Array, c: Array, mu: float, order: Any = NATURAL
) -> tuple[Array, Array]:
    """A and b of the step."""
    ready = prepared(model, mu)
    sizes = block_sizes(ready)
    N = sum(sizes)
    T = np.full((N, N + sizes[0] + 1), np.nan)
    assemble(ready, weights(ready, mu), before, y, c, block_starts(sizes, order), T)
    return T[:, :N], T[:, N:]


def close(found: Array, expected: Array, tolerance: float = 1e-9) -> None:
    """Relative to the greatest element."""
    scale = np.max(np.abs(expected), initial=1e-300)
    np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance * scale)
