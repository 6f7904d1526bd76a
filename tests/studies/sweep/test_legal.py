"""Of designs whose least speed is simulated, those are legal that are not too long for it."""

from __future__ import annotations

import numpy as np
import pytest

from sched_sim.bounds import MOST_IN_FLIGHT
from sched_sim.design.method import Law
from sched_sim.design.methods import METHODS
from studies.sweep.legal import Legal

DUAL_RATE = METHODS["dual-rate"].law("next-step")
CLONE = METHODS["clone"].law("next-step")
MOST = {N: MOST_IN_FLIGHT * N for N in (1, 2, 5)}


def designs(legal: Legal) -> list[tuple[int, int, int]]:
    return list(zip(*(axis.tolist() for axis in legal.designs(0, legal.size)), strict=True)) if legal.size else []


@pytest.mark.parametrize("law", [DUAL_RATE, CLONE])
@pytest.mark.parametrize("M", [None, [0, 1, 999, 1000, 1001, 1999, 2000, 5000, 6000], [7000]])
@pytest.mark.parametrize("L", [None, [1, 999, 1000, 1001, 2000, 2001, 5000, 7001], [8000]])
def test_they_are_the_legal_ones_up_to_so_many_steps(law: Law, M: list[int] | None, L: list[int] | None) -> None:
    simulated, every = Legal(law, list(MOST), M, L, simulated=True), Legal(law, list(MOST), M, L)
    expected = [design for design in designs(every) if max(design[1:]) <= MOST[design[0]]]
    assert designs(simulated) == expected
    for start in range(0, simulated.size, 7):
        some = simulated.designs(start, min(start + 3, simulated.size))
        assert list(zip(*map(np.ndarray.tolist, some), strict=True)) == expected[start : start + 3]
    if M is not None:
        kept = len(expected) if L is not None else len({design[:2] for design in expected})
        assert simulated.left_out == len(MOST) * len(M) * len(L or [0]) - kept
