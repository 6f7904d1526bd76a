"""The high-rate (HR) task of the dual rate filter as it runs."""

from __future__ import annotations

from collections import deque
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.high_rate import hr_restart, hr_update
from filters.delayed.low_rate_noise import NoiseMethod
from filters.records import Transition, new_workspace
from filters.system import System


class Message(NamedTuple):
    """From HR to LR at k. transition: over the steps k - N .. k, None at k = 0."""

    k: int
    x: FloatArray
    transition: Any


class HighRateTask:
    """The whole state x_j (n,), the transition from the last k to j, and Phi over each of the cycles before it.

    One transition is accumulated however many corrections are on their way: one of an earlier k goes through the whole
    cycles since, product by product, Phi_{k->l} delta_x = Phi_{k'->l} (... (Phi_{k->k+N} delta_x)).
    """

    def __init__(
        self,
        system: System,
        N: int,
        L: int,
        x0: FloatArray,
        noise: NoiseMethod,
        form: CovarianceForm,
        backend: BackendName,
    ) -> None:
        self._size = system
        self._N = N
        self._noise = noise
        self._work = new_workspace(system)
        self._system = arguments_for(backend, system)
        self._form = arguments_for(backend, form)
        self._restart = function_for(backend, hr_restart)
        self._propagate = function_for(backend, noise.propagate)
        self._update = function_for(backend, hr_update)
        self._multiply = function_for(backend, form.error)
        self._transition: Any = None
        self._restarted = 0  # k from which it is
        self._cycles: deque[FloatArray] = deque(maxlen=L // N + 1)
        self.x = np.array(x0, dtype=np.float64)

    def step(self, j: int, u: FloatArray) -> None:
        """From j to j + 1."""
        x, self.x = self.x, np.empty_like(self.x)
        if j % self._N == 0:
            if j > 0:
                self._cycles.append(self._transition.Phi)
            start = self._restart(self._system, j, x, u, self.x)
            if self._N == 1:  # the whole cycle: it is read when others have been made, in the same memory
                start = Transition(start.Phi.copy(), start.Q.copy())
            self._transition, self._restarted = self._noise.start(start, j, self._N), j
        else:
            following = self._noise.new(self._size)
            self._transition = self._propagate(
                self._system, self._form, j, x, self._transition, u, self.x, following, self._work
            )

    def message(self, k: int) -> Message:
        """What LR gets at k."""
        return Message(k, self.x, self._transition)

    def correct(self, k: int, L: int, delta_x: FloatArray) -> None:
        """Take in the error estimate of k = l - L."""
        whole = (self._restarted - k) // self._N if L > 0 else 0
        for Phi in list(self._cycles)[len(self._cycles) - whole :]:
            before, delta_x = delta_x, np.empty_like(delta_x)
            self._multiply(Phi, before, delta_x)  # (13), over a cycle
        Phi_to_now = self._transition.Phi if L > 0 else np.eye(len(self.x))
        x, self.x = self.x, np.empty_like(self.x)
        self._update(self._form, x, Phi_to_now, delta_x, self.x, self._work)
