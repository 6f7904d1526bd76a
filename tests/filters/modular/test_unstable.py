"""Plants that are not stable: the covariance goes to that of the Riccati equation and stays there, symmetric."""

from __future__ import annotations

from itertools import product
from typing import get_args

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.modular import (
    Measurement,
    ModularFilter,
    ModularHistory,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    run,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.late import Late

EVERY, DELAY, L = 4, 2, 3


class Plant:
    """Three states of which at least one runs away, seen by one or two numbers; all random."""

    def __init__(self, seed: int) -> None:
        random = np.random.default_rng(seed)
        n, p = 3, 1 + seed % 2
        F = random.normal(size=(n, n))
        self.F = F * random.uniform(1.01, 1.3) / np.abs(np.linalg.eigvals(F)).max()
        self.H = random.normal(size=(p, n))
        half = random.normal(size=(n, n))
        self.Q, self.R = 0.1 * half @ half.T, np.diag(random.uniform(0.1, 2.0, size=p))

    def filter(self, predictor: str, corrector: str) -> ModularFilter:
        F, H = self.F, self.H

        def f(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
            for i in range(len(out)):
                out[i] = F[i, 0] * x[0] + F[i, 1] * x[1] + F[i, 2] * x[2]

        def h(x: FloatArray, out: FloatArray) -> None:
            for i in range(len(out)):
                out[i] = H[i, 0] * x[0] + H[i, 1] * x[1] + H[i, 2] * x[2]

        predictors = {
            "linear": lambda: linear_predictor(F, self.Q),
            "extended": lambda: extended_predictor(f, self.Q),
            "unscented": lambda: unscented_predictor(f, self.Q),
        }
        correctors = {
            "linear": lambda: linear_corrector(H, self.R),
            "extended": lambda: extended_corrector(h, self.R),
            "unscented": lambda: unscented_corrector(h, self.R),
        }
        return ModularFilter(predictors[predictor](), [Sensor("s", correctors[corrector](), EVERY, DELAY)])

    def steady(self) -> list[FloatArray]:
        """P after steps k, k + 1, ... k + EVERY - 1 with the measurement of k, then P_{k^-}; by SciPy."""
        power = np.linalg.matrix_power
        Q = sum(power(self.F, i) @ self.Q @ power(self.F, i).T for i in range(EVERY))
        P = solve_discrete_are(power(self.F, EVERY).T, self.H.T, Q, self.R)
        S = self.H @ P @ self.H.T + self.R
        found = [P - P @ self.H.T @ np.linalg.solve(S, self.H @ P)]
        for _ in range(EVERY - 1):
            found.append(self.F @ found[-1] @ self.F.T + self.Q)
        return [*found, P]


def history(plant: Plant, predictor: str, corrector: str, late: Late, backend: BackendName) -> ModularHistory:
    """2,000 steps, and those of the last cycle until the next measurement would be taken."""
    steps = 2000 + EVERY - 1
    measurements = [Measurement("s", k, k + DELAY, np.zeros(len(plant.H))) for k in range(0, 2001, EVERY)]
    composed = plant.filter(predictor, corrector)
    lands = {"L": L} if late == "dual-rate" else {}
    return run(composed, np.ones(3), np.eye(3), np.zeros((steps, 0)), measurements, late=late, backend=backend, **lands)


def kinds() -> list[tuple[str, str, Late]]:
    """All that go together: predictor, corrector, and what is done with late measurements."""
    pairs = list(product(("linear", "extended", "unscented"), repeat=2))
    ways: tuple[Late, ...] = ("larsen", "carried-gain", "dual-rate")
    linearised = [pair for pair in pairs if "unscented" not in pair]
    return [(*pair, "recalculate") for pair in pairs] + [(*pair, way) for pair in linearised for way in ways]


def check_is_steady(plant: Plant, found: ModularHistory) -> None:
    """From the step in which every way has the measurement until the next is taken, all must agree with SciPy."""
    steady = plant.steady()
    for after in range(max(L, DELAY), EVERY):
        np.testing.assert_allclose(found.P[2000 + after], steady[after], rtol=0, atol=1e-10 * np.abs(steady[-1]).max())
    np.testing.assert_array_equal(found.P, found.P.transpose(0, 2, 1))


@pytest.mark.parametrize("late", get_args(Late))
@pytest.mark.parametrize("seed", [1, 4, 5])
def test_the_covariance_is_that_of_the_riccati_equation(seed: int, late: Late) -> None:
    check_is_steady(Plant(seed), history(Plant(seed), "linear", "linear", late, "reference"))


@pytest.mark.exhaust
@pytest.mark.parametrize(("predictor", "corrector", "late"), kinds())
@pytest.mark.parametrize("seed", range(4))
def test_of_all_kinds(seed: int, predictor: str, corrector: str, late: Late) -> None:
    check_is_steady(Plant(seed), history(Plant(seed), predictor, corrector, late, "reference"))


@pytest.mark.exhaust
@pytest.mark.parametrize(("kind", "late"), [(one, late) for one, other, late in kinds() if one == other])
def test_of_all_kinds_compiled(kind: str, late: Late) -> None:
    check_is_steady(Plant(5), history(Plant(5), kind, kind, late, "compiled"))


@pytest.mark.parametrize("late", get_args(Late))
def test_an_inverted_pendulum_with_a_torque_that_is_not_known(late: Late) -> None:
    """At 200 Hz, its angle measured in every tenth step, four steps late. The deviation of the angle stays where it is
    from the hundredth measurement on: it is the same after each of the others."""
    dt, steps = 1 / 200, 6000
    F = np.array([[1.0, dt, 0.0], [9.81 * dt, 1.0, dt], [0.0, 0.0, 1.0]])
    sensor = Sensor("angle", linear_corrector([[1.0, 0.0, 0.0]], [[1e-6]]), every=10, delay=4)
    composed = ModularFilter(linear_predictor(F, np.diag([1e-12, 1e-8, 1e-6])), [sensor], dt)
    measurements = [Measurement("angle", k, k + 4, [0.0]) for k in range(0, steps, 10)]
    lands = {"L": 8} if late == "dual-rate" else {}
    given = np.zeros(3), 0.01 * np.eye(3), np.zeros((steps, 0)), measurements
    P = run(composed, *given, late=late, backend="reference", **lands).P
    np.testing.assert_allclose(np.sqrt(P[1009::10, 0, 0]), np.sqrt(P[1009, 0, 0]), rtol=1e-6)


def test_sigma_points_of_states_that_are_known_exactly() -> None:
    """Without noise, of states that are copies or constants: the covariance is singular, and that of the linear one."""
    F, H = np.array([[1.1, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), np.array([[1.0, 1.0, 0.0]])

    def f(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
        out[:] = F @ x

    def h(x: FloatArray, out: FloatArray) -> None:
        out[:] = H @ x

    measurements = [Measurement("s", k, k, [0.1 * k]) for k in range(0, 20, 3)]
    unscented = unscented_predictor(f, np.zeros((3, 3))), unscented_corrector(h, [[0.5]])
    linear = linear_predictor(F, np.zeros((3, 3))), linear_corrector(H, [[0.5]])
    found, expected = (
        run(ModularFilter(predictor, [Sensor("s", corrector)]), np.ones(3), np.eye(3), np.zeros((20, 0)), measurements)
        for predictor, corrector in (unscented, linear)
    )
    for each, same in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, same, rtol=0, atol=1e-10)
