"""Systems without inputs: the same as with inputs that are zero."""

from __future__ import annotations

import numpy as np
import pytest

from filters.backends.counted import count
from filters.covariance_forms import COVARIANCE_FORMS
from filters.registry import ALL_METHODS, DELAYED_METHODS, MULTIRATE_METHODS
from filters.simulation import simulate_truth
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system

MATRICES = {name: value[0] for name, value in example_system(4, 1, 2).parameters._asdict().items()}
WITH = linear_system(**MATRICES)
WITHOUT = linear_system(**{**MATRICES, "B": np.zeros((4, 0))})
STEPS = 17


def record(system: System, N: int) -> tuple[np.ndarray, ...]:
    x0, P0, inputs = np.ones(4), np.eye(4), np.zeros((STEPS, system.inputs))
    return x0, P0, inputs, simulate_truth(system, N, x0, P0, inputs, seed=3).measurements


@pytest.mark.parametrize("backend", ["reference", "numpy", pytest.param("compiled", marks=pytest.mark.exhaust)])
@pytest.mark.parametrize("method", DELAYED_METHODS)
def test_runs(method: str, backend: str) -> None:
    assert WITHOUT.inputs == 0
    run = DELAYED_METHODS[method].run
    found, expected = (run(system, 5, 2, 4, *record(system, 5), backend=backend) for system in (WITHOUT, WITH))
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("method", DELAYED_METHODS)
def test_inputs_that_are_none_are_told_the_steps(method: str) -> None:
    x0, P0, _, measurements = record(WITHOUT, 5)
    said = r"inputs is None; give a row of 0 numbers for each step, np.empty\(\(steps, 0\)\) for a system without"
    with pytest.raises(ValueError, match=said):
        DELAYED_METHODS[method].run(WITHOUT, 5, 2, 4, x0, P0, None, measurements)


@pytest.mark.parametrize("method", MULTIRATE_METHODS)
def test_multirate_runs(method: str) -> None:
    run = MULTIRATE_METHODS[method].run
    found, expected = (run(system, 3, *record(system, 1)) for system in (WITHOUT, WITH))
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("form", COVARIANCE_FORMS)
@pytest.mark.parametrize("method", ALL_METHODS)
def test_operations(method: str, form: str) -> None:
    """What is saved is B u: n m multiplies and adds in each job that calls f."""
    jobs, others = (ALL_METHODS[method].jobs(example_system(4, m, 2), form) for m in (0, 3))
    for kind, job in jobs.items():
        found, with_inputs = (count(of[kind].function, *of[kind].arguments(0)) for of in (jobs, others))
        saved = with_inputs.multiply - found.multiply, with_inputs.add - found.add
        assert saved in ((0, 0), (12, 12)), kind
        assert (saved == (12, 12)) == (job.kind in CALL_F)


CALL_F = {"propagate", "replay", "propagate_accumulate", "hr_restart", "hr_propagate", "hr_propagate_sum",
          "hr_propagate_euler", "state_update", "predict", "predict_0", "predict_1"}  # fmt: skip
