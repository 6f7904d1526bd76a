"""Random estimation problems: stable systems, N up to 30 with every legal M and L, edges included, and their data."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.simulation import simulate_truth
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system

Landing = Literal["at-arrival", "next-step", "same-step"]
"""When a correction reaches the state: in step m itself, or in step l with one of the dual-rate feedbacks."""

seeds = st.integers(0, 2**31 - 1)
sizes = st.integers(1, 5)


class Problem(NamedTuple):
    """Everything that a filter run takes, in its order."""

    system: System
    N: int
    M: int
    L: int
    x0: FloatArray
    P0: FloatArray
    inputs: FloatArray
    measurements: FloatArray


@st.composite
def systems(draw: st.DrawFn) -> System:
    """Random stable time-varying linear systems of up to 5 states."""
    return example_system(draw(sizes), draw(st.integers(1, 3)), draw(st.integers(1, 3)), draw(seeds))


@st.composite
def problems(draw: st.DrawFn, landing: Landing) -> Problem:
    """Between one and four cycles of data from a random system."""
    N = draw(st.sampled_from([1, 2]) | st.integers(1, 30))
    latest_M = N if landing == "at-arrival" else N - 1
    M = draw(_edges_or_between(0, latest_M))
    if landing == "at-arrival":
        L = M
    elif landing == "next-step":
        L = draw(_edges_or_between(M + 1, N))
    else:
        L = draw(_edges_or_between(M, N - 1))
    steps = draw(st.integers(0, 3 * N + 2))
    return problem(draw(systems()), N, M, L, steps, draw(seeds))


def problem(system: System, N: int, M: int, L: int, steps: int, seed: int) -> Problem:
    """Data from `system` with normal inputs and a start of unit covariance."""
    random = np.random.default_rng(seed)
    x0, P0 = random.normal(size=system.states), np.eye(system.states)
    inputs = random.normal(size=(steps, system.inputs))
    truth = simulate_truth(system, N, x0, P0, inputs, seed)
    return Problem(system, N, M, L, x0, P0, inputs, truth.measurements)


def _edges_or_between(first: int, last: int) -> st.SearchStrategy[int]:
    return st.sampled_from([first, last]) | st.integers(first, last)


def unstable_system(seed: int) -> System:
    """A random constant linear system of 4 states, 1 input and 2 measurements, with eigenvalues beyond 1."""
    random = np.random.default_rng(seed)
    Phi = random.normal(size=(4, 4))
    Phi *= random.uniform(1.02, 1.3) / np.abs(np.linalg.eigvals(Phi)).max()
    roots = random.normal(size=(4, 4)), random.normal(size=(2, 2))
    Q, R = (root @ root.T / len(root) + 0.1 * np.eye(len(root)) for root in roots)
    return linear_system(Phi, random.normal(size=(4, 1)), random.normal(size=(2, 4)), Q, R)
