"""A model as a user writes it, a pendulum, and a short run of a filter with it: `python -m benchmarks.own_model c`.

Prints the seconds until the result is there, the import of the library apart.
"""

from __future__ import annotations

import sys
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from filters.delayed import dual_rate
from filters.system import System

DT, GRAVITY = 0.005, 9.81  # s, m/s^2 at a length of 1 m


class Scratch(NamedTuple):
    F: Any  # (2, 2, 2), two in turn
    H: Any  # (1, 2)


class Parameters(NamedTuple):
    Q: Any  # (2, 2)
    R: Any  # (1, 1)
    scratch: Scratch


def f(_j: int, x: Any, u: Any, _p: Parameters, out: Any) -> None:  # angle (rad) and rate (rad/s) one step later
    out[0] = x[0] + DT * x[1]
    out[1] = x[1] + DT * (u[0] - GRAVITY * np.sin(x[0]))


def F(j: int, x: Any, _u: Any, p: Parameters) -> Any:
    Phi = p.scratch.F[j % 2]
    Phi[0, 0] = Phi[1, 1] = 1.0
    Phi[0, 1] = DT
    Phi[1, 0] = -DT * GRAVITY * np.cos(x[0])
    return Phi


def h(_k: int, x: Any, _p: Parameters, out: Any) -> None:
    out[0] = np.sin(x[0])


def H(_k: int, x: Any, p: Parameters) -> Any:
    p.scratch.H[0, 0] = np.cos(x[0])
    p.scratch.H[0, 1] = 0.0
    return p.scratch.H


def Q(_j: int, p: Parameters) -> Any:
    return p.Q


def R(_k: int, p: Parameters) -> Any:
    return p.R


def pendulum() -> System:
    parameters = Parameters(np.diag([1e-8, 1e-5]), np.array([[1e-4]]), Scratch(np.zeros((2, 2, 2)), np.zeros((1, 2))))
    return System(states=2, inputs=1, measurements=1, f=f, F=F, Q=Q, h=h, H=H, R=R, parameters=parameters)


if __name__ == "__main__":
    start = perf_counter()
    dual_rate.run(
        pendulum(), 10, 4, 8, np.zeros(2), np.eye(2), np.zeros((40, 1)), np.zeros((5, 1)), backend=sys.argv[1]
    )
    print(perf_counter() - start)
