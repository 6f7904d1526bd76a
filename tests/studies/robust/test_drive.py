"""What holds of the paper's claims on the simulated drive, and what the simulation itself promises."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.backends.choose import BACKENDS, BackendName
from filters.robust.uncertain import UncertainSystem
from filters.systems.attitude import attitude, attitude_scaling, write_rate_matrix
from filters.systems.drive import (
    FIX_EVERY,
    RATE_HZ,
    START,
    CargoDrive,
    held_yaw,
    metres_to_position,
    position_to_metres,
    simulate_cargo_drive,
    wrap,
)
from filters.systems.position import position, position_scaling
from studies.robust import drive as study
from studies.robust.drive import AttitudeMethod, AttitudeResult, PositionMethod, PositionResult

pytestmark = pytest.mark.exhaust  # flights of half a minute

SEEDS = (0, 1, 2)


@cache
def drive(scale_error: float = 0.02) -> CargoDrive:
    return simulate_cargo_drive(scale_error=scale_error)


@cache
def attitude_result(method: AttitudeMethod, scale_error: float) -> AttitudeResult:
    return study.attitude_result(method, scale_error, SEEDS)


@cache
def position_result(method: PositionMethod) -> PositionResult:
    return study.position_result(method, study.POSITION_ERRORS[0], SEEDS[:1])


# ------------------------------------------------------------------------------------------------------ the drive


def test_drive_has_the_shapes_it_says() -> None:
    steps, fixes = 100 * RATE_HZ, 1000
    shapes = [np.shape(values) for values in drive()]
    assert shapes[:4] == [(steps + 1,), (steps + 1, 3), (steps + 1, 3), (steps + 1, 3)]
    assert shapes[4:] == [(steps, 3), (steps, 3), (steps, 3), (fixes, 6), (fixes,)]


def test_drive_goes_around_a_block_at_12_metres_a_second() -> None:
    np.testing.assert_allclose(np.linalg.norm(drive().velocity, axis=1), 12.0)
    assert drive().attitude[-1, 2] - drive().attitude[0, 2] == pytest.approx(2 * np.pi, rel=1e-6)
    travelled_m = position_to_metres(np.diff(drive().position, axis=0))
    np.testing.assert_allclose(travelled_m * RATE_HZ, (drive().velocity[1:] + drive().velocity[:-1]) / 2, atol=3e-3)


def test_drive_depends_on_its_seed_alone() -> None:
    for one, again in zip(simulate_cargo_drive(1.0, seed=7), simulate_cargo_drive(1.0, seed=7), strict=True):
        np.testing.assert_array_equal(one, again)
    other, same_noise = simulate_cargo_drive(1.0, seed=8), simulate_cargo_drive(1.0, 0.10, seed=7)
    first = simulate_cargo_drive(1.0, 0.02, seed=7)
    assert np.abs(other.gyro - first.gyro).min() > 0
    np.testing.assert_array_equal(first.gps, same_noise.gps)


def test_gyros_read_too_much() -> None:
    exact, too_much = simulate_cargo_drive(scale_error=0.0), drive(0.10)
    rates = (too_much.gyro - exact.gyro) / 0.10
    T, middle = np.empty((3, 3)), 15 * RATE_HZ
    write_rate_matrix(1.0, *drive().attitude[middle, :2], T)
    turning = (drive().attitude[middle + 1] - drive().attitude[middle - 1]) * RATE_HZ / 2
    np.testing.assert_allclose(T @ rates[middle], turning, atol=1e-4)
    assert abs(rates[middle, 2]) > 0.1


def test_accelerometers_read_as_much_too_much_as_is_asked() -> None:
    exact, off = (simulate_cargo_drive(1.0, accelerometer_error=error) for error in (0.0, 0.10))
    force = (off.accelerometer - exact.accelerometer) / 0.10
    np.testing.assert_allclose(exact.accelerometer, force, atol=0.5)
    np.testing.assert_array_equal(exact.gyro, off.gyro)


def test_unit_drifts_and_gps_does_not() -> None:
    raw = study.raw_result(SEEDS)
    assert 3.0 < raw.imu_yaw_deg < 4.5
    assert raw.gps_yaw_deg == pytest.approx(0.3, rel=0.1)
    np.testing.assert_allclose(raw.gps_m, [0.5, 0.5, 1.0], rtol=0.1)
    assert (raw.held_m[:2] > raw.gps_m[:2] + 0.1).all()


def test_held_yaw_is_that_of_gps_at_a_fix_and_moves_with_the_unit_between() -> None:
    held, unit = held_yaw(drive()), drive().imu_attitude[:, 2]
    np.testing.assert_allclose(held[::FIX_EVERY], drive().gps_yaw, atol=1e-12)
    correction = wrap(held - unit).reshape(-1, FIX_EVERY)
    np.testing.assert_allclose(correction, correction[:, :1].repeat(FIX_EVERY, axis=1), atol=1e-12)
    available = np.arange(1000) < 500
    np.testing.assert_allclose(wrap(held_yaw(drive(), available) - unit)[500 * FIX_EVERY :], correction[499, 0])
    np.testing.assert_array_equal(held_yaw(drive(), np.zeros(1000, dtype=np.bool_)), wrap(unit))


def test_metres_and_back() -> None:
    metres = np.array([[100.0, -50.0, 3.0]])
    np.testing.assert_allclose(position_to_metres(metres_to_position(metres)), metres)


def test_a_drive_shorter_than_a_step_is_refused() -> None:
    with pytest.raises(ValueError, match="between one step"):
        simulate_cargo_drive(0.001)


@pytest.mark.parametrize(
    "backend", [pytest.param(name, marks=pytest.mark.exhaust if name == "reference" else ()) for name in BACKENDS]
)
def test_all_backends_agree(backend: BackendName, monkeypatch: pytest.MonkeyPatch) -> None:
    short = simulate_cargo_drive(0.25)
    expected = study.estimate_attitude(short, study.ROBUST)
    expected_position = study.estimate_position(short, expected, study.POSITION_ROBUST)
    original = study.extended_robust.run
    monkeypatch.setattr(study.extended_robust, "run", lambda *a, **k: original(*a, **k, backend=backend))
    found = study.estimate_attitude(short, study.ROBUST)
    np.testing.assert_allclose(found.scaled_x, expected.scaled_x, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(found.P, expected.P, rtol=1e-8, atol=1e-12)
    found_position = study.estimate_position(short, expected, study.POSITION_ROBUST)
    np.testing.assert_allclose(found_position.scaled_x, expected_position.scaled_x, rtol=0, atol=1e-7)


def textbook_ekf(
    system: UncertainSystem, N: int, x: FloatArray, P: FloatArray, inputs: FloatArray, measurements: FloatArray
) -> FloatArray:
    """The last state of the extended Kalman filter as a one-step predictor, in the units of the system."""
    n, m = len(x), len(system.Q)
    for i, u in enumerate(inputs):
        predicted, F, G = np.empty(n), np.empty((n, n)), np.empty((n, m))
        system.f(x, u, system.parameters, predicted)
        system.F(x, u, system.parameters, F)
        system.G(x, u, system.parameters, G)
        if i % N == 0:
            residual = np.empty(len(system.R))
            system.residual(measurements[i // N], x, residual)
            K = np.linalg.solve(system.H @ P @ system.H.T + system.R, system.H @ P).T
            predicted += F @ K @ residual
            P = P - K @ system.H @ P
        x, P = predicted, F @ P @ F.T + G @ system.Q @ G.T
    return x


def test_without_uncertainty_it_is_the_extended_kalman_filter() -> None:
    short, scaling = simulate_cargo_drive(0.5), attitude_scaling()
    measured = np.column_stack([short.imu_attitude[:, :2], held_yaw(short)])
    start, P = np.append(measured[0], np.zeros(3)), study.ATTITUDE_P0 * np.outer(scaling.unit, scaling.unit)
    attitudes = study.estimate_attitude(short, study.EKF)
    expected = textbook_ekf(attitude(), 1, start, P, short.gyro, measured)
    np.testing.assert_allclose(attitudes.x[-1], expected, rtol=1e-9, atol=1e-12)

    scaling, system = position_scaling(*START), position(START[0], START[2])
    start, P = np.append(short.gps[0], np.zeros(3)), study.POSITION_P0 * np.outer(scaling.unit, scaling.unit)
    positions = study.estimate_position(short, attitudes, study.POSITION_EKF)
    inputs = np.hstack([short.accelerometer, attitudes.x[:-1, :3]])
    expected = textbook_ekf(system, FIX_EVERY, start, P, inputs, short.gps)
    np.testing.assert_allclose(positions.scaled_x[-1], (expected - scaling.origin) / scaling.unit, rtol=0, atol=1e-6)


# ----------------------------------------------------------------------------------------------------- the claims


@pytest.mark.parametrize("method", study.ATTITUDE_METHODS[:5])
@pytest.mark.parametrize("scale_error", study.SCALE_ERRORS)
def test_yaw_follows_gps_and_not_the_unit(method: AttitudeMethod, scale_error: float) -> None:
    """As the paper's Fig. 5(c) says, and true of the EKF as much as of the robust filter."""
    result = attitude_result(method, scale_error)
    assert result.yaw_from_imu_deg > 7 * result.yaw_from_gps_deg
    assert result.yaw_from_gps_deg < 0.5
    assert (result.errors_deg < [0.06, 0.06, 0.4]).all()


def test_robustness_pays_where_the_scale_is_wrong_by_10_percent() -> None:
    ekf, robust, more = (attitude_result(m, 0.10) for m in (study.EKF, study.ROBUST, study.MORE_ROBUST))
    assert (robust.yaw_by_seed_deg < 0.85 * ekf.yaw_by_seed_deg).all()
    assert (more.yaw_by_seed_deg < 0.65 * ekf.yaw_by_seed_deg).all()


def test_robustness_does_not_pay_where_the_scale_is_wrong_by_2_percent() -> None:
    """mu = 1e5 is as good as the EKF, to within 5 %, and mu = 1e4 is worse in all three angles."""
    ekf, robust, more = (attitude_result(m, 0.02) for m in (study.EKF, study.ROBUST, study.MORE_ROBUST))
    assert robust.errors_deg[2] == pytest.approx(ekf.errors_deg[2], rel=0.05)
    assert (more.errors_deg > 1.1 * ekf.errors_deg).all()


@pytest.mark.parametrize(
    ("scale_error", "elsewhere_deg"), [(0.02, [0.119, 0.119, 0.134, 0.136]), (0.10, [0.396, 0.329, 0.203, 0.179])]
)
def test_yaw_errors_are_of_the_size_and_order_found_elsewhere(scale_error: float, elsewhere_deg: list[float]) -> None:
    """Elsewhere: another program, another simulated drive with the same sensors, and the block system by Givens."""
    methods = (study.EKF, study.ROBUST, study.MORE_ROBUST, study.INFLATED)
    found = np.array([attitude_result(method, scale_error).errors_deg[2] for method in methods])
    ratio = found / elsewhere_deg
    assert ((ratio > 1 / 1.5) & (ratio < 1.5)).all()
    assert (np.diff(found[1:]) > 0).all() if scale_error == 0.02 else (np.diff(found[:3]) < 0).all()


@pytest.mark.parametrize("scale_error", study.SCALE_ERRORS)
def test_the_gain_is_that_of_more_process_noise(scale_error: float) -> None:
    """With I/mu alone and no uncertain row, yaw is as good, to within 5 %."""
    robust, inflated = (attitude_result(m, scale_error) for m in (study.MORE_ROBUST, study.INFLATED))
    assert inflated.errors_deg[2] == pytest.approx(robust.errors_deg[2], rel=0.05)


def test_infinite_mu_turns_uncertain_rows_into_wrong_equations() -> None:
    """ "gyro": yaw is lost. "bias": several times the EKF's error. "all": the yaw is the measured one."""
    ekf, gyro, bias, everything = (
        attitude_result(m, 0.02) for m in (study.EKF, study.LIMIT_GYRO, study.LIMIT_BIAS, study.LIMIT_ALL)
    )
    assert gyro.errors_deg[2] > 3.0
    assert bias.errors_deg[2] > 4 * ekf.errors_deg[2]
    assert 0.5 < everything.errors_deg[2] < 0.9
    assert attitude_result(study.LIMIT_ALL, 0.10).errors_deg[2] == pytest.approx(everything.errors_deg[2], rel=0.01)


@pytest.mark.parametrize("method", [study.POSITION_EKF, study.POSITION_ROBUST])
def test_position_between_fixes_is_as_good_as_at_fixes(method: PositionMethod) -> None:
    result, raw = position_result(method), study.raw_result(SEEDS)
    np.testing.assert_allclose(result.between_m, result.after_fix_m, rtol=0.02)
    assert (result.between_m < raw.gps_m / 5).all()
    assert (result.between_m < 0.1).all()
    np.testing.assert_allclose(result.between_velocity, result.after_fix_velocity, rtol=0.05)
    assert (result.between_velocity < 0.03).all()


def test_robustness_does_not_pay_in_position() -> None:
    robust, ekf = position_result(study.POSITION_ROBUST), position_result(study.POSITION_EKF)
    np.testing.assert_allclose(robust.between_m, ekf.between_m, rtol=0.1)
    assert (position_result(study.POSITION_LIMIT).between_m > 1.5 * ekf.between_m).all()


def test_a_row_that_states_the_true_error_of_the_accelerometers_makes_the_position_worse() -> None:
    """Without GPS, where their scale is wrong by 10 %; what states 0.5 % does not."""
    ekf, scale, stated = (
        study.position_result(method, (0.10, 0.10), SEEDS[:1])
        for method in (study.POSITION_EKF, study.POSITION_SCALE, study.POSITION_STATED)
    )
    assert scale.outage_end_m == pytest.approx(ekf.outage_end_m, rel=0.3)
    assert stated.outage_end_m > 3 * ekf.outage_end_m


@pytest.mark.parametrize("method", [study.POSITION_EKF, study.POSITION_ROBUST])
def test_ten_seconds_without_gps_cost_about_a_metre_and_a_degree(method: PositionMethod) -> None:
    """The yaw drifts with the unit's: its correction is held on."""
    result = position_result(method)
    assert 0.2 < attitude_result(method.attitude, 0.02).outage_yaw_deg < 1.0
    assert (result.outage_m < 1.0).all()
    assert result.outage_end_m < 1.5


def test_results_are_all_there_and_frozen() -> None:
    found = study.results(seeds=[0], scale_errors=[0.02], position_errors=[(0.02, 0.02)])
    assert [row.method for row in found.attitude] == [method.name for method in study.ATTITUDE_METHODS]
    assert [row.method for row in found.position] == [method.name for method in study.POSITION_METHODS]
    for array in (found.raw.gps_m, found.attitude[0].errors_deg, found.position[0].between_m):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


def test_figures() -> None:
    attitudes = study.estimate_attitude(drive(), study.ROBUST)
    figures = study.figures(drive(), attitudes, study.estimate_position(drive(), attitudes, study.POSITION_ROBUST))
    assert len(figures.time_s[figures.close_up]) == 401
    assert len(figures.fix_time_s[figures.close_up_fixes]) == 11
    assert figures.fix_time_s[figures.close_up_fixes][0] == figures.time_s[figures.close_up][0] == 40.0
    assert np.abs(figures.route_m - figures.true_route_m).max() < 1.5
    assert np.abs(figures.gps_route_m).max() > 100
    assert np.abs(wrap(np.radians(figures.attitude_deg - figures.true_attitude_deg))).max() < np.radians(1.5)
    assert np.ptp(figures.attitude_deg[:, 2]) > 20 * np.ptp(figures.attitude_deg[:, :2], axis=0).max()
    with pytest.raises(ValueError, match="read-only"):
        figures.route_m[0] = 0.0
