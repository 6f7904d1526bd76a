"""Does robustness pay on a drive? The extended robust Kalman filter beside the extended one, on a simulated vehicle.

The questions of "Computation of Extended Robust Kalman Filter for Real-Time Attitude and Position Estimation"
(arXiv:1801.04386, section 5), with a truth to measure errors from, which the paper's own drive did not have: does the
yaw follow GPS rather than the inertial unit, are positions at 400 Hz as good as at 10 Hz, and is the robust filter
better than the extended one when the gyros' scale is wrong?

It is at a scale error of 10 %, for a finite mu: the yaw's error falls from 0.30 to 0.17 degrees, while roll and pitch
get worse. But I/mu alone, which is process noise on every state, does the same. At 2 % nothing is gained. In position
20 drives show no gain either, with accelerometers wrong by 0.2, 2 and 10 %, and a loss where a row states the 10 %.
With an infinite mu the uncertain rows become exact equations, which cost more accuracy than any scale error does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray
from filters.robust import extended as extended_robust
from filters.robust.extended import ExtendedHistory
from filters.systems.attitude import AttitudeRows, attitude, attitude_scaling, attitude_uncertainty
from filters.systems.drive import (
    FIX_EVERY,
    RATE_HZ,
    START,
    CargoDrive,
    held_yaw,
    position_to_metres,
    simulate_cargo_drive,
    wrap,
)
from filters.systems.position import PositionRows, position, position_scaling, position_uncertainty
from studies.modular.rms import rms as over_runs

Record = TypeVar("Record", bound=tuple[Any, ...])

SCALE_ERRORS = (0.02, 0.10)
ACCELEROMETER_ERROR = 0.002
"""Of the accelerometers' scale, where only the gyros' is much wrong."""
GYROS_ALONE = (0.10, ACCELEROMETER_ERROR)
POSITION_ERRORS = ((0.02, ACCELEROMETER_ERROR), GYROS_ALONE, (0.02, 0.02), (0.10, 0.10))
"""Of the scales of gyros and accelerometers."""
SEEDS = tuple(range(20))
SETTLED_S = 5.0
"""Errors count from here on: before, the filters learn the biases."""

OUTAGE_S = (50.0, 60.0)
"""Without GPS: most of it a straight road, then the start of a turn."""

ATTITUDE_P0 = np.diag([1.0, 1.0, 1.0, 0.25, 0.25, 0.25])
POSITION_P0 = np.diag([0.25, 0.25, 1.0, 0.0025, 0.0025, 0.0025, 0.25, 0.25, 0.25])


class AttitudeMethod(NamedTuple):
    """rows: what is said to be uncertain. gyro_noise: the filter's, as a multiple of the true one. stated: the error of
    the scale that a row of it states."""

    name: str
    rows: AttitudeRows = "none"
    mu: float = np.inf
    gyro_noise: float = 1.0
    stated: float = 0.02


class PositionMethod(NamedTuple):
    """The same as `AttitudeMethod`; attitude: the method that feeds it."""

    name: str
    attitude: AttitudeMethod
    rows: PositionRows = "none"
    mu: float = np.inf
    stated: float = 0.005


EKF = AttitudeMethod("EKF")
ROBUST = AttitudeMethod("ERKF mu=1e5, gyro row", "gyro", 1e5)
MORE_ROBUST = AttitudeMethod("ERKF mu=1e4, gyro row", "gyro", 1e4)
INFLATED = AttitudeMethod("KF with I/mu only, mu=1e4", "none", 1e4)
NOISIER = AttitudeMethod("EKF, gyro noise x 16", gyro_noise=16.0)
LIMIT_GYRO = AttitudeMethod("ERKF mu=inf, gyro row", "gyro")
LIMIT_BIAS = AttitudeMethod("ERKF mu=inf, bias row", "bias")
LIMIT_ALL = AttitudeMethod("ERKF mu=inf, all rows", "all")
STATED = AttitudeMethod("ERKF mu=1e4, gyro row of 10 %", "gyro", 1e4, stated=0.10)
ATTITUDE_METHODS = (EKF, ROBUST, MORE_ROBUST, STATED, INFLATED, NOISIER, LIMIT_GYRO, LIMIT_BIAS, LIMIT_ALL)
"""The noisier EKF has as much process noise in its angles as mu = 1e4 adds to all states."""

POSITION_EKF = PositionMethod("EKF", EKF)
POSITION_ROBUST = PositionMethod("ERKF mu=1e8, bias row", ROBUST, "bias", 1e8)
POSITION_LIMIT = PositionMethod("ERKF mu=inf, bias row", ROBUST, "bias")
POSITION_SCALE = PositionMethod("ERKF mu=1e8, accelerometer row", ROBUST, "accelerometer", 1e8)
POSITION_STATED = PositionMethod("ERKF mu=1e8, accelerometer row of 10 %", ROBUST, "accelerometer", 1e8, stated=0.10)
POSITION_INFLATED = PositionMethod("KF with I/mu only, mu=1e8", ROBUST, "none", 1e8)
POSITION_METHODS = (
    POSITION_EKF,
    PositionMethod("EKF on robust attitude", ROBUST),
    POSITION_ROBUST,
    POSITION_SCALE,
    POSITION_STATED,
    POSITION_INFLATED,
    POSITION_LIMIT,
    PositionMethod("ERKF mu=inf, accelerometer row", ROBUST, "accelerometer"),
)


class AttitudeResult(NamedTuple):
    """Root mean squares over all seeds, degrees.

    errors_deg (3,): of roll, pitch, yaw. yaw_from_gps_deg: from the fixes, when they come. yaw_from_imu_deg: from the
    unit's own yaw. outage_yaw_deg: error of the yaw in ten seconds without GPS. standard_errors_deg (6,): of all these.
    yaw_by_seed_deg (seeds,): of the yaw.
    """

    method: str
    scale_error: float
    errors_deg: FloatArray
    yaw_from_gps_deg: float
    yaw_from_imu_deg: float
    outage_yaw_deg: float
    standard_errors_deg: FloatArray
    yaw_by_seed_deg: FloatArray


class PositionResult(NamedTuple):
    """Root mean squares over all seeds: north, east, down (3,), metres or m/s.

    after_fix_m, after_fix_velocity: of the first prediction that a fix is in. between_m, between_velocity: of the 39
    others before the next. outage_m: in ten seconds without GPS; outage_end_m: horizontal error at their end.
    between_standard_error_m, outage_end_standard_error_m: of these two.
    """

    method: str
    scale_error: float
    accelerometer_error: float
    after_fix_m: FloatArray
    between_m: FloatArray
    after_fix_velocity: FloatArray
    between_velocity: FloatArray
    outage_m: FloatArray
    outage_end_m: float
    between_standard_error_m: FloatArray
    outage_end_standard_error_m: float


class RawResult(NamedTuple):
    """What there is without a filter, root mean squares over all seeds.

    imu_yaw_deg, gps_yaw_deg: errors. gps_m (3,): of a fix; held_m (3,): of the last fix, until the next.
    """

    imu_yaw_deg: float
    gps_yaw_deg: float
    gps_m: FloatArray
    held_m: FloatArray


class Results(NamedTuple):
    """For each scale error, all methods."""

    attitude: tuple[AttitudeResult, ...]
    position: tuple[PositionResult, ...]
    raw: RawResult


class DriveFigures(NamedTuple):
    """What Figures 3 to 6 of the paper show. Routes are north, east, up from the start (m); angles in (-180, 180] deg.

    time_s (steps + 1,), fix_time_s (fixes,). route_m, true_route_m (steps + 1, 3), gps_route_m (fixes, 3): Figs. 3, 6.
    close_up, close_up_fixes: indices of one second of the route and of its fixes, Fig. 4.
    attitude_deg, true_attitude_deg (steps + 1, 3), imu_attitude_deg (steps, 3), gps_yaw_deg (fixes,): Fig. 5.
    """

    time_s: FloatArray
    fix_time_s: FloatArray
    route_m: FloatArray
    true_route_m: FloatArray
    gps_route_m: FloatArray
    close_up: slice
    close_up_fixes: slice
    attitude_deg: FloatArray
    true_attitude_deg: FloatArray
    imu_attitude_deg: FloatArray
    gps_yaw_deg: FloatArray


def estimate_attitude(
    drive: CargoDrive, method: AttitudeMethod, available: NDArray[np.bool_] | None = None, way: str = "closed"
) -> ExtendedHistory:
    """At 400 Hz, from the gyros and from the unit's angles with the yaw correction of the last fix.

    available (fixes,): false where GPS is missing.
    """
    measured = np.column_stack([drive.imu_attitude[:, :2], held_yaw(drive, available)])
    system = attitude(gyro_sigma=0.0025 * method.gyro_noise)
    start = np.append(measured[0], np.zeros(3))
    scaling, uncertainty = attitude_scaling(), attitude_uncertainty(method.rows, method.stated)
    return extended_robust.run(
        system, scaling, uncertainty, 1, start, ATTITUDE_P0, drive.gyro, measured, mu=method.mu, way=way
    )


def estimate_position(
    drive: CargoDrive,
    attitudes: ExtendedHistory,
    method: PositionMethod,
    available: NDArray[np.bool_] | None = None,
    way: str = "closed",
) -> ExtendedHistory:
    """At 400 Hz, from the accelerometers and the attitudes of `estimate_attitude`, with a fix in each 40th step."""
    system, scaling = position(START[0], START[2]), position_scaling(*START)
    inputs = np.hstack([drive.accelerometer, attitudes.x[:-1, :3]])
    start, uncertainty = np.append(drive.gps[0], np.zeros(3)), position_uncertainty(method.rows, method.stated)
    return extended_robust.run(
        system, scaling, uncertainty, FIX_EVERY, start, POSITION_P0, inputs, drive.gps, available,
        mu=method.mu, way=way,
    )  # fmt: skip


def results(
    seeds: Sequence[int] = SEEDS,
    scale_errors: Sequence[float] = SCALE_ERRORS,
    position_errors: Sequence[tuple[float, float]] = POSITION_ERRORS,
) -> Results:
    """The whole study, about five minutes."""
    return Results(
        tuple(attitude_result(method, error, seeds) for error in scale_errors for method in ATTITUDE_METHODS),
        tuple(position_result(method, errors, seeds) for errors in position_errors for method in POSITION_METHODS),
        raw_result(seeds),
    )


def attitude_result(method: AttitudeMethod, scale_error: float, seeds: Sequence[int] = SEEDS) -> AttitudeResult:
    """The result of one method, over a drive of each seed."""
    errors, from_gps, from_imu, outage = [], [], [], []
    for seed in seeds:
        drive = simulate_cargo_drive(scale_error=scale_error, seed=seed)
        attitude = estimate_attitude(drive, method).x[:, :3]
        settled = drive.time_s >= SETTLED_S
        yaw, counted = attitude[:-1, 2], settled[:-1]
        errors.append(np.degrees(attitude - drive.attitude)[settled])
        from_gps.append(np.degrees(wrap(yaw[::FIX_EVERY] - drive.gps_yaw))[counted[::FIX_EVERY]])
        from_imu.append(np.degrees(wrap(yaw - drive.imu_attitude[:, 2]))[counted])
        blind = estimate_attitude(drive, method, outage_fixes(drive)).x[:, 2]
        outage.append(np.degrees(blind - drive.attitude[:, 2])[during(OUTAGE_S, drive.time_s)])
    found_deg = over_runs([*_columns(errors), from_gps, from_imu, outage])
    from_gps_deg, from_imu_deg, outage_deg = map(float, found_deg.rms[3:])
    yaw_by_seed_deg = np.array([float(_rms_of([error[:, 2]])) for error in errors])
    by_method = AttitudeResult(
        method.name, scale_error, found_deg.rms[:3], from_gps_deg, from_imu_deg, outage_deg, found_deg.standard_error,
        yaw_by_seed_deg,
    )  # fmt: skip
    return frozen(by_method)


def position_result(
    method: PositionMethod, scale_errors: tuple[float, float], seeds: Sequence[int] = SEEDS
) -> PositionResult:
    """The result of one method, over a drive of each seed and the same drive with an outage.

    scale_errors: of gyros and accelerometers.
    """
    scale_error, accelerometer_error = scale_errors
    after, between, after_velocity, between_velocity, outage, ends = [], [], [], [], [], []
    for seed in seeds:
        drive = simulate_cargo_drive(scale_error=scale_error, seed=seed, accelerometer_error=accelerometer_error)
        step = np.arange(len(drive.time_s))
        settled, fresh = drive.time_s >= SETTLED_S, step % FIX_EVERY == 1
        history = estimate_position(drive, estimate_attitude(drive, method.attitude), method)
        error_m = position_to_metres(history.x[:, :3] - drive.position)
        after.append(error_m[settled & fresh])
        between.append(error_m[settled & ~fresh])
        error = history.x[:, 3:6] - drive.velocity
        after_velocity.append(error[settled & fresh])
        between_velocity.append(error[settled & ~fresh])

        available = outage_fixes(drive)
        attitudes = estimate_attitude(drive, method.attitude, available)
        blind = estimate_position(drive, attitudes, method, available)
        error_m = position_to_metres(blind.x[:, :3] - drive.position)[during(OUTAGE_S, drive.time_s)]
        outage.append(error_m)
        ends.append(np.hypot(error_m[-1:, 0], error_m[-1:, 1]))
    found_m = over_runs([*_columns(between), ends])
    by_method = PositionResult(
        method.name, scale_error, accelerometer_error, _rms_of(after), found_m.rms[:3], _rms_of(after_velocity),
        _rms_of(between_velocity), _rms_of(outage), float(found_m.rms[3]), found_m.standard_error[:3],
        float(found_m.standard_error[3]),
    )  # fmt: skip
    return frozen(by_method)


def raw_result(seeds: Sequence[int] = SEEDS) -> RawResult:
    """The measurements themselves; the scale of the gyros is not in them."""
    imu_yaw, gps_yaw, gps, held = [], [], [], []
    for seed in seeds:
        drive = simulate_cargo_drive(seed=seed)
        settled = drive.time_s[:-1] >= SETTLED_S
        true_yaw, at_fix = drive.attitude[:-1, 2], settled[::FIX_EVERY]
        imu_yaw.append(np.degrees(wrap(drive.imu_attitude[:, 2] - true_yaw))[settled])
        gps_yaw.append(np.degrees(wrap(drive.gps_yaw - true_yaw[::FIX_EVERY]))[at_fix])
        error_m = position_to_metres(np.repeat(drive.gps[:, :3], FIX_EVERY, axis=0) - drive.position[:-1])
        gps.append(error_m[::FIX_EVERY][at_fix])
        held.append(error_m[settled])
    return frozen(RawResult(float(_rms_of(imu_yaw)), float(_rms_of(gps_yaw)), _rms_of(gps), _rms_of(held)))


def figures(drive: CargoDrive, attitudes: ExtendedHistory, positions: ExtendedHistory) -> DriveFigures:
    """The arrays of Figures 3 to 6; none can be written."""
    from_second = 40 if drive.time_s[-1] > 41 else 0
    close_up = slice(from_second * RATE_HZ, (from_second + 1) * RATE_HZ + 1)
    fixes_per_s = RATE_HZ // FIX_EVERY
    shown = DriveFigures(
        drive.time_s.copy(),
        drive.time_s[:-1:FIX_EVERY].copy(),
        _route_m(positions.x[:, :3]),
        _route_m(drive.position),
        _route_m(drive.gps[:, :3]),
        close_up,
        slice(from_second * fixes_per_s, (from_second + 1) * fixes_per_s + 1),
        np.degrees(wrap(attitudes.x[:, :3])),
        np.degrees(wrap(drive.attitude)),
        np.degrees(wrap(drive.imu_attitude)),
        np.degrees(wrap(drive.gps_yaw)),
    )
    return frozen(shown)


def frozen(record: Record) -> Record:
    """The same record; none of its arrays can be written any more."""
    for value in record:
        if isinstance(value, np.ndarray):
            value.setflags(write=False)
    return record


def outage_fixes(drive: CargoDrive) -> NDArray[np.bool_]:
    """Which fixes (fixes,) there are when GPS is out in `OUTAGE_S`."""
    available: NDArray[np.bool_] = ~during(OUTAGE_S, drive.time_s[:-1:FIX_EVERY])
    return available


def during(interval_s: tuple[float, float], time_s: FloatArray) -> NDArray[np.bool_]:
    """Which of these times are in [start, end)."""
    inside: NDArray[np.bool_] = (time_s >= interval_s[0]) & (time_s < interval_s[1])
    return inside


def _rms_of(parts: Sequence[FloatArray]) -> FloatArray:
    """Along the first axis, of all parts together."""
    root: FloatArray = np.sqrt(np.mean(np.concatenate(parts) ** 2, axis=0))
    return root


def _columns(by_run: Sequence[FloatArray]) -> list[list[FloatArray]]:
    """For each column what every run has in it."""
    return [[run[:, column] for run in by_run] for column in range(by_run[0].shape[1])]


def _route_m(positions: FloatArray) -> FloatArray:
    """North, east, up."""
    return position_to_metres(positions - START) * [1.0, 1.0, -1.0]
