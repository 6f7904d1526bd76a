"""What a run of a modular filter refuses: ways that do not fit, numbers that break down, Jacobians that are wrong."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, get_args

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from filters.arrays import FloatArray
from filters.modular import (
    Measurement,
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    maccormack,
    merwe,
    run,
    space,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.late import Late
from tests.filters.modular import cases
from tests.filters.modular.cases import ATTITUDE, UNSCENTED, Case, linear_case, pendulum_case
from tests.filters.modular.refusals import GPS, POSITION, Y, refused


def filtered(case: Case, late: str, *measurements: Measurement, **options: Any) -> Callable[[], Any]:
    return lambda: run(
        case.composed, case.x0, case.P0, case.inputs(8), measurements, late=late, backend="reference", **options
    )


@pytest.mark.parametrize("late", ["larsen", "carried-gain"])
def test_to_carry_corrections_takes_matrices(late: str) -> None:
    extended = extended_corrector(cases.height, [[1.0]])
    refused(f"predictor: late='{late}' .* use late='recalculate'", filtered(UNSCENTED, late))
    sigma = pendulum_case(
        extended_predictor, Sensor("gps", extended), Sensor("camera", UNSCENTED.composed.sensors[0].corrector)
    )
    refused(f"sensor 'camera': late='{late}' .* use late='recalculate'", filtered(sigma, late))


@pytest.mark.parametrize("late", ["larsen", "carried-gain"])
def test_there_is_room_for_so_many_in_flight(late: str) -> None:
    many = [Measurement("gps", k % 8, 8, Y) for k in range(501)]
    refused("501 measurements are in flight at once, and there is room for 500: leave", filtered(GPS, late, *many))


def test_the_dual_rate_way_needs_landings_after_the_delays() -> None:
    case = linear_case(Sensor("gps", POSITION, every=4, delay=2))
    refused("L=.*: 'sonar' is none of the sensors; they are gps", filtered(case, "dual-rate", L={"sonar": 9}))
    both = linear_case(Sensor("gps", POSITION, every=4, delay=2), Sensor("other", POSITION, delay=5))
    refused("sensor 'other': L=5 must be a whole number, more than delay=5", filtered(both, "dual-rate", L=5))
    late_beside = Measurement("gps", 4, 8, Y)
    refused(
        "sensor 'gps', .* step 4: it arrives in step 8.*lands in step 8; give a greater L",
        filtered(both, "dual-rate", late_beside),
    )
    refused("predictor: late='dual-rate' .*use late='recalculate'", filtered(UNSCENTED, "dual-rate"))
    refused(
        "sensor 'gps': L=2 must be a whole number, more than delay=2: the correction lands after",
        filtered(case, "dual-rate", L=2),
    )
    refused("sensor 'gps': L=3.5 must be a whole number", filtered(case, "dual-rate", L=3.5))
    refused(
        "sensor 'gps': L=3 must be a whole number, more than delay=3:",
        filtered(linear_case(Sensor("gps", POSITION, every=4, delay=[1, 3, 2])), "dual-rate", L=3),
    )
    late = Measurement("gps", 4, 7, Y)
    refused(
        "sensor 'gps', .* step 4: it arrives in step 7.*lands in step 7; give a greater",
        filtered(case, "dual-rate", late, L=3),
    )


def steep(x: FloatArray, out: FloatArray) -> None:
    out[0] = np.exp(3.0 * x[0])


def explode(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[:] = np.exp(x)


def test_a_covariance_that_breaks_down_names_sensor_step_and_remedy() -> None:
    """Sigma points whose weights are negative leave an innovation covariance that is."""
    case = pendulum_case(
        extended_predictor,
        Sensor("gps", POSITION),
        Sensor("steep", unscented_corrector(steep, [[0.1]], merwe(0.1, -5.0))),
    )
    refused(
        "sensor 'steep', step 3: the covariance is no longer positive definite.*; give more noise .* alpha = 1",
        filtered(case, "recalculate", Measurement("gps", 0, 0, Y), Measurement("steep", 3, 3, Y)),
    )


@pytest.mark.parametrize("late", get_args(Late))
def test_an_estimate_that_is_no_longer_finite_names_the_part(late: str) -> None:
    case = pendulum_case(extended_predictor, Sensor("gps", POSITION))
    exploding = case._replace(composed=ModularFilter(extended_predictor(explode, cases.Q), case.composed.sensors))
    refused("predictor, step 4: .*no longer finite; give", filtered(exploding, late))
    steeper = case.with_sensors(Sensor("gps", extended_corrector(steep, [[1.0]])))
    hot = steeper._replace(x0=np.array([200.0, 500.0]))  # then 300, and exp(900) is beyond all numbers
    refused("sensor 'gps', step 1: .*no longer finite; give", filtered(hot, late, Measurement("gps", 1, 1, Y)))


def test_parts_are_made_by_the_functions_that_make_them() -> None:
    predictor = linear_predictor(cases.F, cases.Q)
    refused("sensor 'gps': the corrector is a function; make one by linear_c", lambda: Sensor("gps", cases.height))
    refused("the predictor is a function; make one by linear_predictor", lambda: ModularFilter(cases.height, []))
    refused("sensors is .'gps'.; give a list of Sensor", lambda: ModularFilter(predictor, ["gps"]))
    refused("sensors is Sensor.*; give a list of Sensor", lambda: ModularFilter(predictor, Sensor("gps", POSITION)))


def test_spaces_are_made_by_the_function_that_makes_them() -> None:
    predictor = linear_predictor(cases.F, cases.Q)
    refused(r"of is 7; give space\(numbers, attitudes=", lambda: ModularFilter(predictor, [], of=7))
    for corrector in (linear_corrector, extended_corrector, unscented_corrector):
        refused(r"observed is 7; give space\(numbers", lambda make=corrector: make(np.eye(1), [[1.0]], observed=7))
    refused("space: numbers=None must be a whole number", lambda: space(None))
    refused("space: numbers=2.5 must be a whole number", lambda: space(2.5))
    refused(r"space: attitudes=0 must be a list of whole numbers, \[\] if there are none", lambda: space(4, 0))
    refused("space: attitudes='x' must be a list of whole numbers", lambda: space(4, "x"))
    refused("space: angles=.0.5. must be a list of whole numbers", lambda: space(4, angles=[0.5]))


def test_sigma_points_are_made_by_the_functions_that_make_them() -> None:
    refused("points is 'merwe'; give merwe", lambda: unscented_predictor(cases.pendulum, cases.Q, "merwe"))
    corrector = unscented_corrector(cases.height, [[1.0]], None)
    refused("sensor 'gps': points is None; give merwe", lambda: linear_case(Sensor("gps", corrector)))
    for make in (merwe, maccormack):
        for name in ("alpha", "beta", "kappa"):
            refused(f"{make.__name__}: {name}=None must be a number", partial(make, **{name: None}))


FIELD = np.array([0.6, 0.0, 0.8])
"""Of `cases.field`, in the frame of the world."""


def slope_by_the_body(x: FloatArray, out: FloatArray) -> None:
    """How `cases.field` changes as the attitude is turned in the frame of the body."""
    out[:, :3] = cross_matrix(Rotation.from_quat(x[:4], scalar_first=True).inv().apply(FIELD))


def slope_by_the_world(x: FloatArray, out: FloatArray) -> None:
    """The same as the attitude is turned in the frame of the world."""
    turned = Rotation.from_quat(x[:4], scalar_first=True).inv()
    out[:, :3] = turned.as_matrix() @ cross_matrix(FIELD)


def cross_matrix(v: FloatArray) -> FloatArray:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def test_a_jacobian_in_the_frame_of_the_world_is_found() -> None:
    def by(jacobian: Callable[[FloatArray, FloatArray], None]) -> Callable[[], Any]:
        sensor = Sensor("magnetometer", extended_corrector(cases.field, np.eye(3), jacobian))
        return filtered(ATTITUDE.with_sensors(sensor), "recalculate")

    by(slope_by_the_body)()
    refused(r"sensor 'magnetometer': jacobian\(x, out\) gives .* frame of the body", by(slope_by_the_world))


def test_a_jacobian_with_a_wrong_sign_is_found() -> None:
    def slope(_x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
        out[:] = [[1.0, 0.2], [0.14, 1.0]]

    case = pendulum_case(extended_predictor)
    wrong = case._replace(composed=ModularFilter(extended_predictor(cases.pendulum, cases.Q, slope), [], 0.2))
    refused(
        r"predictor: jacobian\(x, u, dt, out\) gives 0.14 in \[1, 0\], where differences", filtered(wrong, "larsen")
    )


def test_a_wrong_jacobian_is_found_where_states_are_known_exactly() -> None:
    def slope(_x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
        out[:] = [[1.0, 0.2], [0.14, 1.0]]

    case = pendulum_case(extended_predictor)
    wrong = case._replace(composed=ModularFilter(extended_predictor(cases.pendulum, cases.Q, slope), [], 0.2))
    for known in (np.zeros((2, 2)), np.diag([0.0, 1e-6]), np.diag([1e6, 0.0])):
        refused(r"jacobian\(x, u, dt, out\) gives 0.14 in \[1, 0\]", filtered(wrong._replace(P0=known), "recalculate"))


@pytest.mark.exhaust
def test_what_numba_cannot_compile_is_said_in_a_line() -> None:
    def unheard(x: FloatArray, out: FloatArray) -> None:
        out[0] = x[0] + Rotation.identity().magnitude()

    case = pendulum_case(extended_predictor, Sensor("odd", extended_corrector(unheard, [[1.0]])))
    inputs = case.inputs(2)
    refused(
        "^backend='compiled': numba cannot compile the filter: [^\n]*; mend that line, or use backend='reference'$",
        lambda: run(case.composed, case.x0, case.P0, inputs, [], backend="compiled"),
    )


@pytest.mark.parametrize("late", get_args(Late))
def test_functions_that_do_not_fit_are_found_before_they_are_compiled(late: str) -> None:
    case = pendulum_case(extended_predictor, Sensor("gps", extended_corrector(cases.attitude, [[1.0]])))
    refused(r"sensor 'gps': h\(x, out\) failed: ValueError: could not broadcast", filtered(case, late))
    refused(r"predictor: f\(x, u, dt, out\) failed: IndexError", filtered(case._replace(u=np.zeros(0)), late))
