"""What the parts of a filter cost in operations, by formulas worked out by hand. n: states, p: measurements."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.backends.choose import arguments_for, function_for
from filters.backends.counted import Operations, count
from filters.backends.counted_scalar import plain
from filters.jobs import Job
from filters.modular import (
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.correctors import Corrector
from filters.modular.jobs import modular_jobs
from filters.modular.predictors import Predictor
from tests.filters.modular.cases import ATTITUDE, EXTENDED, UNSCENTED

SIZES = [(2, 1), (4, 2), (9, 3)]


def still(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    """No operations."""
    for i in range(len(out)):
        out[i] = x[i]


def first(x: FloatArray, out: FloatArray) -> None:
    """No operations."""
    for i in range(len(out)):
        out[i] = x[i]


def halved(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    """One multiply for each state."""
    for i in range(len(out)):
        out[i] = 0.5 * x[i]


def ones(_x: FloatArray, out: FloatArray) -> None:
    for i in range(len(out)):
        out[i, i] = 1.0


def halves_of_motion(_x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    for i in range(len(out)):
        out[i, i] = 0.5


def ones_of_motion(_x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    for i in range(len(out)):
        out[i, i] = 1.0


def counts(predictor: Predictor, corrector: Corrector) -> dict[str, Operations]:
    """Of each part of a filter with one sensor, s."""
    jobs = modular_jobs(ModularFilter(predictor, [Sensor("s", corrector)]))
    return {part: count(job.function, *job.arguments(0)) for part, job in jobs.items()}


def linear(n: int, p: int) -> dict[str, Operations]:
    return counts(linear_predictor(np.eye(n), np.eye(n)), linear_corrector(np.eye(p, n), np.eye(p)))


def extended(n: int, p: int) -> dict[str, Operations]:
    corrector = extended_corrector(first, np.eye(p), ones)
    return counts(extended_predictor(still, np.eye(n), ones_of_motion), corrector)


def numeric(n: int, p: int) -> dict[str, Operations]:
    return counts(extended_predictor(still, np.eye(n)), extended_corrector(first, np.eye(p)))


def unscented(n: int, p: int) -> dict[str, Operations]:
    return counts(unscented_predictor(still, np.eye(n)), unscented_corrector(first, np.eye(p)))


def cholesky(n: int) -> Operations:
    """Entry (i, j) takes j products, and a divide or the root."""
    products = (n - 1) * n * (n + 1) // 6
    return Operations(multiply=products, add=products, divide=n * (n - 1) // 2, sqrt=n)


def product(n: int, m: int, p: int) -> Operations:
    """Of matrices (n, m) and (m, p)."""
    return Operations(multiply=n * m * p, add=n * (m - 1) * p)


def correction(n: int, p: int) -> Operations:
    """z, the factor of S, the solution of S K^T = cross with it, x + K z, P - K cross."""
    solved = Operations(multiply=n * p * (p + 1), add=n * p * (p - 1), divide=2 * p)
    covariance = Operations(multiply=p * n * n, add=p * n * n)
    return Operations(add=p) + cholesky(p) + solved + product(n, p, 1) + Operations(add=n) + covariance


def sigma_points(n: int) -> Operations:
    """The factor of P, its columns times the spread, and 2 n + 1 sums with the mean."""
    return cholesky(n) + Operations(multiply=n * (n + 1) // 2, add=(2 * n + 1) * n)


def mean(points: int, size: int) -> Operations:
    """Errors from the first point, their weighted sum, the mean, errors from that."""
    return Operations(multiply=points * size, add=points * size + (points - 1) * size + size + points * size)


def weighted_products(points: int, a: int, b: int) -> Operations:
    """The sum of left right^T, added to what is there."""
    return Operations(multiply=points * a * (1 + b), add=points * a * b)


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_linear(n: int, p: int) -> None:
    found = linear(n, p)
    projected = product(p, n, 1) + product(p, n, n) + Operations(multiply=p * p * n, add=p * p * n)  # H x, H P, S
    assert found["predict"] == product(n, n, 1) + product(n, n, n) + Operations(multiply=n**3, add=n**3)
    assert found["correct.s"] == projected + correction(n, p)


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_extended_is_linear_with_the_users_functions_in_place_of_two_products(n: int, p: int) -> None:
    extended_parts, linear_parts = extended(n, p), linear(n, p)
    assert extended_parts["predict"] + product(n, n, 1) == linear_parts["predict"]
    assert extended_parts["correct.s"] + product(p, n, 1) == linear_parts["correct.s"]


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_a_jacobian_by_differences_moves_the_state_twice_for_each_error(n: int, p: int) -> None:
    """The step: a root, a multiply and half its inverse; then the difference of two results, scaled."""
    numeric_parts, extended_parts = numeric(n, p), extended(n, p)
    moved = Operations(multiply=n, add=2 * n * n, divide=n, sqrt=n)
    of_motion, of_measurement = Operations(multiply=n * n, add=n * n), Operations(multiply=n * p, add=n * p)
    assert numeric_parts["predict"] == extended_parts["predict"] + moved + of_motion
    assert numeric_parts["correct.s"] == extended_parts["correct.s"] + moved + of_measurement


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_unscented(n: int, p: int) -> None:
    found, points = unscented(n, p), 2 * n + 1
    observed = mean(points, p) + weighted_products(points, p, p) + weighted_products(points, p, n)
    assert found["predict"] == sigma_points(n) + mean(points, n) + weighted_products(points, n, n)
    assert found["correct.s"] == sigma_points(n) + observed + correction(n, p)


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_larsens_way_costs_products_with_the_accumulated_matrix(n: int, p: int) -> None:
    found = linear(n, p)
    conditioned = product(p, n, n) + Operations(multiply=p * n * n, add=p * n * n)
    assert found["predict_accumulate"] == found["predict"] + product(n, n, n)
    assert found["correct_late.s"] == found["correct.s"] + product(p, n, n)
    assert found["correct_accumulate.s"] == found["correct.s"] + conditioned


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_what_is_in_flight_costs_products_with_what_is_carried(n: int, p: int) -> None:
    """Of gains, (n, p), and of transitions, (n, n); a landing with another taken before it and one after it."""
    found = linear(n, p)
    for kind, carry, w in (("", "carry.s", p), ("_product", "carry_product", n)):
        assert found[carry] == product(n, n, w)
        assert found[f"beside{kind}.s"].total == 4 * p * n * w
        moved = 2 * p + 2 * n * w  # zeta, A v and its sum with x
        eliminated = 2 * p * w + 2 * n * w * w + 2 * p * w * w  # of the later's known part, the earlier's A and its T
        of_products = (2 * n * p - n) + 2 * n * p * w if kind else 0
        assert found[f"land{kind}.s"].total == moved + eliminated + of_products


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_dual_rate_divides_a_prediction_and_a_correction_between_its_tasks(n: int, p: int) -> None:
    """The covariance waits for the measurement, which then is its innovation and K z; a landing carries that on."""
    found = linear(n, p)
    state, moved = product(n, n, 1), product(n, p, 1) + Operations(add=n)
    assert found["hr_restart"] == state
    assert found["hr_propagate"] == found["predict"] + product(n, n, n)
    assert found["hr_update"] == product(n, n, 1) + Operations(add=n)
    assert found["lr_propagate"] + state == found["predict"]
    assert found["gain.s"] + Operations(add=p) + moved == found["correct.s"]
    assert found["gain_again.s"] + product(p, n, 1) == found["gain.s"]
    assert found["lr_correct.s"] == Operations(multiply=n * p, add=n * p + 2 * p)
    assert found["hr_pass.s"] == product(n, n, 1) + product(p, n, 1) + Operations(multiply=n * p, add=n * p)
    thin = Operations(multiply=p * n * n, add=p * n * n)
    assert found["gain_kept.s"] == thin + product(n, n, n) + product(n, n, n) + product(p, p, n) + thin


def test_the_users_function_counts_as_often_as_it_is_called() -> None:
    """Linearised: once, and twice for each error if there is no Jacobian; unscented: once for each sigma point."""
    n, sensor = 3, linear_corrector(np.eye(1, 3), [[1.0]])

    def multiplies(predictor: Predictor) -> int:
        return counts(predictor, sensor)["predict"].multiply

    makers = {
        "extended": lambda f, jacobian: extended_predictor(f, np.eye(n), jacobian),
        "numeric": lambda f, _: extended_predictor(f, np.eye(n)),
        "unscented": lambda f, _: unscented_predictor(f, np.eye(n)),
    }
    calls = {
        name: (multiplies(make(halved, halves_of_motion)) - multiplies(make(still, ones_of_motion))) // n
        for name, make in makers.items()
    }
    assert calls == {"extended": 1, "numeric": 2 * n + 1, "unscented": 2 * n + 1}


def test_predictions_grow_with_the_cube_of_the_states_linear_corrections_with_the_square() -> None:
    small, large = 8, 16

    def growth(filters: Any, part: str) -> float:
        return float(filters(large, 1)[part].total / filters(small, 1)[part].total)

    assert 7 < growth(linear, "predict") < 8
    assert 6.5 < growth(unscented, "predict") < 8
    assert 3.5 < growth(linear, "correct.s") < 4
    assert 4 < growth(unscented, "correct.s") < 6  # its Cholesky factor is a cube, but a small one


def numbers(value: Any) -> list[float]:
    """All that an argument holds, as floats."""
    if isinstance(value, np.ndarray):
        return [plain(item) for item in value.flat]
    return [number for item in value for number in numbers(item)] if isinstance(value, tuple) else []


def left_by(job: Job) -> list[float]:
    """What the job leaves in its arguments, run as it is written."""
    arguments = job.arguments(1)
    job.function(*arguments)
    return numbers(arguments)


JOBS = [
    pytest.param(job, id=f"{name}-{part}")
    for name, case in {"extended": EXTENDED, "unscented": UNSCENTED, "attitude": ATTITUDE}.items()
    for part, job in modular_jobs(case.composed, case.x0, case.P0, case.u).items()
]


@pytest.mark.parametrize("job", JOBS)
def test_what_is_counted_is_the_filter_itself(job: Job) -> None:
    """Counting scalars go the same way and come to the same numbers."""
    counted: list[float] = []

    def kept(*arguments: Any) -> None:
        job.function(*arguments)
        counted.extend(numbers(arguments))

    assert count(kept, *job.arguments(1)).total > 0
    np.testing.assert_allclose(counted, left_by(job), rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("job", JOBS)
def test_a_job_that_is_done_again_leaves_the_same(job: Job) -> None:
    arguments = job.arguments(1)
    for _ in range(2):
        job.function(*arguments)
    np.testing.assert_allclose(numbers(arguments), left_by(job), rtol=1e-13, atol=1e-15)


DUAL_RATE_KINDS = (
    "hr_propagate",
    "hr_restart",
    "hr_update",
    "lr_propagate",
    "gain",
    "gain_again",
    "gain_kept",
    "lr_correct",
    "hr_pass",
)
COMPILED = [
    modular_jobs(UNSCENTED.composed, UNSCENTED.x0, UNSCENTED.P0, UNSCENTED.u)["correct.height"],
    *(
        job
        for part, job in modular_jobs(EXTENDED.composed, EXTENDED.x0, EXTENDED.P0, EXTENDED.u).items()
        if part.partition(".")[0] in DUAL_RATE_KINDS
    ),
]


@pytest.mark.exhaust
@pytest.mark.parametrize("job", [pytest.param(job, id=job.kind) for job in COMPILED])
def test_what_is_compiled_is_the_filter_itself(job: Job) -> None:
    arguments = job.arguments(1)
    function_for("compiled", job.function)(*arguments_for("compiled", arguments))
    np.testing.assert_allclose(numbers(arguments), left_by(job), rtol=1e-12, atol=1e-14)
