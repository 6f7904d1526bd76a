"""Memory of Larsen's method and of the dual-rate filter is that of the arrays in the C that is written."""

from __future__ import annotations

import re
from math import prod

import numpy as np
import pytest

from filters.systems.example import example_system
from studies.board.steps import Steps
from studies.board.wanted import Filter
from studies.board.write import board_files
from studies.steffes.memory import SQUARE, STATES, memory


@pytest.mark.parametrize(("method", "L"), [("larsen", 4), ("dual-rate", 8)])
def test_it_is_that_of_the_arrays_in_state_h(method: str, L: int) -> None:
    wanted = Filter(method, example_system(9, 3, 3), np.zeros(9), "textbook", "double", Steps(10, 4, L), "")
    declared = re.findall(r"^static real (\w+)((?:\[\d+\])+)", board_files(wanted)["state.h"], re.MULTILINE)
    assert declared
    assert memory(method).total == sum(prod(map(int, re.findall(r"\d+", shape))) for _, shape in declared)


@pytest.mark.parametrize("method", ["larsen", "dual-rate"])
def test_its_parts_are_the_whole(method: str) -> None:
    found = memory(method)
    assert found.total == STATES * found.states + SQUARE * found.matrices + found.correction + found.scratch


def test_the_dual_rate_filter_keeps_more() -> None:
    assert memory("dual-rate").matrices > memory("larsen").matrices
    assert memory("dual-rate").total > memory("larsen").total
