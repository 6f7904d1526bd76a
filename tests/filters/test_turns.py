"""A model that fills memory of its own filters like one that makes new matrices, or is told what is wrong."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.delayed import dual_rate, larsen, recalculate, standard
from filters.system import System
from filters.systems.navigation import simulate_drive, vehicle


class Memory(NamedTuple):
    F: FloatArray
    Q: FloatArray
    H: FloatArray


class Parameters(NamedTuple):
    of: Any
    scratch: Memory


def filling(in_turn: int) -> System:
    """The vehicle, whose F and Q fill so many matrices in turn, and H one."""
    made = vehicle()

    def into(memory: FloatArray, matrix: FloatArray) -> FloatArray:
        memory[...] = matrix
        return memory

    return System(
        *made[:3],
        f=lambda j, x, u, p, out: made.f(j, x, u, p.of, out),
        F=lambda j, x, u, p: into(p.scratch.F[j % in_turn], made.F(j, x, u, p.of)),
        Q=lambda j, p: into(p.scratch.Q[j % in_turn], made.Q(j, p.of)),
        h=lambda k, x, p, out: made.h(k, x, p.of, out),
        H=lambda k, x, p: into(p.scratch.H, made.H(k, x, p.of)),
        R=lambda k, p: made.R(k, p.of),
        parameters=Parameters(
            made.parameters, Memory(np.zeros((in_turn, 6, 6)), np.zeros((in_turn, 6, 6)), np.zeros((2, 6)))
        ),
    )


@pytest.mark.parametrize("run", [standard.run, recalculate.run, larsen.run, dual_rate.run])
@pytest.mark.parametrize(("N", "M", "L"), [(1, 0, 1), (2, 1, 2), (3, 1, 3), (3, 2, 3), (5, 4, 5)])
def test_two_in_turn_filter_as_new_ones_do(run: Callable[..., Any], N: int, M: int, L: int) -> None:
    drive = simulate_drive(30, N, seed=0)
    data = N, M, L, drive.x0, drive.P0, drive.inputs, drive.truth.measurements
    np.testing.assert_array_equal(run(filling(2), *data).x, run(vehicle(), *data).x)


@pytest.mark.parametrize("noise", ["sum", "euler"])
def test_with_any_low_rate_noise(noise: str) -> None:
    drive = simulate_drive(30, 5, seed=0)
    data = 5, 2, 4, drive.x0, drive.P0, drive.inputs, drive.truth.measurements
    filled, made = (dual_rate.run(system, *data, low_rate_noise=noise).x for system in (filling(2), vehicle()))  # type: ignore[arg-type]
    np.testing.assert_array_equal(filled, made)


@pytest.mark.parametrize("noise", ["exact", "sum", "euler"])
@pytest.mark.parametrize(("N", "M", "L"), [(3, 1, 2), (1, 2, 3), (2, 3, 4)])
def test_what_is_read_behind_the_next_step_is_kept(noise: str, N: int, M: int, L: int) -> None:
    """The first half of Eq. (24), and with several corrections on their way the transition over a cycle of one step."""
    drive = simulate_drive(30, N, seed=0)
    data = N, M, L, drive.x0, drive.P0, drive.inputs, drive.truth.measurements
    filled, made = filling(2), vehicle()
    Q = np.zeros((2, 6, 6))

    def growing(j: int, p: Any) -> FloatArray:
        Q[j % 2] = (1 + j % 5) * made.Q(j, p.of)
        return Q[j % 2]  # type: ignore[no-any-return]

    ours = filled._replace(Q=growing)
    theirs = made._replace(Q=lambda j, p: (1 + j % 5) * made.Q(j, p))
    expected = dual_rate.run(theirs, *data, low_rate_noise=noise).x  # type: ignore[arg-type]
    np.testing.assert_array_equal(dual_rate.run(ours, *data, low_rate_noise=noise).x, expected)  # type: ignore[arg-type]


@pytest.mark.parametrize("run", [standard.run, recalculate.run, larsen.run, dual_rate.run])
def test_one_for_all_steps_is_refused(run: Callable[..., Any]) -> None:
    drive = simulate_drive(6, 3, seed=0)
    with pytest.raises(ValueError, match=r"F\(j, x, u, p\) fills in step 1 the matrix .* such as p.scratch.F\[j % 2\]"):
        run(filling(1), 3, 2, 3, drive.x0, drive.P0, drive.inputs, drive.truth.measurements)


def test_the_noise_too() -> None:
    drive = simulate_drive(6, 3, seed=0)
    system = filling(1)._replace(F=lambda j, x, u, p: vehicle().F(j, x, u, p.of))
    with pytest.raises(ValueError, match=r"Q\(j, p\) fills in step 1 .* such as p.scratch.Q\[j % 2\]"):
        dual_rate.run(system, 3, 2, 3, drive.x0, drive.P0, drive.inputs, drive.truth.measurements)


def test_what_is_looked_at_stays_as_it_was() -> None:
    system = vehicle()
    before = system.parameters.Q.copy()
    drive = simulate_drive(6, 3, seed=0, system=system)
    standard.run(system, 3, 2, 3, drive.x0, drive.P0, drive.inputs, drive.truth.measurements)
    np.testing.assert_array_equal(system.parameters.Q, before)
