"""What a run of a filter leaves behind."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.records import Correction, Estimate
from filters.system import System


class History(NamedTuple):
    """The results of a filter run over steps 0 .. steps.

    x (steps + 1, n): the whole-state estimate at the end of every step.
    P_reference (cycles, n, n): P_{k^-} at k = 0, N, 2N, ...; where several measurements are on their way at once, as
        far as all that were taken before k have arrived within the run.
    innovations (updates, p), gains (updates, n, p): z and K of each measurement that arrived within the run.
    """

    x: FloatArray
    P_reference: FloatArray
    innovations: FloatArray
    gains: FloatArray


class HistoryRecorder:
    """Collects a history while a filter runs."""

    def __init__(self, system: System) -> None:
        self._system = system
        self._x: list[FloatArray] = []
        self._references: list[Estimate] = []
        self._z: list[FloatArray] = []
        self._K: list[FloatArray] = []

    def state(self, x: FloatArray) -> None:
        """The estimate at the end of a step."""
        self._x.append(x)

    def reference(self, x: FloatArray, P: FloatArray) -> None:
        """x_{k^-} and P_{k^-} of a measurement reference step."""
        self._references.append(Estimate(x, P))

    def correction(self, correction: Correction) -> None:
        """What a measurement that was used has said."""
        self._z.append(correction.z)
        self._K.append(correction.K)

    def keep_known(self, measurements: int) -> None:
        """Forget the references of which it is not known yet what came before them, of so many measurements."""
        if len(self._z) < measurements:
            del self._references[len(self._z) + 1 :]

    def references(self) -> Estimate:
        """x_{k^-} (cycles, n) and P_{k^-} (cycles, n, n)."""
        return Estimate(*map(np.array, zip(*self._references, strict=True)))

    def history(self) -> History:
        """What was collected, as arrays."""
        n, p = self._system.states, self._system.measurements
        return History(
            np.array(self._x),
            self.references().P,
            np.array(self._z).reshape(-1, p),
            np.array(self._K).reshape(-1, n, p),
        )
