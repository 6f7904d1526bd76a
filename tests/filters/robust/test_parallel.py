"""Schedules of rotations: their stages, and that carrying them out makes a matrix triangular."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.robust.parallel import Pattern, Rotation, Schedule, execute, greedy, pivot_order, sameh_kuck

seeds = st.integers(0, 2**31 - 1)
each_rule = pytest.mark.parametrize("rule", [greedy, pivot_order])


@st.composite
def patterns(draw: st.DrawFn, regular: bool = False) -> Pattern:
    """(N, N + r), N up to 12, of any density; regular: entries that make almost every matrix of it non-singular."""
    N, sides = draw(st.integers(1, 12)), draw(st.integers(0, 3))
    random = np.random.default_rng(draw(seeds))
    pattern = random.random((N, N + sides)) < draw(st.floats(0.0, 1.0))
    if regular:
        pattern[np.arange(N), random.permutation(N)] = True
    return pattern


def filled(pattern: Pattern, seed: int) -> Any:
    return np.where(pattern, np.random.default_rng(seed).normal(size=pattern.shape), 0.0)


def check_triangularisation(schedule: Schedule, A: Any) -> None:
    """An upper triangle that is Q^T A: R^T R = A^T A."""
    R = execute(schedule, A)
    assert not np.tril(R, -1).any()
    np.testing.assert_allclose(R.T @ R, A.T @ A, rtol=0.0, atol=1e-12 * (1.0 + np.abs(A.T @ A).max()))


def check_equal_to_qr(schedule: Schedule, A: Any, tolerance: float = 1e-9) -> None:
    N = len(A)
    expected = np.linalg.qr(A[:, :N]).R
    if np.abs(np.diag(expected)).min() > 1e-3:
        np.testing.assert_allclose(np.abs(execute(schedule, A)[:, :N]), np.abs(expected), rtol=0.0, atol=tolerance)


def rows_of(stage: tuple[Rotation, ...]) -> list[int]:
    return [row for rotation in stage for row in (rotation.upper, rotation.lower)]


def check_disjoint(schedule: Schedule) -> None:
    for stage, updates in zip(schedule.stages, schedule.updates, strict=True):
        assert stage
        assert len(set(rows_of(stage))) == 2 * len(stage)
        assert updates >= len(stage)


@given(N=st.integers(2, 14), sides=st.integers(0, 3), seed=seeds)
def test_sameh_and_kuck_triangularise_any_dense_matrix(N: int, sides: int, seed: int) -> None:
    schedule = sameh_kuck(N, sides)
    A = filled(np.ones((N, N + sides), dtype=np.bool_), seed)
    check_disjoint(schedule)
    check_triangularisation(schedule, A)
    check_equal_to_qr(schedule, A)
    assert sum(len(stage) for stage in schedule.stages) == N * (N - 1) // 2
    assert len(schedule.stages) == 2 * N - 3


def test_sameh_and_kuck_of_four_rows() -> None:
    assert [[(i, j) for _, i, j in stage] for stage in sameh_kuck(4).stages] == [
        [(3, 0)],
        [(2, 0)],
        [(1, 0), (3, 1)],
        [(2, 1)],
        [(3, 2)],
    ]


@each_rule
@given(pattern=patterns(), seed=seeds)
def test_a_schedule_triangularises_every_matrix_of_its_pattern(rule: Any, pattern: Pattern, seed: int) -> None:
    schedule = rule(pattern)
    check_disjoint(schedule)
    check_triangularisation(schedule, filled(pattern, seed))


@each_rule
@given(pattern=patterns(), seed=seeds)
def test_so_it_does_with_zeros_that_the_pattern_does_not_know(rule: Any, pattern: Pattern, seed: int) -> None:
    known = pattern & (np.random.default_rng(seed).random(pattern.shape) < 0.6)
    check_triangularisation(rule(pattern), filled(known, seed))


@each_rule
@given(pattern=patterns(regular=True), seed=seeds)
def test_the_triangle_is_that_of_qr_but_for_signs(rule: Any, pattern: Pattern, seed: int) -> None:
    check_equal_to_qr(rule(pattern), filled(pattern, seed))


@given(pattern=patterns())
def test_greedy_waits_only_for_rows(pattern: Pattern) -> None:
    """No rotation could have been done a stage earlier: one of its rows was busy, or not yet in its column."""
    for earlier, stage in pairwise(greedy(pattern).stages):
        assert all({rotation.upper, rotation.lower} & set(rows_of(earlier)) for rotation in stage)


@each_rule
def test_a_triangle_needs_nothing(rule: Any) -> None:
    assert rule(np.triu(np.ones((5, 7), dtype=np.bool_))) == Schedule((), (), tuple(range(5)))


def test_rows_in_the_wrong_order_need_no_rotation_but_are_exchanged() -> None:
    A = np.array([[0.0, 0.0, 3.0], [2.0, 0.0, 1.0], [0.0, 4.0, 1.0]])
    schedule = greedy(A != 0.0)
    assert schedule.stages == ()
    np.testing.assert_array_equal(execute(schedule, A), A[[1, 2, 0]])


@pytest.mark.parametrize("rule", [greedy, pivot_order, lambda pattern: sameh_kuck(len(pattern), 3)])
def test_no_overflow_and_no_underflow(rule: Any) -> None:
    A = filled(np.ones((6, 9), dtype=np.bool_), 1)
    schedule = rule(np.ones((6, 9), dtype=np.bool_))
    for scale in (1e-300, 1e300):
        np.testing.assert_allclose(execute(schedule, scale * A) / scale, execute(schedule, A), rtol=1e-9, atol=1e-12)


def test_the_matrix_is_left_as_it_is() -> None:
    A = filled(np.ones((4, 4), dtype=np.bool_), 2)
    before = A.copy()
    execute(sameh_kuck(4), A)
    np.testing.assert_array_equal(A, before)


def test_a_matrix_that_does_not_fit_is_refused() -> None:
    sparse = greedy(np.eye(3, dtype=np.bool_))
    with pytest.raises(ValueError, match="entries where the pattern"):
        execute(sparse, np.ones((3, 3)))
    with pytest.raises(ValueError, match=r"\(2, 3\), the schedule needs \(3, 3 or more\)"):
        execute(sparse, np.ones((2, 3)))
    with pytest.raises(ValueError, match="not finite"):
        execute(sparse, np.diag([1.0, np.nan, 1.0]))
    with pytest.raises(ValueError, match="N=0"):
        sameh_kuck(0)
    for rule in (greedy, pivot_order):
        with pytest.raises(ValueError, match="as many columns as rows"):
            rule(np.ones((3, 2), dtype=np.bool_))


@settings(deadline=None, max_examples=5)
@given(N=st.sampled_from([46, 47, 67, 68]), seed=seeds)
def test_matrices_of_the_size_of_the_robust_step(N: int, seed: int) -> None:
    A = filled(np.ones((N, N), dtype=np.bool_), seed)
    for schedule in (sameh_kuck(N), greedy(A != 0.0)):
        check_triangularisation(schedule, A)
        check_equal_to_qr(schedule, A, tolerance=1e-7)
