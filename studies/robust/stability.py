"""Is the robust filter stable on linear systems, and does it converge? Tried where theory says so, and beyond.

"For linear systems, stability and convergence are guaranteed for all steady-state estimates", says "Computation of
Extended Robust Kalman Filter for Real-Time Attitude and Position Estimation" (arXiv:1801.04386), section 1. Stable:
the spectral radius of the closed loop, from one estimate to the next, is below 1. Convergent: from any start P comes to
the same matrix, and estimates from different starts come together. Both hold in every system that is tried, with a
finite mu and in the limit, mu = inf, if rounding is kept out of it. There each uncertain row ties a noise down; where
none is left over, eigenvalues of the filter are those of the system with its noise tied, or their inverses where those
are unstable, and P comes to a singular matrix, of which double precision may leave no covariance.

What neither is: a bound on the error. Where the system itself is unstable, the error of the robust filter grows with
the state, for the filter takes its model to be wrong in proportion to it; the Kalman filter's does not.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.robust.records import Predicted, RobustModel
from filters.robust.run import run
from filters.robust.step import step
from studies.robust.linear import Linear, random_system, spectral_radius
from studies.robust.precise import CLOSE, steady_state

STARTS = (1e-2, 1.0, 1e4)
"""P begins as so many times the unit matrix."""
STEPS, LONG = 60, 2000


class Stability(NamedTuple):
    """radius: spectral radius of the closed loop in the steady state; of_system: of F. steps: after which P from every
    start is within `CLOSE` of the others, relatively. error (2,): root mean square of the error, all states, in steps
    50 and 200, where nothing is wrong with the model. wrong: in step 200, where F is wrong by as much as the uncertain
    row of the robust filters allows, up or down, whichever is worse."""

    radius: float
    of_system: float
    steps: int
    error: FloatArray
    wrong: float


class Convergence(NamedTuple):
    """largest (starts, steps + 1): the largest singular value of P by start. apart (steps + 1,): the distance of two
    estimates that begin apart, of their distance at first."""

    largest: FloatArray
    apart: FloatArray


class Sample(NamedTuple):
    """Random systems. kept: in how many both hold, in a hundred digits; steps: after how many at most, looked at after
    64, 128, ...; radius: the largest of these. stopped: in how many the filter in double precision stops, from the
    smallest or the largest start, within `LONG` steps; that hangs on rounding."""

    name: str
    systems: int
    kept: int
    steps: int
    radius: float
    stopped: int


def stability(case: Linear) -> Stability:
    """In the steady state, and on the way to it."""
    n, p = len(case.model.F), len(case.model.H)
    found = [run(case.model, np.zeros(n), start * np.eye(n), np.zeros((LONG, p)), mu=case.mu).P for start in STARTS]
    spread = np.max([_distance(each, found[0]) for each in found], axis=0)
    together = int(np.flatnonzero(spread > CLOSE)[-1]) + 1
    closed, gain = closed_loop(case.model, found[0][-1], case.mu)
    right = _errors(case.model, case.model.F, closed, gain)
    wrong = max(float(_errors(case.model, case.model.F + sign * case.off, closed, gain)[1]) for sign in (-1, 1))
    return Stability(spectral_radius(closed), spectral_radius(case.model.F), together, right, wrong)


def convergence(case: Linear) -> Convergence:
    """From each of the starts; the estimates begin at 0 and at (1, ..., 1), with P as the second."""
    n, p = len(case.model.F), len(case.model.H)
    silent = np.zeros((STEPS, p))
    largest = [
        np.linalg.norm(run(case.model, np.zeros(n), start * np.eye(n), silent, mu=case.mu).P, 2, axis=(1, 2))
        for start in STARTS
    ]
    away = run(case.model, np.ones(n), np.eye(n), silent, mu=case.mu).x
    here = run(case.model, np.zeros(n), np.eye(n), silent, mu=case.mu).x
    apart = np.linalg.norm(away - here, axis=1)
    return Convergence(np.array(largest), apart / apart[0])


def sample(name: str, mu: float, noises: int, systems: int = 1000) -> Sample:
    """Random systems of 1 to 4 states, stable and not, with one uncertain row and so many noises.

    Both hold where P from the smallest and from the largest start is one, and the spectral radius there is below 1.
    """
    models = [random_system(seed, noises) for seed in range(systems)]
    steady = [steady_state(model, mu, (STARTS[0], STARTS[-1])) for model in models]
    kept = [(each.steps, radius) for each in steady if each and (radius := spectral_radius(each.closed)) < 1]
    stopped = sum(_stops(model, mu) for model in models)
    return Sample(name, systems, len(kept), max(s for s, _ in kept), max(radius for _, radius in kept), stopped)


def closed_loop(model: RobustModel, P: FloatArray, mu: float) -> tuple[FloatArray, FloatArray]:
    """How the next estimate depends on the last (n, n) and on the measurement (n, p): a step is linear in both."""
    n, p = len(model.F), len(model.H)

    def following(x: FloatArray, y: FloatArray) -> FloatArray:
        return step(model, Predicted(x, P), y, np.zeros(n), mu=mu).x

    closed = np.column_stack([following(unit, np.zeros(p)) for unit in np.eye(n)])
    gain = np.column_stack([following(np.zeros(n), unit) for unit in np.eye(p)])
    return closed, gain


def _distance(P: FloatArray, other: FloatArray) -> FloatArray:
    """Of two histories (steps + 1, n, n), relatively, in each step."""
    scale = np.abs(other).max(axis=(1, 2), initial=1e-300)
    far: FloatArray = np.abs(P - other).max(axis=(1, 2)) / scale
    return far


def _errors(model: RobustModel, F: FloatArray, closed: FloatArray, gain: FloatArray) -> FloatArray:
    """By the joint covariance of state and estimate, from x = 0 and its estimate 0, where F is the true one."""
    n = len(model.F)
    both = np.block([[F, np.zeros((n, n))], [gain @ model.H, closed]])
    noise = np.block(
        [
            [model.G @ model.Q @ model.G.T, np.zeros((n, n))],
            [np.zeros((n, n)), gain @ model.D @ model.R @ model.D.T @ gain.T],
        ]
    )
    difference = np.hstack([np.eye(n), -np.eye(n)])
    covariance, found = np.zeros((2 * n, 2 * n)), []
    for _ in range(200):
        covariance = both @ covariance @ both.T + noise
        found.append(float(np.sqrt(np.trace(difference @ covariance @ difference.T))))
    return np.array([found[49], found[199]])


def _stops(model: RobustModel, mu: float) -> bool:
    """Whether rounding leaves no covariance in some step."""
    n, silent = len(model.F), np.zeros((LONG, len(model.H)))
    try:
        for start in (STARTS[0], STARTS[-1]):
            run(model, np.zeros(n), start * np.eye(n), silent, mu=mu, backend="compiled")
    except ValueError:
        return True
    return False
