"""A short record of data, and the states that Python makes of it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.registry import ALL_METHODS, MULTIRATE_METHODS
from filters.simulation import simulate_truth
from filters.system import System
from filters.translation.data import Data, Kept
from filters.translation.library import Precision
from filters.translation.unit import Unit
from studies.board.steps import Steps
from studies.board.template import filled
from studies.board.wanted import Filter

CYCLES, SEED = 3, 0
"""Measurements of a record, of which all have landed at its end; and that of its random numbers."""


class Record(NamedTuple):
    """x0 (n,), P0 (n, n); u (steps, m): from j to j + 1; y (measured, p): of k = 0, N, 2N, ...; x (steps + 1, n):
    Python's states."""

    x0: FloatArray
    P0: FloatArray
    u: FloatArray
    y: FloatArray
    x: FloatArray


def simulated(wanted: Filter, steps: Steps) -> Record:
    """A record from x0 with unit covariance and normal inputs, as the jobs that are costed have it.

    Numbers are those that the program has, also in single precision; the states are always computed in double.
    Raises ValueError where the system cannot be filtered from there.
    """
    method, system, x0, update, precision = wanted[:5]
    N, M, L = steps
    each = method in MULTIRATE_METHODS
    measured = CYCLES + M // N
    number = (measured - 1) * N + L
    P0 = np.eye(system.states)
    u = np.random.default_rng(SEED).normal(size=(number, system.inputs))
    truth = simulate_truth(system, 1 if each else N, x0, P0, u, SEED)
    y = truth.measurements if each else truth.measurements[:measured]
    x0, u, y = (held(values, precision) for values in (x0, u, y))

    def states(system: System) -> FloatArray:
        if each:
            return MULTIRATE_METHODS[method].run(system, N, x0, P0, u, y, L=L, update=update).x
        return ALL_METHODS[method].run(system, N, M, L, x0, P0, u, y, update=update, **wanted.choices).x

    if system.structure is not None:  # is seen to be as stated
        states(system)
    return Record(x0, P0, u, y, states(system._replace(structure=None)))


def record_h(record: Record, precision: Precision) -> str:
    """The record as a header."""
    data = Data(Unit(precision))
    for name, values in record._asdict().items():
        if values.size:
            data.array(Kept(f"record_{name}"), values)
    enum = f"RECORD_STEPS = {len(record.u)}, RECORD_MEASURED = {len(record.y)}"
    return filled("record.h", {"enum": enum, "data": "\n".join(data.lines)})


def held(values: FloatArray, precision: Precision) -> FloatArray:
    return values if precision == "double" else values.astype(np.float32).astype(np.float64)
