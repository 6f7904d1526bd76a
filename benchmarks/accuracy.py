"""Output covariances of very many designs, and doubling against one Riccati step after another; 9 states, one core."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from benchmarks.timing import Result, seconds, times_faster
from filters.accuracy import latest_landing, lossless_designs, shipped_model
from filters.accuracy.prefix import prefix
from filters.accuracy.riccati import steady_prior
from filters.arrays import FloatArray

DESIGNS = 1_000_000
PERIODS, OLDEST = 200, 600
FIXES_EVERY = 20
"""Steps between measurements where doubling is compared: 20 Hz."""


def results() -> Iterator[Result]:
    shipped = shipped_model("ins-gps")
    model, position = shipped.model(shipped.hr_hz), shipped.outputs["position"].states
    random = np.random.default_rng(0)
    N = random.integers(1, PERIODS + 1, DESIGNS)
    L = random.integers(0, OLDEST - PERIODS + 1, DESIGNS)
    yield Result(
        "accuracy: a million designs (N, L)",
        seconds(lambda: lossless_designs(model, position, N, L), repeats=3),
        2,
        higher=False,
        unit="s",
    )

    over = prefix(model, FIXES_EVERY)
    cycle = over.Phi[FIXES_EVERY], over.Q[FIXES_EVERY], model.H, model.R
    cycles = _cycles_to(steady_prior(*cycle), *cycle)
    yield Result(
        f"accuracy: doubling against {cycles} Riccati steps",
        times_faster(lambda: steady_prior(*cycle), lambda: _iterated(*cycle, cycles)),
        100,
    )
    yield Result(
        "accuracy: the latest landing within a bound",
        1000 * seconds(lambda: latest_landing(model, position, shipped.N, 0.38, shipped.M)),
        20,
        higher=False,
        unit="ms",
    )


def _cycles_to(settled: FloatArray, Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> int:
    """After so many cycles from Q, every variance has settled to a part in 10^10."""
    cycles = 1
    while (np.abs(np.diag(_iterated(Phi, Q, H, R, cycles)) / np.diag(settled) - 1) > 1e-10).any():
        cycles *= 2
    return cycles


def _iterated(Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray, cycles: int) -> FloatArray:
    P = Q
    for _ in range(cycles):
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        P = Phi @ (P - K @ H @ P) @ Phi.T + Q
        P = 0.5 * (P + P.T)
    return P
