"""A system or a filter that is still a function, or in a tuple, is refused by all that take one, with what to do."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, get_args

import numpy as np
import pytest

from filters import multirate_gain
from filters.error_covariance import true_covariance
from filters.kind import check_kind
from filters.modular import dual_rate, larsen, observe, recalculate, run
from filters.modular.as_system import composed_system
from filters.modular.jobs import modular_jobs
from filters.modular.late import Late
from filters.registry import ALL_METHODS, DELAYED_METHODS
from filters.robust import extended as extended_robust
from filters.simulation import simulate_truth
from filters.system import System
from filters.systems.coarse import over
from filters.systems.example import example_system
from tests.filters.modular.cases import linear_case

GOOD = linear_case()
SYSTEM, START = example_system(2, 1, 1), (np.zeros(2), np.eye(2), np.zeros((3, 1)))
LATE: tuple[Late, ...] = get_args(Late)

TAKE_A_SYSTEM: dict[str, Callable[[Any], Any]] = {
    **{name: lambda it, name=name: DELAYED_METHODS[name].run(it, 1, 0, 1, *START, []) for name in DELAYED_METHODS},
    **{f"jobs of {name}": lambda it, name=name: ALL_METHODS[name].jobs(it) for name in ALL_METHODS},
    "multirate": lambda it: multirate_gain.run(it, 1, *START, np.zeros((4, 1))),
    "over": lambda it: over(it, 2),
    "simulate_truth": lambda it: simulate_truth(it, 1, *START, seed=0),
    "true_covariance": lambda it: true_covariance(it, np.eye(2), np.zeros((3, 2, 1))),
}
TAKE_A_FILTER: dict[str, Callable[[Any], Any]] = {
    **{late: lambda it, late=late: run(it, GOOD.x0, GOOD.P0, GOOD.inputs(3), [], late=late) for late in LATE},
    **{
        f"{way.__name__}.run": lambda it, way=way: way.run(it, GOOD.x0, GOOD.P0, GOOD.inputs(3), [])
        for way in (recalculate, larsen, dual_rate)
    },
    "observe": lambda it: observe(it, np.zeros((3, 2)), 0),
    "jobs": modular_jobs,
    "composed_system": lambda it: composed_system(it, GOOD.P0, 1),
}


def vehicle() -> None:
    """Where it is forgotten to call it."""


@pytest.mark.parametrize("name", TAKE_A_SYSTEM)
def test_a_system(name: str) -> None:
    with pytest.raises(ValueError, match=r"system is the function vehicle, .*; call it: system = vehicle\(...\)"):
        TAKE_A_SYSTEM[name](vehicle)
    with pytest.raises(ValueError, match=r"system is a tuple with the System in it; unpack it: system, x0 = ..."):
        TAKE_A_SYSTEM[name]((SYSTEM, np.zeros(2)))


@pytest.mark.parametrize("name", TAKE_A_FILTER)
def test_a_filter(name: str) -> None:
    with pytest.raises(ValueError, match=r"composed is the function vehicle, .*; call it: composed = vehicle\(...\)"):
        TAKE_A_FILTER[name](vehicle)
    with pytest.raises(ValueError, match=r"tuple with the ModularFilter in it; unpack it: composed, x0, P0 = ..."):
        TAKE_A_FILTER[name]((GOOD.composed, GOOD.x0, GOOD.P0))


def test_others() -> None:
    with pytest.raises(ValueError, match="coarse is the function vehicle"):
        multirate_gain.run(SYSTEM, 1, *START, np.zeros((4, 1)), coarse=vehicle)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="system is the function vehicle"):
        extended_robust.run(vehicle, *[None] * 5, np.zeros((1, 1)), None)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="system is a list with the System in it; give item 1 of it"):
        check_kind("system", [1, SYSTEM], System, "a System")
    with pytest.raises(ValueError, match="system is 7; give a System"):
        check_kind("system", 7, System, "a System")
