"""What numba cannot compile is said in one line, by every filter."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pytest

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.registry import ALL_METHODS, DELAYED_METHODS
from filters.systems.example import example_system
from tests.strategies import problem

GOOD = problem(example_system(2, 1, 1), 5, 2, 4, 12, seed=0)


def R_in_blocks(_k: int, _p: Any) -> FloatArray:
    return np.block([[np.eye(1)]])


@pytest.mark.parametrize(
    "method",
    ["dual-rate", *(pytest.param(name, marks=pytest.mark.exhaust) for name in (*DELAYED_METHODS, "multirate"))],
)
def test_what_numba_cannot_compile(method: str) -> None:
    system = GOOD.system._replace(R=R_in_blocks)
    given = GOOD._replace(system=system)
    run = partial(ALL_METHODS[method].run, *given)
    if method == "multirate":
        run = partial(multirate_gain.run, system, 1, *given[4:7], np.zeros((13, 1)), coarse=system)
    with pytest.raises(ValueError, match=r"backend='compiled': numba cannot compile the system: .*numpy\.block") as no:
        run(backend="compiled")
    said = str(no.value)
    assert "\n" not in said
    assert "in test_running.py, line" in said
    assert said.endswith("mend that line, or use backend='reference'")
