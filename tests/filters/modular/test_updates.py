"""Forms of the covariance update: the same filter, with other rounding and at another cost."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Literal

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.backends.counted import Operations, count
from filters.delayed import larsen
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
)
from filters.modular.jobs import modular_jobs
from tests.filters.modular import cases
from tests.filters.modular.cases import CASES, LINEAR, ONE_SENSOR, Case, measured, measured_rows, with_timing
from tests.filters.modular.test_counts import SIZES, product, weighted_products
from tests.filters.modular.test_counts import extended as extended_counts

Update = Literal["short", "joseph", "u-d"]
LINEARISED = ["linear", "extended"]


def with_update(case: Case, update: Update) -> Case:
    composed = case.composed
    return case._replace(
        composed=ModularFilter(composed.predictor, composed.sensors, composed.dt, composed.of, update=update)
    )


def history(case: Case, update: Update, measurements: list[Measurement], steps: int, **options: Any) -> ModularHistory:
    one = with_update(case, update)
    return run(one.composed, one.x0, one.P0, one.inputs(steps), measurements, **options)


@pytest.mark.parametrize(
    ("name", "update"), [*((name, "joseph") for name in CASES), *((name, "u-d") for name in LINEARISED)]
)
@settings(max_examples=10)
@given(data=st.data())
def test_all_forms_are_one_filter(name: str, update: Update, data: st.DataObject) -> None:
    """With any delays, of all kinds of parts, given Jacobians or not, with an attitude too."""
    steps = 5
    measurements = data.draw(cases.arriving(name, steps))
    found = history(CASES[name], update, measurements, steps, history=steps + 1)
    expected = history(CASES[name], "short", measurements, steps, history=steps + 1)
    assert cases.largest_error(CASES[name], found.x, expected.x) <= 1e-9
    np.testing.assert_allclose(found.P, expected.P, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(found.P, found.P.transpose(0, 2, 1))


def test_factors_of_an_attitude() -> None:
    """Linearised parts of which one measures an attitude, and one with a given Jacobian."""
    extended = [
        Sensor("field", extended_corrector(cases.field, 1e-3 * np.eye(3)), every=2, delay=1),
        Sensor(
            "stars", extended_corrector(cases.attitude, 1e-4 * np.eye(3), observed=cases.space(4, attitudes=[0])), 3
        ),
    ]
    for case in (cases.attitude_case(extended_predictor, *extended), cases.JACOBIANS):
        measurements = measured(case, 12, seed=3)
        found, expected = (history(case, update, measurements, 12) for update in ("u-d", "short"))
        assert cases.largest_error(case, found.x, expected.x) <= 1e-11
        np.testing.assert_allclose(found.P, expected.P, rtol=0, atol=1e-12)


@pytest.mark.parametrize("update", ["joseph", "u-d"])
def test_it_is_filterpys(update: Update) -> None:
    """Whose update is Joseph's."""
    (_, both), steps = LINEAR.composed.sensors, 12
    case = LINEAR.with_sensors(both)
    measurements = [
        one._replace(arrives=one.taken) for one in cases.everything("linear", steps) if one.sensor == "both"
    ]
    found = history(case, update, measurements, steps)
    other = KalmanFilter(2, 2, 1)
    other.x, other.P, other.F, other.B, other.Q = case.x0.copy(), case.P0.copy(), cases.F, cases.B, cases.Q
    other.H, other.R = cases.H_BOTH, cases.R_BOTH
    for j, one in enumerate(measurements):
        if j > 0:
            other.predict(case.u)
        other.update(one.y)
        np.testing.assert_allclose(found.x[j], other.x, rtol=0, atol=1e-12)
        np.testing.assert_allclose(found.P[j], other.P, rtol=0, atol=1e-12)


@pytest.mark.parametrize("update", ["joseph", "u-d"])
@given(gone=st.lists(st.sets(st.integers(0, 1)), min_size=5, max_size=5))
def test_lost_numbers(update: Update, gone: list[set[int]]) -> None:
    measurements = [
        Measurement("both", k, k, [None if r in lost else 0.1 * k + r for r in range(2)]) for k, lost in enumerate(gone)
    ]
    found, expected = (history(LINEAR, each, measurements, 5) for each in (update, "short"))
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.P, expected.P, rtol=0, atol=1e-12)


@pytest.mark.parametrize("late", ["larsen", "carried-gain", "dual-rate"])
@pytest.mark.parametrize("name", ONE_SENSOR)
def test_late_measurements_in_josephs_form(name: str, late: Any) -> None:
    case, system = with_timing(ONE_SENSOR[name], 4, 2)
    measurements = measured(case, 13)
    found, expected = (history(case, update, measurements, 13, late=late) for update in ("joseph", "short"))
    for each, same in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, same, rtol=0, atol=1e-12)
    if late == "larsen":
        of_system = larsen.run(
            system, 4, 2, 2, case.x0, case.P0, case.inputs(13), measured_rows(measurements), update="joseph"
        )
        np.testing.assert_allclose(found.x, of_system.x, rtol=0, atol=1e-10)


def exact(steps: int) -> FloatArray:
    """P at the end of the run below, in fractions of the very same floating-point numbers, rounded to 80 digits."""
    dt, q, R, digits = Fraction(0.01), Fraction(1e-12), Fraction(1e-8), 10**80
    p, c, v = Fraction(1e10), Fraction(0), Fraction(1e10)
    for j in range(steps + 1):
        if j > 0:
            p, c, v = p + 2 * dt * c + dt * dt * v + q, c + dt * v, v + q
        if j % 10 == 0:
            p, c, v = p - p * p / (p + R), c - c * p / (p + R), v - c * c / (p + R)
        p, c, v = (Fraction(round(value * digits), digits) for value in (p, c, v))
    return np.array([[p, c], [c, v]], dtype=np.float64)


def sharp(update: Update, steps: int, predictor: Any = linear_predictor) -> FloatArray:
    """P at the end: a position known to 1e-4 of a start of which nothing is known, a variance of 1e10."""
    sensor = Sensor("position", linear_corrector([[1.0, 0.0]], [[1e-8]]), every=10)
    composed = ModularFilter(predictor([[1.0, 0.01], [0.0, 1.0]], 1e-12 * np.eye(2)), [sensor], update=update)
    measurements = [Measurement("position", k, k, [0.0]) for k in range(0, steps + 1, 10)]
    return run(composed, np.zeros(2), 1e10 * np.eye(2), np.zeros((steps, 0)), measurements).P[-1]


def test_what_a_sharp_measurement_leaves_of_a_great_variance() -> None:
    """The short form loses it, and says so; Joseph's keeps it definite, factors keep eight digits of it."""
    with pytest.raises(ValueError, match=r"step 0: the covariance is no longer positive .*give update='u-d'"):
        sharp("short", 300)
    assert np.linalg.eigvalsh(sharp("joseph", 300))[0] > 0
    np.testing.assert_allclose(sharp("u-d", 300), exact(300), rtol=1e-6)
    assert np.abs(sharp("joseph", 300) / exact(300) - 1).max() > 1e-3


def counts(update: Update, n: int, p: int) -> dict[str, Operations]:
    composed = ModularFilter(
        linear_predictor(np.eye(n), np.eye(n)), [Sensor("s", linear_corrector(np.eye(p, n), np.eye(p)))], update=update
    )
    return {part: count(job.function, *job.arguments(0)) for part, job in modular_jobs(composed).items()}


def less(more: Operations, fewer: Operations) -> Operations:
    return Operations(*(a - b for a, b in zip(more, fewer, strict=True)))


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_what_josephs_form_costs_more(n: int, p: int) -> None:
    """In place of P - K cross: I - K H, two products of its size, R K^T, and K (R K^T) added. Late: two more."""
    short, joseph = counts("short", n, p), counts("joseph", n, p)
    thin = Operations(multiply=p * n * n, add=p * n * n)
    own = thin + product(n, n, n) + product(n, n, n) + product(p, p, n) + thin
    assert joseph["predict"] == short["predict"]
    assert less(joseph["correct.s"], short["correct.s"]) == less(own, thin)
    late = product(n, n, 1) + Operations(add=n * n) + product(n, n, n) + Operations(multiply=n**3, add=n**3)
    assert less(joseph["correct_late.s"], joseph["correct.s"]) == late


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_what_josephs_form_of_sigma_points_costs_more(n: int, p: int) -> None:
    def of(update: Update) -> Operations:
        composed = ModularFilter(
            linear_predictor(np.eye(n), np.eye(n)),
            [Sensor("s", cases.unscented_corrector(first, np.eye(p)))],
            update=update,
        )
        job = modular_jobs(composed)["correct.s"]
        return count(job.function, *job.arguments(0))

    points, thin = 2 * n + 1, Operations(multiply=p * n * n, add=p * n * n)
    moved = Operations(multiply=points * n * p, add=points * n * p)
    own = moved + product(p, p, n) + thin + weighted_products(points, n, n)
    assert less(of("joseph"), of("short")) == less(own, thin)


def first(x: FloatArray, out: FloatArray) -> None:
    for i in range(len(out)):
        out[i] = x[i]


@pytest.mark.parametrize(("n", "p"), SIZES)
def test_factors_cost_no_square_root_and_about_twice_a_prediction(n: int, p: int) -> None:
    """Corrections by Bierman: 2 n^2 multiplies and adds for each number, to the leading order."""
    found, short = counts("u-d", n, p), counts("short", n, p)
    assert set(found) == {"predict", "correct.s"}
    assert found["predict"].sqrt == found["correct.s"].sqrt == 0
    assert 1 < found["predict"].total / short["predict"].total < 3
    assert found["correct.s"].multiply <= p * (1.5 * n * n + 6.5 * n) + p * p * n + p**3
    assert extended_counts(n, p)["predict"].sqrt == 0


def test_what_does_not_go_together_is_refused() -> None:
    with pytest.raises(ValueError, match="update='potter' is unknown; give one of short, joseph, u-d"):
        with_update(LINEAR, "potter")  # type: ignore[arg-type]
    for name, part in (("unscented", "predictor"), ("attitude", "predictor")):
        with pytest.raises(ValueError, match=f"{part}: update='u-d' .*unscented; give update='joseph'"):
            with_update(CASES[name], "u-d")
    for late in ("larsen", "carried-gain", "dual-rate"):
        with pytest.raises(ValueError, match=f"update='u-d' keeps factors .* late='{late}' .*; use late='recalculate'"):
            history(cases.POSITION, "u-d", [], 3, late=late)


@pytest.mark.parametrize("update", ["joseph", "u-d"])
def test_a_breakdown_is_named_in_every_form(update: Update) -> None:
    def explode(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
        out[:] = np.exp(x)

    sensor = Sensor("s", linear_corrector([[1.0, 0.0]], [[1.0]]))
    for predictor, message in (
        (extended_predictor(explode, np.eye(2)), r"predictor, step 4: f\(x, u, dt, out\) is not finite at x = "),
        (linear_predictor(np.diag([1.0, 1e60]), np.eye(2)), "predictor, step [3-6]: .* the model lets it grow beyond"),
    ):
        composed = ModularFilter(predictor, [sensor], update=update)
        with pytest.raises(ValueError, match=message):
            run(composed, [0.8, 0.1], np.eye(2), np.zeros((8, 0)), [])


@pytest.mark.exhaust
@pytest.mark.parametrize("update", ["joseph", "u-d"])
def test_compiled_equals_reference(update: Update) -> None:
    (position, _) = LINEAR.composed.sensors
    case = LINEAR.with_sensors(position)
    measurements = measured(case, 40)
    found, expected = (
        history(case, update, measurements, 40, backend=backend) for backend in ("compiled", "reference")
    )
    for each, same in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, same, rtol=1e-12, atol=1e-14)
