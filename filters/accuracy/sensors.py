"""The model of several sensors, each with an H and an R of its own, and the covariance that its filter settles to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.compose import Cycles, composed, repeated
from filters.accuracy.model import LinearModel, linear_model
from filters.accuracy.riccati import steady_prior
from filters.arrays import FloatArray, as_array


class SensorsModel(NamedTuple):
    """x_{j+1} = Phi x_j + w_j, and of each sensor y_k = H x_k + nu_k; w ~ N(0, Q), nu ~ N(0, R) of the sensor.

    Phi, Q (n, n); sensors: by name H (p, n) and R (p, p). names: of the states, for messages; none if they have none.
    """

    Phi: FloatArray
    Q: FloatArray
    sensors: Mapping[str, tuple[FloatArray, FloatArray]]
    names: tuple[str, ...] = ()

    @property
    def states(self) -> int:
        return len(self.Phi)

    @property
    def stacked(self) -> LinearModel:
        """All sensors as one, which measures in each step."""
        H = np.vstack([H for H, _ in self.sensors.values()])
        R = np.zeros((len(H), len(H)))
        row = 0
        for _, noise in self.sensors.values():
            R[row : row + len(noise), row : row + len(noise)] = noise
            row += len(noise)
        return LinearModel(self.Phi, self.Q, H, R, self.names)


def sensors_model(
    Phi: ArrayLike, Q: ArrayLike, sensors: Mapping[str, tuple[ArrayLike, ArrayLike]], names: Sequence[str] = ()
) -> SensorsModel:
    """Raises ValueError, naming the matrix and the sensor, for what `linear_model` refuses, and if there is none."""
    if not isinstance(sensors, Mapping) or not sensors:
        raise ValueError("sensors must give the H and R of each by its name, of at least one: {'gps': (H, R)}")
    states = len(np.atleast_1d(as_array("Phi", Phi)))
    model = linear_model(Phi, Q, np.eye(1, states), np.eye(1), names)
    checked: dict[str, tuple[FloatArray, FloatArray]] = {}
    for name, both in sensors.items():
        if not isinstance(both, tuple | list) or len(both) != 2:
            raise ValueError(f"sensor {name!r}: give its H and its R: (H, R)")
        try:
            H, R = (np.atleast_2d(as_array(what, value)) for what, value in zip("HR", both, strict=True))
            seen = linear_model(model.Phi, model.Q, H, R)
        except ValueError as error:
            raise ValueError(f"sensor {name!r}: {error}") from None
        checked[name] = (seen.H, seen.R)
    return SensorsModel(model.Phi, model.Q, checked, model.names)


def settled(model: SensorsModel, taken: Mapping[str, Sequence[int]], cycle: int) -> FloatArray:
    """P (n, n) before the measurements of step 0, once the filter no longer changes from cycle to cycle.

    taken: by sensor, the steps of 0 .. cycle - 1 in which it measures, in every cycle; without delay.
    Raises ValueError where it does not settle.
    """
    information: dict[int, FloatArray] = {}
    for name, steps in taken.items():
        H, R = model.sensors[name]
        told = H.T @ np.linalg.solve(R, H)
        for at in steps:
            information[at] = information[at] + told if at in information else told
    events = sorted({0, *information})
    nothing = np.zeros_like(model.Q)
    lengths = [after - at for at, after in zip(events, [*events[1:], cycle], strict=True)]
    with np.errstate(all="ignore"):
        step = Cycles(model.Phi, nothing, model.Q)
        between = {length: repeated(step, length) for length in {*lengths, model.states}}
        scale = _scale(between[model.states].Q)
        outer = np.outer(scale, scale)
        pieces = [
            Cycles(
                between[length].F * scale / scale[:, None],
                information.get(at, nothing) * outer,
                between[length].Q / outer,
            )
            for at, length in zip(events, lengths, strict=True)
        ]
        whole = reduce(composed, pieces)
    if not all(np.isfinite(matrix).all() for matrix in whole):
        raise ValueError(UNSETTLED)
    values, vectors = np.linalg.eigh(whole.G)
    seen = (vectors * np.sqrt(values.clip(0.0))).T
    P = steady_prior(whole.F, whole.Q, seen, np.eye(len(seen)))
    if not np.isfinite(P).all():
        raise ValueError(UNSETTLED)
    return np.asarray(P * outer)


UNSETTLED = "the covariance does not settle: something is never seen, or too seldom"


def _scale(Q: FloatArray) -> FloatArray:
    """One of each state: the deviation that noise gives it, 1 where there is none."""
    variances = np.diag(Q)
    return np.asarray(np.where(variances > 0.0, np.sqrt(variances), 1.0))
