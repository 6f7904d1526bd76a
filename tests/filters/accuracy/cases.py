"""Models whose accuracy is known, and random ones."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from filters.accuracy import LinearModel, linear_model, shipped_model
from filters.accuracy.periodic import steady
from filters.accuracy.prefix import prefix
from filters.arrays import FloatArray

SCALAR = linear_model([[1]], [[0.01]], [[1]], [[1]])
CV = linear_model([[1, 1], [0, 1]], 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1]]), [[1, 0]], [[1]])
INS = shipped_model("ins-gps").model(400.0)
POSITION = [0, 1, 2]


def random_model(seed: int, radius: float, states: int, measurements: int) -> LinearModel:
    """Its transition has this spectral radius; all that there is, is seen and disturbed."""
    random = np.random.default_rng(seed)
    Phi = random.normal(size=(states, states))
    Phi *= radius / np.abs(np.linalg.eigvals(Phi)).max()
    H = random.normal(size=(measurements, states))
    return linear_model(Phi, _covariance(random, states), H, _covariance(random, measurements))


def _covariance(random: np.random.Generator, size: int) -> FloatArray:
    root = random.normal(size=(size, size))
    return np.asarray(root @ root.T / size + 0.1 * np.eye(size))


@st.composite
def models(draw: st.DrawFn) -> LinearModel:
    """Stable and unstable, of up to 4 states and 2 measurements."""
    radius = draw(st.sampled_from([0.5, 0.9, 1.0, 1.05, 1.15]))
    return random_model(draw(st.integers(0, 2**31 - 1)), radius, draw(st.integers(1, 4)), draw(st.integers(1, 2)))


def all_outputs(model: LinearModel) -> FloatArray:
    return np.eye(model.states)


def seen_well(model: LinearModel, N: int) -> bool:
    """Whether no mode is nearly unseen with a measurement every N steps: then its variance is large, and as many digits
    of it are lost in rounding."""
    before = steady(model, all_outputs(model), N, 0).before[0]
    return bool(np.trace(before) < 100 * np.trace(prefix(model, N).Q[N]))


def conditioned(model: LinearModel, before: FloatArray, N: int, age: int, cycles: int) -> FloatArray:
    """The covariance of x given measurements in steps 0, N, 2 N, ..., `cycles` of them, `age` steps after the last.

    By conditioning the joint Gaussian of all noises, stacked: x_0 of covariance `before`, each w and each nu.
    """
    n, p = model.states, len(model.H)
    end = (cycles - 1) * N + age
    size = n + end * n + cycles * p
    covariance = np.zeros((size, size))
    covariance[:n, :n] = before
    for j in range(end):
        at = slice(n + j * n, n + (j + 1) * n)
        covariance[at, at] = model.Q
    x = np.zeros((n, size))
    x[:, :n] = np.eye(n)
    y = np.zeros((cycles * p, size))
    for j in range(end + 1):
        if j % N == 0 and j // N < cycles:
            of = slice(j // N * p, (j // N + 1) * p)
            noise = slice(n + end * n + of.start, n + end * n + of.stop)
            y[of] = model.H @ x
            y[of, noise] += np.eye(p)
            covariance[noise, noise] = model.R
        if j < end:
            x = model.Phi @ x
            x[:, n + j * n : n + (j + 1) * n] += np.eye(n)
    both = x @ covariance @ y.T
    return np.asarray(x @ covariance @ x.T - both @ np.linalg.solve(y @ covariance @ y.T, both.T))
