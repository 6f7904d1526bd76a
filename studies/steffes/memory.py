"""Steffes (2014), Sec. III.C: whether Larsen's method and the dual-rate filter take equal memory, as C for a board."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.systems.example import example_system
from sched_sim.design.timing import Timing
from studies.board.steps import Steps
from studies.board.wanted import Filter
from studies.board.write import array_sizes

STATES, INPUTS, MEASUREMENTS = 9, 3, 3
TIMING = Timing(10, 4, 8)
SQUARE = STATES * STATES


class Memory(NamedTuple):
    """Numbers in the arrays that a method keeps in RAM; the model and the record of measurements are not in it.

    states: vectors of n; P, Phi, Q: how many n x n matrices of each; correction: z, K, delta x; scratch: what jobs use
    within themselves; total: of all.
    """

    method: str
    states: int
    P: int
    Phi: int
    Q: int
    correction: int
    scratch: int
    total: int

    @property
    def matrices(self) -> int:
        """Kept from job to job."""
        return self.P + self.Phi + self.Q


def memory(method: str) -> Memory:
    """Of "larsen" or "dual-rate", as `sched-sim code` writes it: textbook update, the paper's sizes and first case."""
    L = TIMING.L if method == "dual-rate" else TIMING.M
    wanted = Filter(
        *(method, example_system(STATES, INPUTS, MEASUREMENTS), np.zeros(STATES), "textbook", "double"),
        Steps(TIMING.N, TIMING.M, L),
        "",
    )
    sizes = array_sizes(wanted)

    def of(name: str) -> int:
        return sum(size for array, size in sizes.items() if "_work_" not in array and array.endswith(f"_{name}"))

    correction = sum(size for array, size in sizes.items() if "_correction_" in array)
    scratch = sum(size for array, size in sizes.items() if "_work_" in array)
    squares = {name: of(name) // SQUARE for name in ("P", "Phi", "Q")}
    states = sum(sizes.values()) - correction - scratch - SQUARE * sum(squares.values())
    return Memory(
        method, states // STATES, **squares, correction=correction, scratch=scratch, total=sum(sizes.values())
    )
