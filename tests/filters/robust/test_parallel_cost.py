"""The time of schedules on P processors: Brent's bounds, and the figures of the reconstruction.

The reconstruction of the extended robust filter (its paper's formulas are lost) gives stages and times for an attitude
and a position filter. Its sparse figures were counted on numbers, with an exact test for zero; here they follow from
the pattern alone. Where numbers cancel exactly, the pattern still has an entry: it then needs up to 0.3 % more time,
and with a finite mu, where Phi is a diagonal plus a matrix of rank one, one stage more.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.robust.blocks import NATURAL, RECOMMENDED
from filters.robust.model import weights
from filters.robust.parallel import Pattern, Schedule, greedy, pivot_order, sameh_kuck
from filters.robust.parallel_cost import back_substitution_flops, flops, span_units, step_flops, time_units
from filters.robust.parallel_step import parallel_step_flops, step_pattern
from filters.robust.records import RobustModel

PROCESSORS = (1, 4, 16, 64, 256, 1024)
ORDERS = {"natural": NATURAL, "recommended": RECOMMENDED}
I, O, FULL = np.eye(3), np.zeros((3, 3)), np.ones((3, 3))


def row(length: int, *entries: int) -> Any:
    return np.isin(np.arange(length), entries).astype(np.float64)[np.newaxis]


def attitude(uncertain: tuple[int, ...] = (3, 4, 5), t2: int = 1) -> RobustModel:
    """Entries of the attitude filter, 1 for each that is not zero: Euler angles and gyroscope biases.

    Uncertain are the biases, the driving noises given, and the measured yaw.
    """
    T = np.array([[1.0, 1.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 1.0]])
    of_angles = np.array([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]])
    return RobustModel(
        F=np.block([[of_angles, T], [O, I]]), G=np.block([[T, O], [O, I]]), H=np.eye(3, 6), D=I, Q=np.eye(6), R=I,
        E_F=row(6, 3, 4, 5), E_G=row(6, *uncertain), E_H=row(6, 2)[:t2], E_D=row(3, 2)[:t2],
        M1=np.ones((6, 1)), M2=np.ones((3, 1)),
    )  # fmt: skip


def position(fix: bool = True, t2: int = 1) -> RobustModel:
    """The same of the position filter: latitude, longitude, height, velocities and accelerometer biases.

    Uncertain are the biases with their noises, and the measured velocities.
    """
    of_place = np.array([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 0.0, 1.0]])
    p = 6 if fix else 0
    return RobustModel(
        F=np.block([[of_place, I, O], [O, I, FULL], [O, O, I]]), G=np.block([[O, O], [FULL, O], [O, I]]),
        H=np.eye(p, 9), D=np.eye(p), Q=np.eye(6), R=np.eye(p),
        E_F=row(9, 6, 7, 8), E_G=row(6, 3, 4, 5), E_H=row(9, 3, 4, 5)[:t2], E_D=row(p, 3, 4, 5)[:t2],
        M1=np.ones((9, 1)), M2=np.ones((p, 1)),
    )  # fmt: skip


MODELS = {"attitude": attitude(), "position": position()}
ADDED = {"attitude": np.array([1.0, 1, 1, 0, 0, 0]), "position": np.array([1.0, 1, 0, 1, 1, 1, 0, 0, 0])}
"""Where f(x) - F x is not zero: biases decay linearly, and height changes so with the velocity down."""


def pattern_of(system: str, order: str = "natural", mu: float = np.inf) -> Pattern:
    model = MODELS[system]
    return step_pattern(model, weights(model, mu), ADDED[system], ORDERS[order])


def times(schedule: Schedule) -> list[int]:
    return [time_units(schedule, P) for P in PROCESSORS]


def rotations(schedule: Schedule) -> int:
    return sum(len(stage) for stage in schedule.stages)


def dense(N: int, columns: int | None = None) -> Pattern:
    return np.ones((N, columns or N), dtype=np.bool_)


@st.composite
def schedules(draw: st.DrawFn) -> Schedule:
    N = draw(st.integers(2, 12))
    random = np.random.default_rng(draw(st.integers(0, 2**31 - 1)))
    pattern = random.random((N, N + draw(st.integers(0, 3)))) < draw(st.floats(0.1, 1.0))
    return draw(st.sampled_from([greedy(pattern), pivot_order(pattern), sameh_kuck(N, pattern.shape[1] - N)]))


@given(schedule=schedules(), P=st.integers(1, 200))
def test_brents_bounds_hold(schedule: Schedule, P: int) -> None:
    T_1, T_P, T_inf = time_units(schedule, 1), time_units(schedule, P), span_units(schedule)
    assert max(T_1 / P, T_inf) <= T_P <= T_1 / P + T_inf
    assert time_units(schedule, 10**6) == T_inf
    assert flops(schedule, P) == 6 * T_P


@given(schedule=schedules(), n=st.integers(1, 9))
def test_one_processor_more_never_takes_longer(schedule: Schedule, n: int) -> None:
    cost = list(step_flops(schedule, n, range(1, 40)).values())
    assert cost == sorted(cost, reverse=True)


def test_a_schedule_in_hand() -> None:
    """Three dense rows: three stages of one rotation, of 3, 3 and 2 column pairs."""
    schedule = sameh_kuck(3)
    assert schedule.updates == (3, 3, 2)
    assert [time_units(schedule, P) for P in (1, 2, 3)] == [3 * 8 + 8, 3 * 8 + 5, 3 * 9]


@pytest.mark.parametrize(("n", "operations"), [(1, 2), (6, 252), (9, 810)])
def test_back_substitution(n: int, operations: int) -> None:
    """n (n - 1) / 2 multiplies and as many adds for each of n + 1 sides, and a division for each unknown of a side."""
    assert back_substitution_flops(n, 1) == operations
    assert back_substitution_flops(n, 10**6) == 3 * n - 2


def test_a_processor_is_needed() -> None:
    for cost in (time_units, flops):
        with pytest.raises(ValueError, match="P=0"):
            cost(sameh_kuck(3), 0)
    with pytest.raises(ValueError, match="P=-1"):
        back_substitution_flops(6, -1)


def test_what_parallel_devices_buy() -> None:
    cost = parallel_step_flops(attitude(), weights(attitude()), PROCESSORS)
    assert list(cost) == list(PROCESSORS)
    schedule = greedy(step_pattern(attitude(), weights(attitude())))
    assert cost[16] == 6 * time_units(schedule, 16) + back_substitution_flops(6, 16)
    assert 12 < cost[1] / cost[1024] < 14


@pytest.mark.parametrize(
    ("model", "N"),
    [(attitude(), 47), (attitude(t2=0), 46), (position(), 68), (position(t2=0), 67), (position(False, t2=0), 49)],
)
def test_sizes(model: RobustModel, N: int) -> None:
    for order in ORDERS.values():
        assert step_pattern(model, weights(model), order=order).shape == (N, N + len(model.F) + 1)


@pytest.mark.parametrize(
    ("N", "right_hand_sides", "stages", "most", "greedy_stages", "expected"),
    [
        (47, 7, 91, 23, 86, [50_807, 13_023, 3_623, 1_433, 942, 819]),
        (68, 10, 133, 34, 126, [145_792, 36_910, 9_690, 3_119, 1_631, 1_259]),
    ],
)
def test_reconstruction_dense(
    N: int, right_hand_sides: int, stages: int, most: int, greedy_stages: int, expected: list[int]
) -> None:
    """The reconstruction's figures for dense matrices, all exactly."""
    schedule = sameh_kuck(N, right_hand_sides)
    assert len(schedule.stages) == stages
    assert max(len(stage) for stage in schedule.stages) == most
    assert times(schedule) == expected
    assert len(greedy(dense(N)).stages) == greedy_stages
    assert rotations(greedy(dense(N))) == N * (N - 1) // 2


@pytest.mark.parametrize(
    ("system", "mu", "stages", "count"),
    [
        ("attitude", np.inf, 62, 363),
        ("attitude", 1.0, 62, 451),
        ("position", np.inf, 92, 707),
        ("position", 1.0, 92, 945),
    ],
)
def test_reconstruction_critical_path(system: str, mu: float, stages: int, count: int) -> None:
    """The reconstruction's critical path and rotations in pivot-row order; one rotation more by pattern in one case."""
    schedule = pivot_order(pattern_of(system, mu=mu))
    assert len(schedule.stages) == stages
    assert 0 <= rotations(schedule) - count <= 1


@pytest.mark.parametrize(
    ("system", "order", "stages", "count", "expected"),
    [
        ("attitude", "natural", 42, 263, [6_684, 1_856, 641, 427, 378, 378]),
        ("attitude", "recommended", 29, 162, [3_344, 957, 374, 282, 261, 261]),
        ("position", "natural", 63, 565, [18_559, 4_780, 1_425, 759, 595, 567]),
        ("position", "recommended", 46, 354, [9_152, 2_461, 795, 493, 414, 414]),
    ],
)
def test_reconstruction_sparse(system: str, order: str, stages: int, count: int, expected: list[int]) -> None:
    """The reconstruction's times on the sparse matrices, mu infinite: attitude exactly, position within 0.3 %.

    Rotations in the recommended order are not in the reconstruction; they are those of its pairing on numbers.
    """
    schedule = greedy(pattern_of(system, order))
    assert len(schedule.stages) == stages
    if system == "attitude":
        assert (rotations(schedule), times(schedule)) == (count, expected)
    else:
        assert 0 <= rotations(schedule) - count <= 1
        np.testing.assert_allclose(times(schedule), expected, rtol=0.003)


@pytest.mark.parametrize(
    ("system", "order", "stages"),
    [
        ("attitude", "natural", 44),
        ("attitude", "recommended", 32),
        ("position", "natural", 63),
        ("position", "recommended", 51),
    ],
)
def test_reconstruction_sparse_with_a_finite_mu(system: str, order: str, stages: int) -> None:
    """The reconstruction's numbers of stages; by pattern one more in the natural order."""
    assert 0 <= len(greedy(pattern_of(system, order, mu=1.0)).stages) - stages <= (order == "natural")


@pytest.mark.parametrize("system", MODELS)
def test_sparsity_buys_more_than_processors(system: str) -> None:
    sparse = greedy(pattern_of(system, "recommended"))
    N, columns = pattern_of(system).shape
    assert time_units(sparse, 4) < time_units(sameh_kuck(N, columns - N), 16)
