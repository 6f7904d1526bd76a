"""Stochastic cloning with any number of measurements on their way."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.cloned import Clone, carry, compensate, correct, couple, cross, divide, gain_at_k, new_clone
from filters.delayed.standard import propagate
from filters.problem import Problem
from filters.records import Correction, Estimate, new_correction, new_estimate, new_workspace
from filters.system import System


class Jobs(NamedTuple):
    """Those of a way to clone. start: at k, if nothing else is on its way there; update: at m."""

    start: Callable[..., FloatArray]
    update: Callable[..., None]


@dataclass
class OnItsWay:
    """A measurement taken at k whose correction has yet to land.

    clone: its expected with all that has landed since k. W (n, p): as carried. shares: G by the k of the measurements
    that were on their way at k and still are.
    """

    k: int
    H: FloatArray
    clone: Clone
    W: FloatArray
    shares: dict[int, FloatArray] = field(default_factory=dict)


class Cloning:
    """The filter. now: its estimate, with the covariance that its error has by what has landed."""

    def __init__(self, problem: Problem, size: System, form: CovarianceForm, jobs: Jobs, backend: BackendName) -> None:
        self._size = size
        self._system, self._form = arguments_for(backend, problem.system), arguments_for(backend, form)
        self._propagate, self._carry = function_for(backend, propagate), function_for(backend, carry)
        self._start, self._update = function_for(backend, jobs.start), function_for(backend, jobs.update)
        self._cross, self._couple = function_for(backend, cross), function_for(backend, couple)
        self._divide, self._compensate = function_for(backend, divide), function_for(backend, compensate)
        self._correct, self._gain = function_for(backend, correct), function_for(backend, gain_at_k)
        self._work = new_workspace(size)
        self._flights: deque[OnItsWay] = deque()
        self.now = problem.start

    def propagate(self, j: int, u: FloatArray) -> None:
        """From j to j + 1."""
        before, self.now = self.now, new_estimate(self._size)
        Phi = self._propagate(self._system, self._form, j, before, u, self.now, self._work)
        for flight in self._flights:
            W, flight.W = flight.W, np.empty_like(flight.W)
            self._carry(self._form, Phi, W, flight.W)

    def take(self, k: int) -> None:
        """A measurement is taken."""
        clone, shares = new_clone(self._size), {}
        if self._flights:
            H = self._cross(self._system, self._form, k, self.now, clone, self._work)
            for earlier in self._flights:
                W, clone = clone.W, clone._replace(W=np.empty_like(clone.W))
                G = shares[earlier.k] = np.empty_like(clone.S)
                self._couple(self._form, H, earlier.clone, earlier.W, W, clone.W, G, self._work)
            self._divide(self._system, self._form, k, H, clone, self._work)
        else:
            H = self._start(self._system, self._form, k, self.now, clone, self._work)
        self._flights.append(OnItsWay(k, H, clone, clone.W, shares))

    def land(self, y: FloatArray) -> Correction:
        """The first of those on their way arrives. Returns innovation and gain at its k."""
        landed, correction = self._flights.popleft(), new_correction(self._size)
        clone, z, work = landed.clone, correction.z, self._work
        before, self.now = self.now, new_estimate(self._size)
        self._update(self._system, self._form, landed.k, y, landed.H, clone, landed.W, before, self.now, z, work)
        self._gain(self._form, clone, correction.K, work)
        for later in self._flights:
            expected, now_expected = later.clone.expected, np.empty_like(z)
            self._compensate(expected, later.shares.pop(landed.k), z, now_expected)
            later.clone = later.clone._replace(expected=now_expected)
        return correction

    def reference(self) -> Estimate:
        """The estimate, and the covariance that it will have once all on its way has landed; for the record."""
        estimate = self.now
        for flight in self._flights:
            before, estimate = estimate, new_estimate(self._size)
            as_expected, z = flight.clone.expected, np.empty(self._size.measurements)
            self._correct(self._form, as_expected, flight.clone, flight.W, before, estimate, z, self._work)
        return estimate
