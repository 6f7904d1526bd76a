"""A covariance kept as factors against one kept as it is, compiled: 8 states, 4 measurements, propagation and update.

The conventional one multiplies in the form that does the least work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from benchmarks.timing import Result, repeated, seconds
from filters.arrays import FloatArray
from filters.factored import FactoredFormName, factored_form
from filters.factored.workspace import new_factored_workspace
from filters.systems.example import example_system

STATES, MEASUREMENTS = 8, 4
ROUNDS = 61


def results() -> Iterator[Result]:
    runs = {name: (_propagation(name), _update(name)) for name in ("conventional", "square-root", "u-d")}
    least = {name: [float("inf")] * len(pair) for name, pair in runs.items()}
    for _ in range(ROUNDS):
        for name, pair in runs.items():
            for index, run in enumerate(pair):
                least[name][index] = min(least[name][index], seconds(run, 1))
    for name in ("square-root", "u-d"):
        yield Result(
            f"propagation and update, {name}: time beside conventional",
            sum(least[name]) / sum(least["conventional"]),
            3,
            higher=False,
        )


def _propagation(name: FactoredFormName) -> Callable[[], None]:
    form, system = factored_form(name, "short"), example_system(STATES, 1, MEASUREMENTS)
    Phi, Q = system.parameters.Phi[0], system.parameters.Q[0]
    return repeated(form.propagation, Phi, _factors(name, Q), Q, np.empty_like(Q), new_factored_workspace(system))


def _update(name: FactoredFormName) -> Callable[[], None]:
    form, system = factored_form(name, "short"), example_system(STATES, 1, MEASUREMENTS)
    H, R, Q = system.parameters.H[0], system.parameters.R[0], system.parameters.Q[0]
    K, out = np.empty((STATES, MEASUREMENTS)), np.empty_like(Q)
    return repeated(form.update, _factors(name, Q), H, R, K, out, new_factored_workspace(system))


def _factors(name: FactoredFormName, Q: FloatArray) -> FloatArray:
    factors = np.zeros_like(Q)
    factored_form(name).factor(np.eye(len(Q)) + Q, factors)
    return factors
