"""The high-rate task of the dual-rate filter of several sensors: the state, and the transition from the last knot.

A knot is a measurement that is taken. The covariance is not here: the low-rate task, `low_rate`, has it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.kernels.dense import copy, matmul_blocked, matvec
from filters.modular.composition import ModularFilter
from filters.modular.predictors import propagate
from filters.modular.space import NOTHING, Space, plus
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Transition


@cache
def restarting(evolve: Callable[..., None]) -> Callable[..., None]:
    """Job of the step after a knot: the state, and Phi, which starts anew. Same function in, same function out."""

    def hr_restart(
        motion: Any,
        space: Space,
        x: FloatArray,
        u: FloatArray,
        dt: float,
        x_next: FloatArray,
        following: Transition,
        work: Workspace,
    ) -> None:
        evolve(motion, space, x, u, dt, x_next, work)
        copy(work.F, following.Phi)
        copy(motion.Q, following.Q)

    return hr_restart


@cache
def propagating(evolve: Callable[..., None]) -> Callable[..., None]:
    """Job of any other step: the state, Phi and Q, Steffes 2014, Eqs. (16) and (18). Same function in, same out."""

    def hr_propagate(
        motion: Any,
        space: Space,
        x: FloatArray,
        u: FloatArray,
        dt: float,
        x_next: FloatArray,
        transition: Transition,
        following: Transition,
        work: Workspace,
    ) -> None:
        evolve(motion, space, x, u, dt, x_next, work)
        matmul_blocked(work.F, transition.Phi, following.Phi)
        propagate(motion.Q, transition.Q, following.Q, work)

    return hr_propagate


def hr_pass(
    Phi: FloatArray, H: FloatArray, gain: FloatArray, delta: FloatArray, known: FloatArray, moved: FloatArray
) -> None:
    """Job of a landing, for each knot that it passes: delta (n,) <- Phi delta, as of an error of the state.

    known (p,) <- H delta, by which what is expected of the knot's measurement was wrong; gain (p, n) = K^T: where that
    has landed, delta <- delta - K H delta. Before, it is zero. moved (n,): scratch.
    """
    matvec(Phi, delta, moved)
    matvec(H, moved, known)
    for e in range(delta.shape[0]):
        total = moved[e]
        for r in range(known.shape[0]):
            total -= gain[r, e] * known[r]
        delta[e] = total


def hr_update(
    of: Space, x: FloatArray, Phi: FloatArray, delta: FloatArray, corrected: FloatArray, work: Workspace
) -> None:
    """Job of a landing: the error delta (n,) of the last knot is carried to now, and corrects the state, Eqs. (13) and
    (19)."""
    matvec(Phi, delta, work.n1)
    plus(of, x, work.n1, corrected)


class HighRate:
    """x (numbers,); transition: from the last knot, None where no step has been done since."""

    def __init__(self, composed: ModularFilter, x0: FloatArray, P0: FloatArray, backend: BackendName) -> None:
        evolve, motion = composed.predictor.evolve, composed.predictor.motion
        assert evolve is not None  # see `check_linearised`
        self._of, self._dt = composed.of, composed.dt
        self._motion = arguments_for(backend, motion)
        self._work = new_workspace(composed.of, NOTHING)
        self._work.variances[:] = np.diag(P0)
        self._restart = function_for(backend, restarting(evolve))
        self._propagate = function_for(backend, propagating(evolve))
        self._update = function_for(backend, hr_update)
        self.x = x0
        self.transition: Transition | None = None

    def step(self, u: FloatArray) -> None:
        n, x = self._of.errors, self.x
        self.x = np.empty_like(x)
        following = Transition(np.empty((n, n)), np.empty((n, n)))
        given = self._motion, self._of, x, u, self._dt, self.x
        if self.transition is None:
            self._restart(*given, following, self._work)
        else:
            self._propagate(*given, self.transition, following, self._work)
        self.transition = following

    def message(self) -> tuple[FloatArray, Transition | None]:
        """What the low-rate task gets at a knot, from which the transition starts anew: the state, and the way to
        here."""
        transition, self.transition = self.transition, None
        return self.x, transition

    def correct(self, delta: FloatArray) -> None:
        """By the error (n,) of the last knot."""
        assert self.transition is not None  # a correction lands in a later step than that of a knot
        x, self.x = self.x, np.empty_like(self.x)
        self._update(self._of, x, self.transition.Phi, delta, self.x, self._work)
