"""The carried gain, and Larsen's products where several are in flight: any sensors, any delays, any order of arrival.

Two oracles, neither of which carries anything: the filter that gets all undelayed, its corrections of the estimate left
out as long as their measurements have not arrived; and the error as a linear map of all noises, stacked.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.modular import (
    Measurement,
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    in_flight,
    linear_corrector,
    run,
)
from filters.modular.late import Late
from tests.filters.modular import cases
from tests.filters.modular.cases import Case, largest_error, linear_case, measured
from tests.filters.modular.test_larsen import small_attitude, small_pendulum

BOTH_WAYS: tuple[Late, ...] = ("carried-gain", "larsen")
N = 3
Q = np.array([[0.02, 0.01, 0.0], [0.01, 0.03, 0.005], [0.0, 0.005, 0.01]])
P0 = np.array([[1.0, 0.2, 0.1], [0.2, 0.8, 0.0], [0.1, 0.0, 0.5]])
X0 = np.array([1.0, -0.5, 0.3])
H = {
    "gps": np.array([[1.0, 0.0, 0.2]]),
    "camera": np.array([[0.3, 1.0, 0.0], [0.0, -0.4, 1.0]]),
    "sonar": np.array([[0.5, 0.5, -1.0]]),
}
R = {"gps": np.array([[0.2]]), "camera": np.array([[0.5, 0.1], [0.1, 0.3]]), "sonar": np.array([[0.4]])}
NAMES = tuple(H)


def turning(x: FloatArray, u: FloatArray, _dt: float, out: FloatArray) -> None:
    """The input is the matrix of the step, and what drives it."""
    out[:] = u[:9].reshape(3, 3) @ x + u[9:]


def turning_jacobian(_x: FloatArray, u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[:] = u[:9].reshape(3, 3)


FILTER = ModularFilter(
    extended_predictor(turning, Q, turning_jacobian),
    [Sensor(name, linear_corrector(H[name], R[name])) for name in NAMES],
)


def inputs(steps: int, drive: float = 1.0) -> FloatArray:
    """Matrices that change in every step, and keep about the length of a state."""
    rows = []
    for j in range(steps):
        a, b = 0.2 + 0.1 * np.sin(j), 0.15 * np.cos(0.7 * j)
        about_z = np.array([[np.cos(a), -np.sin(a), 0.0], [np.sin(a), np.cos(a), 0.0], [0.0, 0.0, 0.98]])
        about_x = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(b), -np.sin(b)], [0.0, np.sin(b), np.cos(b)]])
        rows.append([*(about_z @ about_x).ravel(), *(drive * np.array([0.1, np.sin(j), -0.2]))])
    return np.array(rows).reshape(steps, 12)


def filtered(steps: int, measurements: Sequence[Measurement], late: Late, **options: int) -> tuple[FloatArray, ...]:
    """x and P."""
    return tuple(run(FILTER, X0, P0, inputs(steps), measurements, late=late, **options))


def undelayed(measurements: Sequence[Measurement]) -> list[Measurement]:
    return [one._replace(arrives=one.taken) for one in measurements]


def _order(one: Measurement) -> tuple[int, bool, int, int]:
    """In which they are taken."""
    return one.taken, one.arrives > one.taken, NAMES.index(one.sensor), one.arrives


class Batch(NamedTuple):
    """x (steps + 1, n), P (steps + 1, n, n)."""

    x: FloatArray
    P: FloatArray


def batch(steps: int, measurements: Sequence[Measurement]) -> Batch:
    """With the gains of the filter that gets all undelayed, of what has arrived by each step; all noises stacked."""
    matrices, drives = inputs(steps)[:, :9].reshape(-1, N, N), inputs(steps)[:, 9:]
    queue = sorted(enumerate(measurements), key=lambda one: _order(one[1]))
    sizes = [N, *[N] * steps, *(len(R[one.sensor]) for one in measurements)]
    starts = np.cumsum([0, *sizes])
    stacked = np.zeros((starts[-1], starts[-1]))
    for start, block in zip(starts, [P0, *[Q] * steps, *(R[one.sensor] for one in measurements)], strict=False):
        stacked[start : start + len(block), start : start + len(block)] = block

    def noise(block: int) -> FloatArray:
        return np.eye(starts[-1])[starts[block] : starts[block + 1]]

    gains, P = {}, P0
    for j in range(steps + 1):
        if j > 0:
            P = matrices[j - 1] @ P @ matrices[j - 1].T + Q
        for number, one in queue:
            if one.taken == j:
                h = H[one.sensor]
                K = P @ h.T @ np.linalg.inv(h @ P @ h.T + R[one.sensor])
                gains[number], P = K, P - K @ h @ P
    xs, Ps = [], []
    for now in range(steps + 1):
        x, error = X0, -noise(0)
        for j in range(now + 1):
            if j > 0:
                x, error = matrices[j - 1] @ x + drives[j - 1], matrices[j - 1] @ error - noise(j)
            for number, one in queue:
                if one.taken == j and one.arrives <= now:
                    K, h = gains[number], H[one.sensor]
                    x, error = x + K @ (one.y - h @ x), error + K @ (noise(1 + steps + number) - h @ error)
        xs.append(x)
        Ps.append(error @ stacked @ error.T)
    return Batch(np.array(xs), np.array(Ps))


def record(steps: int, longest: int, seed: int) -> list[Measurement]:
    """Three sensors, delays from 0 on, in any order."""
    random = np.random.default_rng(seed)
    return [
        Measurement(name, k, k + int(random.integers(longest + 1)), random.normal(size=len(R[name])))
        for k in range(steps)
        for name in NAMES
        if random.random() < 0.4
    ]


@pytest.mark.parametrize("late", BOTH_WAYS)
def test_three_sensors_out_of_order_are_the_batch_of_what_has_landed(late: Late) -> None:
    """Delays of 0 to 25 steps, and a model that changes with time: estimate and true covariance in every step."""
    steps = 45
    measurements = record(20, 25, seed=1)
    x, P = filtered(steps, measurements, late)
    expected = batch(steps, measurements)
    np.testing.assert_allclose(x, expected.x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(P, expected.P, rtol=0, atol=1e-10)
    in_time = run(FILTER, X0, P0, inputs(steps), undelayed(measurements))
    np.testing.assert_allclose(x[-1], in_time.x[-1], rtol=0, atol=1e-10)
    np.testing.assert_allclose(P[-1], in_time.P[-1], rtol=0, atol=1e-10)


def test_without_what_compensates_for_others_in_flight_it_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    steps = 45
    measurements = record(20, 25, seed=1)
    expected = run(FILTER, X0, P0, inputs(steps), undelayed(measurements)).x[-1]
    monkeypatch.setattr(in_flight, "compensate", lambda *_: None)
    x, _ = filtered(steps, measurements, "carried-gain")
    assert np.abs(x[-1] - expected).max() > 1e-3


@st.composite
def arriving(draw: st.DrawFn, steps: int, longest: int) -> list[Measurement]:
    """Any sensors in any steps, several of one in one step too; some arrive after the last step."""
    found = []
    for k in range(steps + 1):
        for name in draw(st.lists(st.sampled_from(NAMES), max_size=3)):
            y = np.sin(1.0 + k + np.arange(len(R[name])))
            found.append(Measurement(name, k, k + draw(st.integers(0, longest)), y))
    return found


@settings(max_examples=60, deadline=None)
@given(measurements=arriving(7, 9))
def test_any_arrivals_are_the_batch_of_what_has_landed(measurements: list[Measurement]) -> None:
    x, P = filtered(9, measurements, "carried-gain")
    expected = batch(9, measurements)
    np.testing.assert_allclose(x, expected.x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(P, expected.P, rtol=0, atol=1e-10)


@settings(max_examples=60, deadline=None)
@given(measurements=arriving(7, 9), late=st.sampled_from(BOTH_WAYS))
def test_once_nothing_is_in_flight_it_is_the_filter_that_got_all_undelayed(
    measurements: list[Measurement], late: Late
) -> None:
    """Where Larsen's way is that of products: with at least two in flight at once."""
    two = [Measurement("gps", 0, 3, [0.1]), Measurement("sonar", 1, 2, [0.3])]
    x, P = filtered(17, [*measurements, *two], late)
    expected = run(FILTER, X0, P0, inputs(17), undelayed([*measurements, *two]))
    for j in range(18):
        if all(not one.taken <= j < one.arrives for one in (*measurements, *two)):
            np.testing.assert_allclose(x[j], expected.x[j], rtol=0, atol=1e-10)
            np.testing.assert_allclose(P[j], expected.P[j], rtol=0, atol=1e-10)


@settings(max_examples=40, deadline=None)
@given(measurements=arriving(6, 8), end=st.integers(0, 9))
def test_a_run_that_ends_sooner_is_the_same_until_then(measurements: list[Measurement], end: int) -> None:
    """What arrives after the end has been taken all the same."""
    whole, part = (filtered(steps, measurements, "carried-gain") for steps in (9, end))
    for found, expected in zip(part, whole, strict=True):
        np.testing.assert_array_equal(found, expected[: end + 1])


def own_covariances(steps: int, measurements: Sequence[Measurement], late: Late) -> FloatArray:
    """Of the error in each step (steps + 1, n, n), by giving the filter each noise alone; None stays None."""
    moves = inputs(steps, drive=0.0)
    covariances = [P0, *[Q] * steps, *(R[one.sensor] for one in measurements)]
    starts = np.cumsum([0, *map(len, covariances)])
    stacked = np.zeros((starts[-1], starts[-1]))
    for start, block in zip(starts, covariances, strict=False):
        stacked[start : start + len(block), start : start + len(block)] = block

    def errors_from(noise: FloatArray) -> FloatArray:
        start, *rest = np.split(noise, starts[1:-1])
        truth = [start]
        for j in range(steps):
            truth.append(moves[j, :9].reshape(N, N) @ truth[-1] + rest[j])
        seen = []
        for one, v in zip(measurements, rest[steps:], strict=True):
            y = H[one.sensor] @ truth[one.taken] + v
            seen.append(one._replace(y=[None if was is None else now for was, now in zip(one.y, y, strict=True)]))
        return truth - run(FILTER, np.zeros(N), P0, moves, seen, late=late).x

    maps = np.stack([errors_from(noise) for noise in np.eye(starts[-1])], axis=-1)
    return np.asarray(maps @ stacked @ maps.transpose(0, 2, 1))


@pytest.mark.exhaust
@settings(max_examples=15, deadline=None)
@given(
    measurements=arriving(4, 5),
    lost=st.lists(st.sets(st.integers(0, 1), max_size=2), min_size=15, max_size=15),
)
def test_its_covariance_is_that_of_its_error_whatever_is_lost(
    measurements: list[Measurement], lost: list[set[int]]
) -> None:
    """Whole measurements or numbers of them, while others are in flight or not."""
    steps = 7
    with_gaps = [
        one._replace(y=[None if r in gone else float(value) for r, value in enumerate(one.y)])
        for one, gone in zip(measurements, lost, strict=False)
    ]
    _, P = filtered(steps, with_gaps, "carried-gain")
    np.testing.assert_allclose(P, own_covariances(steps, with_gaps, "carried-gain"), rtol=0, atol=1e-10)


def test_of_products_the_covariance_is_that_of_the_error_where_a_number_is_lost_last() -> None:
    """Of the measurement that was taken last of those in flight."""
    measurements = [
        Measurement("gps", 0, 4, [0.1]),
        Measurement("camera", 2, 5, [0.3, None]),
        Measurement("sonar", 3, 3, [0.2]),
    ]
    _, P = filtered(7, measurements, "larsen")
    np.testing.assert_allclose(P, own_covariances(7, measurements, "larsen"), rtol=0, atol=1e-12)


def test_a_lost_one_that_was_in_flight_alone_is_as_if_it_had_not_been_taken() -> None:
    lost = Measurement("camera", 2, 6, [None, None])
    others = [Measurement("gps", 0, 1, [0.4]), Measurement("sonar", 8, 9, [0.3])]
    for found, expected in zip(
        filtered(9, [*others, lost], "carried-gain"), filtered(9, others, "carried-gain"), strict=True
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


def test_what_is_lost_is_made_up_for_by_those_taken_later() -> None:
    """The others land when the loss is known: the estimate is that of the filter which never saw the lost one."""
    lost = Measurement("camera", 2, 6, [None, None])
    others = [
        Measurement("gps", 1, 9, [0.4]),
        Measurement("gps", 3, 7, [-0.2]),
        Measurement("sonar", 3, 11, [0.3]),
        Measurement("camera", 5, 8, [0.5, 0.1]),
    ]
    x, P = filtered(12, [*others, lost], "carried-gain")
    expected = run(FILTER, X0, P0, inputs(12), undelayed(others))
    np.testing.assert_allclose(x[-1], expected.x[-1], rtol=0, atol=1e-10)
    np.testing.assert_allclose(P[-1], expected.P[-1], rtol=0, atol=1e-10)


@pytest.mark.parametrize("late", BOTH_WAYS)
@pytest.mark.parametrize("small", [small_pendulum, small_attitude])
def test_of_extended_parts_it_is_optimal_to_first_order(small: type[Case], late: Late) -> None:
    """With all noises a tenth, corrections are a tenth and the difference from recalculation about a hundredth."""
    corrections, differences = [], []
    for scale in (0.1, 0.01):
        case: Case = small(scale)
        measurements = [one._replace(arrives=one.taken + 9 - one.taken // 2) for one in measured(case, 9, seed=1)]
        both = case.composed, case.x0, case.P0, case.inputs(12), measurements
        x, best = run(*both, late=late).x, run(*both, history=12).x
        undisturbed = run(case.composed, case.x0, case.P0, case.inputs(12), []).x
        corrections.append(largest_error(case, best, undisturbed))
        differences.append(largest_error(case, x[-1:], best[-1:]))
    assert corrections[1] == pytest.approx(0.1 * corrections[0], rel=0.1)
    assert differences[1] <= 0.012 * differences[0]
    assert differences[0] <= 0.1 * corrections[0]


@pytest.mark.parametrize("update", ["short", "joseph"])
def test_joseph_s_form_is_the_same_filter(update: str) -> None:
    measurements = record(12, 8, seed=3)
    composed = ModularFilter(FILTER.predictor, FILTER.sensors, update=update)
    found = run(composed, X0, P0, inputs(20), measurements, late="carried-gain")
    for each, expected in zip(found, filtered(20, measurements, "carried-gain"), strict=True):
        np.testing.assert_allclose(each, expected, rtol=0, atol=1e-12)


@pytest.mark.exhaust
@pytest.mark.parametrize("late", BOTH_WAYS)
def test_compiled_equals_reference(late: Late) -> None:
    """A linear and an extended sensor, numbers lost."""
    first = extended_corrector(cases.height, [[0.2]], cases.height_jacobian)
    case = linear_case(Sensor("one", first), Sensor("both", linear_corrector(cases.H_BOTH, cases.R_BOTH)))
    random = np.random.default_rng(4)
    measurements = [
        Measurement(name, k, k + int(random.integers(9)), list(random.normal(size=size)))
        for k in range(30)
        for name, size in (("one", 1), ("both", 2))
    ]
    measurements[21] = measurements[21]._replace(y=[0.3, None])
    given_to_both = case.composed, case.x0, case.P0, case.inputs(40), measurements
    compiled, reference = (run(*given_to_both, late=late, backend=which) for which in ("compiled", "reference"))
    for found, expected in zip(compiled, reference, strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-13)
