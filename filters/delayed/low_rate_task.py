"""The low-rate (LR) task of the dual rate filter as it runs: cycle after cycle, first in first out."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.high_rate import hr_update
from filters.delayed.high_rate_task import Message
from filters.delayed.low_rate import lr_correct, lr_gain, lr_update
from filters.delayed.low_rate_noise import NoiseMethod
from filters.records import Correction, Estimate, new_correction, new_workspace
from filters.system import System


class Waiting(NamedTuple):
    """A measurement that has not arrived. reference: x_{k^-}, P_{k^-}; correction: holds K_k if it is precomputed;
    transition: over the cycle before k."""

    k: int
    reference: Estimate
    correction: Correction
    transition: Any


class LowRateTask:
    """The error estimates in the making, and P (n, n): P_{k^+} of the last k, P_{k^-} until its measurement is used.

    in_flight: how many corrections of earlier measurements are not in x_{k^-}, once there have been so many, for they
    land after k. They are known when the innovation of k is formed, which is that of

        x_{k^-} + sum_i Phi_{i->k} delta_x_i,        from cycle to cycle, as in Eqs. (13), (19),

    which takes H_k sum_i Phi_{i->k} delta_x_i from it where h is linear, and for others is the better estimate.

    Where the next measurement is taken before the last one has arrived, M >= N, LR propagate to the next k waits for
    the LR update of the last, for it needs P_{k^+}; not so where gain and P_{k^+} are precomputed.
    known(x, P): is called with each x_{k^-}, P_{k^-}.
    """

    def __init__(
        self,
        system: System,
        P0: FloatArray,
        noise: NoiseMethod,
        form: CovarianceForm,
        backend: BackendName,
        *,
        early: bool,
        in_flight: int,
        known: Callable[[FloatArray, FloatArray], None],
    ) -> None:
        self._size = system
        self._early = early
        self._known = known
        self._work = new_workspace(system)
        self._system = arguments_for(backend, system)
        self._form = arguments_for(backend, form)
        self._propagate = function_for(backend, noise.lr_propagate)
        self._update = function_for(backend, lr_update)
        self._gain = function_for(backend, lr_gain)
        self._correct = function_for(backend, lr_correct)
        self._carry = function_for(backend, hr_update)
        self._sent: deque[tuple[Message, bool]] = deque()
        self._waiting: deque[Waiting] = deque()
        self._flying: deque[tuple[Any, FloatArray]] = deque(
            maxlen=in_flight
        )  # transition over the cycle before; delta_x
        self.P = np.array(P0, dtype=np.float64)

    def receive(self, message: Message, *, measured: bool) -> None:
        """What HR sends at k, at which a measurement is taken or is missing."""
        self._sent.append((message, measured))
        self._propagate_on()

    def update(self, y: FloatArray) -> Correction:
        """Use the measurement that waits longest."""
        k, reference, correction, transition = self._waiting.popleft()
        reference = reference._replace(x=self._compensated(reference.x, transition))
        if self._early:
            self._correct(self._system, k, y, reference, correction)
        else:
            self.P = np.empty_like(self.P)
            self._update(self._system, self._form, k, y, reference, self.P, correction, self._work)
        self._flying.append((transition, correction.delta_x))
        self._propagate_on()
        return correction

    def _propagate_on(self) -> None:
        """To each next k to which it can."""
        while self._sent and (self._early or not self._waiting):
            (k, x, transition), measured = self._sent.popleft()
            P = self.P
            if transition is not None:
                P = np.empty_like(P)
                self._propagate(self._form, self.P, transition, P, self._work)
            self.P = P  # stays so if the measurement is missing
            self._known(x, P)
            if not measured:
                continue
            reference, correction = Estimate(x, P), new_correction(self._size)
            if self._early:
                self.P = np.empty_like(P)
                self._gain(self._system, self._form, k, reference, self.P, correction, self._work)
            self._waiting.append(Waiting(k, reference, correction, transition))

    def _compensated(self, x: FloatArray, transition: Any) -> FloatArray:
        """x_{k^-} with the corrections that are in flight at k."""
        if not self._flying:
            return x
        (_, carried), *later = self._flying
        for before, delta_x in later:
            carried = self._plus(delta_x, before.Phi, carried)
        return self._plus(x, transition.Phi, carried)

    def _plus(self, a: FloatArray, Phi: FloatArray, b: FloatArray) -> FloatArray:
        """a + Phi b."""
        total = np.empty_like(a)
        self._carry(self._form, a, Phi, b, total, self._work)
        return total
