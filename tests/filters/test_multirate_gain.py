"""The multirate gain: the standard filter for n = 1, Eq. (1) written in NumPy for n > 1, and when a gain is in use."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.backends.counted import Operations, count
from filters.covariance_forms import COVARIANCE_FORMS
from filters.delayed import standard
from filters.factored import FACTORED_FORMS
from filters.history import History
from filters.records import new_correction
from filters.registry import MULTIRATE_METHODS
from filters.system import System
from filters.systems.coarse import over
from filters.systems.example import example_system
from filters.systems.gps import gps
from filters.systems.linear import linear_system
from filters.systems.navigation import simulate_drive, vehicle
from tests.strategies import Problem, problem, seeds, systems

each_form = pytest.mark.parametrize("form", FACTORED_FORMS)


def multirate(data: Problem, n: int, **options: Any) -> History:
    start = data.x0, data.P0, data.inputs, data.measurements
    return multirate_gain.run(data.system, n, *start, **{"backend": "numpy", **options})


def assert_equal(found: History, expected: History, tolerance: float = 1e-9) -> None:
    for field, value in expected._asdict().items():
        scale = 1 + np.abs(value).max()
        np.testing.assert_allclose(getattr(found, field), value, rtol=0, atol=tolerance * scale, err_msg=field)


def coarse_of(system: System, n: int, share: int) -> System:
    """Over n steps of a linear system with changing matrices, from step j on for every j."""
    given_matrices = system.parameters
    period = len(given_matrices.Phi)
    Phis, Qs = [], []
    for j in range(period):
        Phi_n, Q_n = np.eye(system.states), np.zeros((system.states, system.states))
        for i in range(j, j + n):
            Phi = given_matrices.Phi[i % period]
            Phi_n, Q_n = Phi @ Phi_n, Phi @ Q_n @ Phi.T + given_matrices.Q[i % period]
        Phis.append(Phi_n)
        Qs.append(Q_n)
    return linear_system(np.array(Phis), given_matrices.B, given_matrices.H, np.array(Qs), given_matrices.R / share)


def equation_1(data: Problem, coarse: System, n: int, L: int) -> History:
    """Gains first, then the state; one line of NumPy per equation."""
    fine, slow = data.system.parameters, coarse.parameters
    steps = len(data.inputs)
    P, references, gains = data.P0, [], []
    for k in range(0, steps + 1, n):
        if k > 0:
            Phi, Q = slow.Phi[(k - n) % len(slow.Phi)], slow.Q[(k - n) % len(slow.Q)]
            P = Phi @ P @ Phi.T + Q
        references.append(P)
        H, R = slow.H[k % len(slow.H)], slow.R[k % len(slow.R)]
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        P = P - K @ H @ P
        gains.append(K / n)  # (1)
    x, states, innovations, used = data.x0, [], [], []
    for j in range(steps + 1):
        if j > 0:
            Phi, B = fine.Phi[(j - 1) % len(fine.Phi)], fine.B[(j - 1) % len(fine.B)]
            x = Phi @ x + B @ data.inputs[j - 1]
        landed = [K for k, K in zip(range(0, steps + 1, n), gains, strict=True) if k + L <= j]
        K = landed[-1] if landed else gains[0]
        z = data.measurements[j] - fine.H[j % len(fine.H)] @ x
        x = x + K @ z
        states.append(x)
        innovations.append(z)
        used.append(K)
    return History(np.array(states), np.array(references), np.array(innovations), np.array(used))


@each_form
@given(system=systems(), steps=st.integers(0, 12), seed=seeds)
def test_a_gain_in_every_step_is_the_standard_filter(form: str, system: System, steps: int, seed: int) -> None:
    data = problem(system, 1, 0, 0, steps, seed)
    assert_equal(multirate(data, 1, form=form), standard.run(*data, backend="numpy"))


@each_form
def test_a_gain_in_every_step_is_the_extended_filter_too(form: str) -> None:
    drive = simulate_drive(steps=200, N=1, seed=0)
    data = Problem(drive.system, 1, 0, 0, drive.x0, drive.P0, drive.inputs, drive.truth.measurements)
    assert_equal(multirate(data, 1, form=form), standard.run(*data, backend="numpy"))


@each_form
@given(data=st.data())
def test_equation_1(form: str, data: st.DataObject) -> None:
    n = data.draw(st.integers(1, 6))
    L = data.draw(st.integers(0, n))
    system = data.draw(systems())
    record = problem(system, 1, 0, 0, data.draw(st.integers(0, 3 * n + 2)), data.draw(seeds))
    coarse = coarse_of(system, n, share=data.draw(st.sampled_from([1, n])))
    assert_equal(multirate(record, n, form=form, coarse=coarse, L=L), equation_1(record, coarse, n, L))


@pytest.mark.parametrize("update", COVARIANCE_FORMS)
def test_the_covariance_form_of_the_conventional_filter_changes_nothing(update: str) -> None:
    system = example_system(4, 2, 2, seed=1)
    record, coarse = problem(system, 1, 0, 0, 17, seed=2), coarse_of(system, 3, share=3)
    assert_equal(multirate(record, 3, coarse=coarse, update=update), equation_1(record, coarse, 3, 0))


@pytest.mark.exhaust
@pytest.mark.parametrize("form", ["u-d", "conventional", "square-root"])
def test_backends_agree(form: str) -> None:
    drive = simulate_drive(steps=40, N=1, seed=0)
    data = Problem(drive.system, 1, 0, 0, drive.x0, drive.P0, drive.inputs, drive.truth.measurements)
    options = {"coarse": vehicle(period_s=0.04), "form": form, "L": 2}
    expected = multirate(data, 4, backend="reference", **options)
    for backend in ("numpy", "compiled"):
        assert_equal(multirate(data, 4, backend=backend, **options), expected, tolerance=1e-10)


def test_the_job_of_a_step_is_what_a_run_does_in_it() -> None:
    system = still(example_system(4, 2, 2, seed=5))
    data = problem(system, 1, 0, 0, 9, seed=1)
    history = multirate(data, 3)
    for j in range(1, 10):
        correction = new_correction(system)._replace(K=history.gains[j])
        x = np.empty(4)
        before, u, y = history.x[j - 1], data.inputs[j - 1], data.measurements[j]
        multirate_gain.state_update(system, j, before, u, y, correction, x)
        np.testing.assert_allclose(x, history.x[j], rtol=1e-12)
        np.testing.assert_allclose(correction.z, history.innovations[j], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("n", "L", "cycles"),
    [(1, 0, [0, 1, 2, 3, 4, 5]), (1, 1, [0, 0, 1, 2, 3, 4]), (3, 0, [0, 0, 0, 1, 1, 1]), (3, 3, [0, 0, 0, 0, 0, 0, 1])],
)
def test_the_gain_in_use(n: int, L: int, cycles: list[int]) -> None:
    assert [multirate_gain.cycle_in_use(j, n, L) for j in range(len(cycles))] == cycles


def still(system: System) -> System:
    """The same with constant matrices."""
    return linear_system(*(matrix[0] for matrix in system.parameters))


@given(n=st.integers(1, 12), system=systems().map(still))
def test_the_model_over_n_steps(n: int, system: System) -> None:
    Phi, _, H, Q, R = (matrix[0] for matrix in system.parameters)
    powers = [np.linalg.matrix_power(Phi, i) for i in range(n + 1)]
    for noise, share in (("averaged", n), ("sampled", 1)):
        found = over(system, n, noise).parameters
        np.testing.assert_allclose(found.Phi[0], powers[n], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(found.Q[0], sum(F @ Q @ F.T for F in powers[:n]), rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(found.H[0], H)
        np.testing.assert_allclose(found.R[0], R / share)


@pytest.mark.parametrize("system", [example_system(3, 1, 1), vehicle(), gps(steps=9)])
def test_a_model_over_n_steps_is_not_guessed(system: System) -> None:
    assert over(system, 1) is system
    with pytest.raises(ValueError, match="give it as coarse="):
        over(system, 2)


def test_a_linear_system_with_functions_of_its_own_is_not_linear() -> None:
    system = still(example_system(3, 1, 1))

    def own_f(_j: int, _x: FloatArray, _u: FloatArray, _parameters: Any, _out: FloatArray) -> None: ...

    with pytest.raises(ValueError, match="give it as coarse="):
        over(system._replace(f=own_f), 2)


def scalar(q: float, r: float = 1.0) -> System:
    return linear_system([[1.0]], [[0.0]], [[1.0]], [[q]], [[r]])


def steady_gain(q: float, r: float) -> float:
    """Of the scalar random walk: P^- is the positive root of P^2 = q P + q r."""
    P = (q + np.sqrt(q * q + 4 * q * r)) / 2
    return float(P / (P + r))


@pytest.mark.parametrize("n", [2, 5, 20])
def test_with_the_same_spectral_density_the_gain_of_a_slow_filter_is_right_with_the_same_R_it_is_not(n: int) -> None:
    """Slow: K ~ sqrt(Q / R), so K(n dT) / n ~ sqrt(n Q / (R / n)) / n = K, but sqrt(n Q / R) / n = K / sqrt(n)."""
    for q, tolerance in ((1e-6, 2e-2), (1e-10, 2e-4)):
        optimal = steady_gain(q, 1.0)
        assert steady_gain(n * q, 1 / n) / n / optimal == pytest.approx(1, abs=tolerance)
        assert steady_gain(n * q, 1.0) / n / optimal == pytest.approx(n**-0.5, abs=tolerance)


@pytest.mark.parametrize("noise", ["averaged", "sampled"])
def test_the_scalar_gain_settles_at_its_closed_form(noise: Any) -> None:
    n, q = 4, 0.3
    data = problem(scalar(q), 1, 0, 0, 200, seed=0)
    found = multirate(data, n, coarse=over(data.system, n, noise)).gains[-1, 0, 0]
    assert found == pytest.approx(steady_gain(n * q, 1 / n if noise == "averaged" else 1.0) / n, rel=1e-12)


GOOD = problem(still(example_system(3, 2, 2)), 1, 0, 0, 12, seed=0)
NOISELESS = np.array([[1.0, 1.0], [1.0, 1.0]])


@pytest.mark.parametrize(
    ("n", "change", "options", "message"),
    [
        (0, {}, {}, "n=0 must be a whole number, at least 1"),
        (3, {}, {"L": 4}, "L=4, n=3 must satisfy 0 <= L <= n"),
        (3, {}, {"L": -1}, "L=-1, n=3 must satisfy 0 <= L <= n"),
        (3, {"x0": np.zeros(2)}, {}, r"x0 has shape \(2,\), the system needs \(3,\)"),
        (3, {"P0": np.zeros((3, 2))}, {}, r"P0 has shape \(3, 2\), the system needs \(3, 3\)"),
        (3, {"inputs": np.zeros((12, 3))}, {}, r"inputs has shape \(12, 3\), the system needs \(12, 2\)"),
        (3, {"measurements": np.zeros((12, 2))}, {}, r"measurements has shape \(12, 2\), the system needs \(13, 2\)"),
        (3, {}, {"coarse": 7}, "coarse is 7; give a filters.system.System"),
        (3, {}, {"form": "cholesky"}, "form='cholesky' is unknown"),
        (3, {}, {"update": "fast"}, "update='fast' is unknown"),
        (3, {}, {"backend": "gpu"}, "backend='gpu' is unknown"),
        (3, {}, {"coarse": example_system(3, 2, 1)}, "coarse has 3 states, 2 inputs and 1 measurements, the system"),
        (3, {"system": example_system(3, 2, 2)}, {}, r"the model over n=3 steps is not known.*give it as coarse="),
        (
            3,
            {},
            {"coarse": GOOD.system._replace(R=lambda k, p: NOISELESS if k == 6 else p.R[0])},
            "R of step 6 is not positive definite: its smallest eigenvalue is .*give each measurement noise",
        ),
        (1, {}, {"coarse": GOOD.system._replace(R=lambda _k, p: -p.R[0])}, "R of step 0 is not positive definite"),
        (1, {}, {"coarse": GOOD.system._replace(R=lambda _k, _p: np.tri(2))}, "R of step 0 is not symmetric"),
    ],
)
def test_bad_arguments(n: int, change: dict[str, Any], options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        multirate(GOOD._replace(**change), n, **options)


def test_an_unknown_kind_of_noise() -> None:
    with pytest.raises(ValueError, match="noise='none' is unknown; give one of averaged, sampled"):
        over(GOOD.system, 2, "none")


def test_operations_of_the_state_update_of_the_patents_example() -> None:
    """Phi x, H x, y - H x, K z, x + K z. The patent has 139 and 128: see studies.multirate.patent."""
    for method in MULTIRATE_METHODS.values():
        job = method.jobs(gps(steps=30))["state_update"]
        assert count(job.function, *job.arguments(0)) == Operations(
            multiply=8 * 8 + 4 * 8 + 8 * 4, add=8 * 7 + 4 * 7 + 4 + 8 * 3 + 8
        )
