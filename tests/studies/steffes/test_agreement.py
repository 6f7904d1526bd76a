"""Steffes Sec. IV, step by step: the filters agree to rounding outside [m, l - 1], and not inside."""

from __future__ import annotations

import pytest

from sched_sim.design.timing import Timing
from studies.steffes.agreement import FLOOR, agreement


@pytest.mark.parametrize("timing", [Timing(10, 4, 8), Timing(5, 2, 3)])
def test_states_agree_outside_the_steps_m_to_l_minus_1_and_p_at_every_k(timing: Timing) -> None:
    found = agreement(timing, cycles=2)
    N, M, L = timing.N, timing.M, timing.L
    assert [j for j, waits in enumerate(found.waiting.tolist()) if waits] == [*range(M, L), *range(N + M, N + L)]
    assert found.elsewhere < 10 * FLOOR
    assert found.of_covariance < 10 * FLOOR
    assert found.while_waiting[0] > 1e-3


def test_rounding_is_there_and_the_same_each_time() -> None:
    first, again = (agreement(Timing(4, 1, 3), cycles=2) for _ in range(2))
    assert 0 < first.elsewhere == again.elsewhere
