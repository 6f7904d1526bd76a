"""A matrix of another shape in a later step is named with its step: a run would go on with a part of it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.error_covariance import true_covariance
from filters.registry import DELAYED_METHODS
from filters.simulation import simulate_truth
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from filters.systems.shaped import shaped
from tests.strategies import Problem, problem

GOOD = problem(example_system(3, 2, 2), 5, 2, 4, 17, seed=0)
EVERY_STEP = problem(GOOD.system, 1, 0, 0, 17, seed=0)
SHAPES = {"F": (3, 3), "Q": (3, 3), "H": (2, 3), "R": (2, 2)}

each_method = pytest.mark.parametrize("method", DELAYED_METHODS)
each_function = pytest.mark.parametrize("name", SHAPES)


def misshapen(name: str, shape: tuple[int, ...]) -> System:
    """GOOD's, but a function gives a matrix of this shape in step 10."""
    whole = getattr(GOOD.system, name)

    def giving(j: int, *rest: Any) -> FloatArray:
        return np.ones(shape) if j == 10 else np.asarray(whole(j, *rest))

    return GOOD.system._replace(**{name: giving})


def data(method: str) -> Problem:
    """In which each function is asked for step 10; one filter asks for h and H when a measurement arrives."""
    return GOOD._replace(M=0) if method == "fuse-as-fresh" else GOOD


def said(name: str, shape: str) -> str:
    return rf"step 10: {name}\(.*\) has shape {shape}; needed is \({SHAPES[name][0]}, {SHAPES[name][1]}\)"


@each_method
@each_function
@pytest.mark.parametrize("backend", ["reference", "numpy"])
@pytest.mark.parametrize(
    ("shape", "shown"), [((1, 1), r"\(1, 1\)"), ((4, 4), r"\(4, 4\)"), ((3,), r"\(3,\)"), ((), r"\(\)")]
)
def test_a_later_step(method: str, name: str, backend: BackendName, shape: tuple[int, ...], shown: str) -> None:
    with pytest.raises(ValueError, match=said(name, shown)):
        DELAYED_METHODS[method].run(*data(method)._replace(system=misshapen(name, shape)), backend=backend)


@each_method
def test_beside_lost_measurements(method: str) -> None:
    measurements: list[Any] = [None, *GOOD.measurements[1:]]
    wrong = data(method)._replace(system=misshapen("H", (1, 3)), measurements=measurements)
    with pytest.raises(ValueError, match=said("H", r"\(1, 3\)")):
        DELAYED_METHODS[method].run(*wrong)


@each_function
def test_a_multirate_gain(name: str) -> None:
    bad = misshapen(name, (1, 1))
    start = EVERY_STEP.x0, EVERY_STEP.P0, EVERY_STEP.inputs, EVERY_STEP.measurements
    for n in (1, 5):
        with pytest.raises(ValueError, match=said(name, r"\(1, 1\)")):
            multirate_gain.run(GOOD.system, n, *start, coarse=bad)


@each_function
def test_the_true_covariance(name: str) -> None:
    with pytest.raises(ValueError, match=said(name, r"\(1, 1\)")):
        true_covariance(misshapen(name, (1, 1)), GOOD.P0, np.zeros((18, 3, 2)))


@pytest.mark.parametrize("name", ["Q", "R"])
def test_a_simulated_truth(name: str) -> None:
    with pytest.raises(ValueError, match=said(name, r"\(1, 1\)")):
        simulate_truth(misshapen(name, (1, 1)), 5, GOOD.x0, GOOD.P0, GOOD.inputs, seed=0)


def test_what_is_linear_is_known_to_have_its_shapes() -> None:
    assert shaped(GOOD.system) is GOOD.system
    other = linear_system(np.eye(2), np.eye(2), np.eye(2), np.eye(2), np.eye(2))
    assert shaped(GOOD.system._replace(parameters=other.parameters)) is not GOOD.system


def eye_later(j: int, _x: FloatArray, _u: FloatArray, p: Any) -> FloatArray:
    return np.eye(1) if j == 10 else p.Phi[0]


@pytest.mark.exhaust
@pytest.mark.parametrize("method", ["standard", "dual-rate"])
def test_compiled(method: str) -> None:
    data = GOOD._replace(system=GOOD.system._replace(F=eye_later))
    with pytest.raises(ValueError, match=said("F", r"\(1, 1\)")):
        DELAYED_METHODS[method].run(*data, backend="compiled")
