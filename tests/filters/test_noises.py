"""A Q or R that is no covariance is named with its step, whatever step that is, in every filter, form and backend."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.covariance_forms import COVARIANCE_FORMS
from filters.error_covariance import true_covariance
from filters.factored import FACTORED_FORMS
from filters.registry import DELAYED_METHODS
from filters.simulation import simulate_truth
from filters.system import System
from filters.systems.example import example_system
from tests.strategies import problem

STEPS = 17
GOOD = problem(example_system(4, 2, 2, seed=5), 5, 2, 4, STEPS, seed=2)
EVERY_STEP = problem(GOOD.system, 1, 0, 0, STEPS, seed=2)
START = EVERY_STEP.x0, EVERY_STEP.P0, EVERY_STEP.inputs, EVERY_STEP.measurements

each_method = pytest.mark.parametrize("method", DELAYED_METHODS)
each_backend = pytest.mark.parametrize("backend", ["reference", "numpy"])
each_noise = pytest.mark.parametrize("name", ["Q", "R"])


def added(name: str, step: int, entry: float, row: int = 0, column: int = 1) -> System:
    """GOOD's system, but for one entry of a noise in one step."""
    whole = getattr(GOOD.system, name)

    def noise(j: int, parameters: Any) -> FloatArray:
        matrix: FloatArray = whole(j, parameters).copy()
        matrix[row, column] += entry if j == step else 0.0
        return matrix

    return GOOD.system._replace(**{name: noise})


@each_method
@each_backend
@each_noise
@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ((1e-3, 0, 1), "is not symmetric, so it is no covariance; give half the sum"),
        ((1e-3, 1, 0), "is not symmetric, so it is no covariance; give half the sum"),
        ((-10.0, 1, 1), "is no covariance: its smallest eigenvalue is -"),
        ((np.inf, 1, 1), "gives a value that is not finite; give numbers"),
        ((np.nan, 0, 0), "gives a value that is not finite; give numbers"),
    ],
)
def test_a_later_step(method: str, backend: str, name: str, entry: tuple[float, int, int], said: str) -> None:
    data = GOOD._replace(system=added(name, 10, *entry))
    with pytest.raises(ValueError, match=f"step 10: {name} of the system {said}"):
        DELAYED_METHODS[method].run(*data, backend=backend)


@pytest.mark.exhaust
@each_noise
def test_compiled(name: str) -> None:
    with pytest.raises(ValueError, match=f"step 10: {name} of the system is not symmetric"):
        DELAYED_METHODS["standard"].run(*GOOD._replace(system=added(name, 10, 1e-3)), backend="compiled")


@each_method
def test_the_process_noise_of_the_last_step(method: str) -> None:
    with pytest.raises(ValueError, match=f"step {STEPS - 1}: Q of the system is not symmetric"):
        DELAYED_METHODS[method].run(*GOOD._replace(system=added("Q", STEPS - 1, 1e-3)))


@each_method
@pytest.mark.parametrize(("name", "step"), [("Q", STEPS), ("R", 9), ("R", 20)])
def test_a_step_in_which_it_is_not_taken(method: str, name: str, step: int) -> None:
    DELAYED_METHODS[method].run(*GOOD._replace(system=added(name, step, np.nan)))


@each_method
def test_a_step_without_measurement(method: str) -> None:
    data = GOOD._replace(system=added("R", 10, np.nan), measurements=GOOD.measurements[:2])
    DELAYED_METHODS[method].run(*data)


@each_method
@pytest.mark.parametrize("form", COVARIANCE_FORMS)
@pytest.mark.parametrize("lost", [False, True])
def test_an_infinite_variance_is_refused_in_every_form(method: str, form: str, lost: bool) -> None:
    """What says nothing is given as None, with the variance that it would have."""
    measurements: list[Any] = list(GOOD.measurements)
    measurements[2] = None if lost else measurements[2]
    data = GOOD._replace(system=added("R", 10, np.inf, 0, 0), measurements=measurements)
    with pytest.raises(ValueError, match=r"step 10: R of the system .* give numbers, and None in place of a measur"):
        DELAYED_METHODS[method].run(*data, update=form)


@pytest.mark.parametrize("form", FACTORED_FORMS)
@each_noise
def test_a_multirate_gain(form: str, name: str) -> None:
    for n in (1, 5):
        for entry, said in ((1e-3, "is not symmetric"), (np.inf, "gives a value that is not finite")):
            with pytest.raises(ValueError, match=rf"step 10: {name} of the system {said}|R of step 10 {said}"):
                multirate_gain.run(GOOD.system, n, *START, coarse=added(name, 10, entry), form=form)
        multirate_gain.run(GOOD.system, n, *START, coarse=added(name, 18, np.nan), form=form)


@each_noise
def test_the_true_covariance(name: str) -> None:
    gains = np.zeros((STEPS + 1, 4, 2))
    with pytest.raises(ValueError, match=f"step 10: {name} of the system is not symmetric"):
        true_covariance(added(name, 10, 1e-3), GOOD.P0, gains)


@each_noise
def test_a_simulated_truth(name: str) -> None:
    """Draws would leave out what has a negative variance."""
    with pytest.raises(ValueError, match=f"step 10: {name} of the system is no covariance: its smallest eigenvalue"):
        simulate_truth(added(name, 10, -10.0, 1, 1), 5, *GOOD[4:7], seed=0)
    simulate_truth(added("R", 9, np.nan), 5, *GOOD[4:7], seed=0)
