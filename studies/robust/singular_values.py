"""Do Givens rotations give the same covariance as an inverse? Its singular values over a drive, by independent filters.

Figures 7 and 8 of "Computation of Extended Robust Kalman Filter for Real-Time Attitude and Position Estimation"
(arXiv:1801.04386): the largest and the smallest singular value of P, of the attitude and of the position filter. The
paper compares absolute differences. Relative ones say more: where states are not scaled, the smallest singular value is
so small that an absolute difference is nothing whatever happens. The paper's remark that "the result of the LU
decomposition method was unstable and did not converge" is looked at too: it holds without pivoting, which meets a zero
at once where mu is infinite, and not with it. All ways make P symmetric in every step.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.robust import extended as extended_robust
from filters.robust.extended import ExtendedHistory
from filters.robust.uncertain import Scaling
from filters.systems.drive import FIX_EVERY, RATE_HZ, START, CargoDrive, simulate_cargo_drive
from filters.systems.position import position, position_scaling, position_uncertainty
from studies.robust.drive import (
    LIMIT_ALL,
    LIMIT_BIAS,
    POSITION_LIMIT,
    POSITION_P0,
    POSITION_ROBUST,
    ROBUST,
    AttitudeMethod,
    PositionMethod,
    estimate_attitude,
    estimate_position,
    frozen,
)

REFERENCE = "inverse"
WAYS = ("givens", "lu", "lu without pivoting")
"""Each compared with an explicit inverse."""


class Case(NamedTuple):
    """A filter. scaled: false for latitude and longitude in radians and biases in m/s^2."""

    name: str
    method: AttitudeMethod | PositionMethod
    scaled: bool = True


CASES = (
    Case("attitude, bias row, mu=inf", LIMIT_BIAS),
    Case("attitude, all rows, mu=inf", LIMIT_ALL),
    Case("attitude, gyro row, mu=1e5", ROBUST),
    Case("position, bias row, mu=inf", POSITION_LIMIT),
    Case("position, bias row, mu=1e8", POSITION_ROBUST),
    Case("position in radians, bias row, mu=inf", POSITION_LIMIT, scaled=False),
)


class SingularValues(NamedTuple):
    """Those of P in some steps of a run by one way: time_s, largest, smallest (samples,); nan where P is not finite."""

    case: Case
    way: str
    time_s: FloatArray
    largest: FloatArray
    smallest: FloatArray


class Agreement(NamedTuple):
    """The largest differences from the inverse, over all steps in which both are finite.

    relative: of the largest and of the smallest singular value. state: of a scaled state. first_failure: the first step
    that is not finite, if any.
    """

    case: Case
    way: str
    absolute_largest: float
    absolute_smallest: float
    relative_largest: float
    relative_smallest: float
    state: float
    first_failure: int | None


class Comparison(NamedTuple):
    """curves: of the inverse and of the other ways, sampled. agreements: of the other ways."""

    curves: tuple[SingularValues, ...]
    agreements: tuple[Agreement, ...]


def run_case(case: Case, drive: CargoDrive, way: str) -> ExtendedHistory:
    """A filter over the whole drive by one way: each step starts from what the same way gave before.

    The attitudes that a position filter is fed with are always those of the closed form.
    """
    if isinstance(case.method, AttitudeMethod):
        return estimate_attitude(drive, case.method, way=way)
    attitudes = estimate_attitude(drive, case.method.attitude)
    if case.scaled:
        return estimate_position(drive, attitudes, case.method, way=way)
    return _unscaled_position(drive, attitudes, case.method, way)


def compare(
    case: Case, seconds: float = 100.0, ways: Sequence[str] = WAYS, sample_every: int = 100, seed: int = 0
) -> Comparison:
    """The singular values of each way and of the inverse, over a drive of so many seconds.

    sample_every: steps between the points of a curve; differences are taken in every step.
    """
    drive = simulate_cargo_drive(seconds, seed=seed)
    expected = run_case(case, drive, REFERENCE)
    expected_values = singular_values(expected.P)
    curves, agreements = [_sampled(case, REFERENCE, expected_values, sample_every)], []
    for way in ways:
        history = run_case(case, drive, way)
        values = singular_values(history.P)
        curves.append(_sampled(case, way, values, sample_every))
        agreements.append(_agreement(case, way, history, values, expected, expected_values))
    return Comparison(tuple(curves), tuple(agreements))


def singular_values(P: FloatArray) -> FloatArray:
    """Largest and smallest (steps, 2) of P (steps, n, n); nan where it is not finite."""
    finite = np.isfinite(P).all(axis=(1, 2))
    values = np.full((len(P), 2), np.nan)
    values[finite] = np.linalg.svd(P[finite], compute_uv=False)[:, [0, -1]]
    return values


def _agreement(
    case: Case,
    way: str,
    history: ExtendedHistory,
    values: FloatArray,
    expected: ExtendedHistory,
    expected_values: FloatArray,
) -> Agreement:
    both = np.isfinite(values).all(axis=1) & np.isfinite(expected_values).all(axis=1)
    failed = np.flatnonzero(~np.isfinite(values).all(axis=1))
    difference = np.abs(values - expected_values)[both]
    relative = difference / expected_values[both]
    return Agreement(
        case,
        way,
        absolute_largest=difference[:, 0].max(),
        absolute_smallest=difference[:, 1].max(),
        relative_largest=relative[:, 0].max(),
        relative_smallest=relative[:, 1].max(),
        state=np.abs(history.scaled_x - expected.scaled_x)[both].max(),
        first_failure=int(failed[0]) if len(failed) else None,
    )


def _sampled(case: Case, way: str, values: FloatArray, every: int) -> SingularValues:
    largest, smallest = values[::every].T
    time_s = np.arange(len(values))[::every] / RATE_HZ
    return frozen(SingularValues(case, way, time_s, largest.copy(), smallest.copy()))


def _unscaled_position(
    drive: CargoDrive, attitudes: ExtendedHistory, method: PositionMethod, way: str
) -> ExtendedHistory:
    unit = position_scaling(*START).unit
    uncertainty = position_uncertainty(method.rows)
    uncertainty = uncertainty._replace(E_F=uncertainty.E_F / unit)
    inputs = np.hstack([drive.accelerometer, attitudes.x[:-1, :3]])
    return extended_robust.run(
        position(START[0], START[2]), Scaling(np.zeros(9), np.ones(9), np.ones(6)), uncertainty, FIX_EVERY,
        np.append(drive.gps[0], np.zeros(3)), POSITION_P0 * np.outer(unit, unit), inputs, drive.gps,
        mu=method.mu, way=way,
    )  # fmt: skip
