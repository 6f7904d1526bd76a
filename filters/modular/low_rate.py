"""The low-rate task of the dual-rate filter of several sensors: the covariance, from one knot to the next.

A knot is a measurement that is taken. Its gain is computed in the order of the knots, whatever has arrived: the
covariance does not depend on data. What has arrived waits as delta, the error that it tells of the knot's state, until
it lands. Then delta goes from knot to knot: each whose measurement has landed takes its share, and of each other what
was expected is put right. So the estimate is, in every step, that of the filter with these gains that got what has
landed.

What is lost of a measurement is known when it lands: its gain is then that of the rest, and the knots
behind it that have not landed get the gains that are best beside those that have.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import islice
from typing import Any

import numpy as np

from filters.arrays import Flags, FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.kernels.dense import copy
from filters.kernels.solve import cholesky, solve_cholesky
from filters.modular.carried_gain import taking_by
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.correctors import leave_out, project
from filters.modular.estimate import empty
from filters.modular.high_rate import hr_pass
from filters.modular.predictors import propagate
from filters.modular.space import NOTHING, Space, minus
from filters.modular.updates import Covariance, covariance_of, joseph
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Estimate, Transition


def lr_propagate(P: FloatArray, transition: Transition, P_next: FloatArray, work: Workspace) -> None:
    """Job: the covariance of a step k is carried over the transition from it, Eq. (14); it stays symmetric."""
    copy(transition.Phi, work.F)
    propagate(transition.Q, P, P_next, work)


def lr_correct(
    observed: Space,
    y: FloatArray,
    lost: Flags,
    expected: FloatArray,
    known: FloatArray,
    gain: FloatArray,
    delta: FloatArray,
    work: Workspace,
) -> None:
    """Job: delta (n,) = K (y - expected - known); lost (p,): what has no part in it."""
    minus(observed, y, expected, work.z)
    for e in range(delta.shape[0]):
        delta[e] = 0.0
    for r in range(observed.errors):
        if not lost[r]:
            innovation = work.z[r] - known[r]
            for e in range(delta.shape[0]):
                delta[e] += gain[r, e] * innovation


@cache
def gain_again(covariance: Covariance) -> Callable[..., None]:
    """The gain of a knot, its H in work, where the covariance before it is another. Same function in, same out."""

    def regain(view: Any, P: FloatArray, lost: Flags, P_after: FloatArray, work: Workspace) -> None:
        project(view.R, P, work)
        for r in range(lost.shape[0]):
            if lost[r]:
                leave_out(r, work)
        cholesky(work.S, work.pp1)
        solve_cholesky(work.pp1, work.cross, work.gain)
        covariance(view, P, P_after, work)

    return regain


@dataclass(slots=True, eq=False)
class Knot:
    """A measurement that is taken, in step k.

    sensor: its number; lands: the step in which it does; transition: from the knot before, None if it is of the same
    step. before, after: estimates of k, with the covariance that counts the knots before it, or it too. H (p, n), gain
    (p, n) = K^T, S (p, p), expected (numbers,): of the measurement; known (p,): what has landed since and was not
    expected. y, lost, delta: once it has arrived. share (n, p): of its innovation in the error of the last knot.
    """

    sensor: int
    lands: int
    transition: Transition | None
    before: Estimate
    after: Estimate
    H: FloatArray
    gain: FloatArray
    S: FloatArray
    expected: FloatArray
    known: FloatArray
    share: FloatArray
    y: FloatArray | None = None
    lost: Flags = field(default_factory=lambda: np.zeros(0, np.bool_))
    delta: FloatArray = field(default_factory=lambda: np.zeros(0))
    landed: bool = False


class Part:
    """What works on measurements of one sensor."""

    def __init__(self, composed: ModularFilter, sensor: Sensor, backend: BackendName) -> None:
        corrector = sensor.corrector
        covariance = covariance_of(composed.update, corrector.kind)
        self.observed = corrector.observed
        self.view = arguments_for(backend, corrector.view(composed.of.errors))
        self.work = new_workspace(composed.of, corrector.observed)
        self.take = function_for(backend, taking_by(corrector.expect, covariance))
        self.regain = function_for(backend, gain_again(covariance))
        self.joseph = function_for(backend, joseph)


class LowRate:
    """The knots from the first on that has not landed, and the last that has before it."""

    def __init__(self, composed: ModularFilter, P0: FloatArray, backend: BackendName) -> None:
        self._of = composed.of
        self._parts = [Part(composed, sensor, backend) for sensor in composed.sensors]
        self._work = new_workspace(composed.of, NOTHING)
        self._propagate = function_for(backend, lr_propagate)
        self._correct = function_for(backend, lr_correct)
        self._pass = function_for(backend, hr_pass)
        self._P = P0  # of the last knot, with it
        self._knots: deque[Knot] = deque()

    def take(self, sensor: int, lands: int, x: FloatArray, transition: Transition | None) -> Knot:
        """The next knot. x (numbers,): the state; transition: from the knot before."""
        part = self._parts[sensor]
        before, after = Estimate(x, self.carried(self._P, transition)), empty(self._of)
        part.take(part.view, part.observed, self._of, before, after, part.work)
        work, p = part.work, part.observed.errors
        H, gain, S, expected = (each.copy() for each in (work.H, work.gain, work.S, work.expected))
        if transition is not None:
            for knot in self._in_flight():
                knot.share = transition.Phi @ knot.share
        share = gain.T.copy()
        knot = Knot(sensor, lands, transition, before, after, H, gain, S, expected, np.zeros(p), share)
        self._knots.append(knot)
        self._P = after.P
        return knot

    def arrive(self, knot: Knot, y: FloatArray, lost: Flags) -> None:
        """Its measurement has."""
        p = self._parts[knot.sensor].observed.errors
        knot.y, knot.lost = y, lost[:p]
        self._tell(knot)

    def _tell(self, knot: Knot) -> None:
        part = self._parts[knot.sensor]
        assert knot.y is not None
        knot.delta = np.empty(self._of.errors)
        y = knot.y[: part.observed.numbers]
        self._correct(part.observed, y, knot.lost, knot.expected, knot.known, knot.gain, knot.delta, part.work)

    def landing(self, j: int) -> list[Knot]:
        """Those that land in step j and have arrived."""
        return [knot for knot in self._knots if knot.lands == j and knot.y is not None]

    def land(self, knot: Knot) -> FloatArray:
        """What this one tells of the error (n,) of the last knot."""
        place = self._knots.index(knot)
        behind = [*islice(self._knots, place + 1, None)]
        if knot.lost.any():
            self._lose(knot, behind)
        knot.landed = True
        delta = knot.delta.copy()
        for other in behind:
            self._go_past(other, delta)
        while len(self._knots) > 1 and self._knots[0].landed:
            self._knots.popleft()
        self._share_again()
        return delta

    def _go_past(self, knot: Knot, delta: FloatArray) -> None:
        known = np.empty_like(knot.known)
        gain = knot.gain if knot.landed else np.zeros_like(knot.gain)
        Phi = np.eye(self._of.errors) if knot.transition is None else knot.transition.Phi
        self._pass(Phi, knot.H, gain, delta, known, np.empty_like(delta))
        if not knot.landed:
            knot.known += known
            if knot.y is not None:
                self._tell(knot)

    def _lose(self, knot: Knot, behind: Sequence[Knot]) -> None:
        """The covariances from this knot on, and the gains of what has not landed."""
        self._gain_again(knot, knot.lost)
        P = knot.after.P
        for other in behind:
            other.before = other.before._replace(P=self.carried(P, other.transition))
            if other.landed:
                part = self._parts[other.sensor]
                copy(other.H, part.work.H)
                copy(other.gain, part.work.gain)
                part.joseph(part.view, other.before.P, other.after.P, part.work)
            else:
                self._gain_again(other, np.zeros(len(other.known), np.bool_))
            P = other.after.P
        self._P = P

    def _gain_again(self, knot: Knot, lost: Flags) -> None:
        part = self._parts[knot.sensor]
        copy(knot.H, part.work.H)
        part.regain(part.view, knot.before.P, lost, knot.after.P, part.work)
        knot.gain, knot.S = part.work.gain.copy(), part.work.S.copy()
        if knot.y is not None:
            self._tell(knot)

    def _in_flight(self) -> Iterator[Knot]:
        return (knot for knot in self._knots if not knot.landed)

    def _share_again(self) -> None:
        """Of all in flight, once one has landed."""
        for place, knot in enumerate(self._knots):
            share = knot.gain.T.copy()
            for other in islice(self._knots, place + 1, None):
                if other.transition is not None:
                    share = other.transition.Phi @ share
                if other.landed:
                    share = share - other.gain.T @ (other.H @ share)
            knot.share = share

    def carried(self, P: FloatArray, transition: Transition | None) -> FloatArray:
        """A covariance of the last knot, now."""
        if transition is None:
            return P
        P_next = np.empty_like(P)
        self._propagate(P, transition, P_next, self._work)
        return P_next

    def covariance(self, transition: Transition | None) -> FloatArray:
        """Of the error of the state now, for the history: P + sum of B S B^T over what is in flight."""
        P = self._P.copy()
        for knot in self._in_flight():
            P += knot.share @ knot.S @ knot.share.T
        return self.carried(0.5 * (P + P.T), transition)
