"""Models that come with the project: typical sensors, each figure with its public source, or said to be assumed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import radians, sqrt
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from filters.accuracy.model import LinearModel, linear_model
from filters.accuracy.van_loan import discretised
from filters.arrays import FloatArray
from filters.choice import check_choice


class Output(NamedTuple):
    """Some states that belong together. states: their numbers, first and after the last."""

    first: int
    end: int
    unit: str

    @property
    def states(self) -> list[int]:
        return list(range(self.first, self.end))


class ShippedModel(NamedTuple):
    """model(hr_hz): at that high rate. N, M: at `hr_hz`, of a measurement every interval_s that is delay_s late.

    outputs: by name; the first is the one that is meant if none is named. source: which figures are from where, and
    which are this project's assumptions.
    """

    name: str
    what: str
    source: str
    model: Callable[[float], LinearModel]
    outputs: Mapping[str, Output]
    hr_hz: float
    interval_s: float
    delay_s: float

    @property
    def output(self) -> str:
        return next(iter(self.outputs))

    @property
    def N(self) -> int:
        return round(self.interval_s * self.hr_hz)

    @property
    def M(self) -> int:
        return round(self.delay_s * self.hr_hz)

    @property
    def unit(self) -> str:
        return self.outputs[self.output].unit


def shipped_model(name: str) -> ShippedModel:
    """Raises ValueError, listing them, for a name that there is not."""
    check_choice("model", name, SHIPPED_MODELS)
    return SHIPPED_MODELS[name]


def _inertial(position_sigma: float) -> Callable[[float], LinearModel]:
    """Errors of position, velocity and tilt in a level frame that turns with the vehicle."""
    turn_rate = np.array([0.0, 0.0, 0.2])  # rad/s, as of 15 m/s on a circle of 75 m
    force = np.array([0.0, 3.0, 9.81])  # m/s^2: 15 m/s at 0.2 rad/s, and gravity
    accelerometer, gyro = 0.035, 0.0015  # m/s / sqrt(s), rad / sqrt(s)

    def model(hr_hz: float) -> LinearModel:
        turning, leaning = _cross(turn_rate), _cross(force)
        A = np.zeros((9, 9))
        A[:3, :3] = A[3:6, 3:6] = A[6:, 6:] = -turning
        A[:3, 3:6] = np.eye(3)
        A[3:6, 6:] = -leaning
        density = np.diag([0.0] * 3 + [accelerometer**2] * 3 + [gyro**2] * 3)
        Phi, Q = discretised(A, density, _period_s(hr_hz))
        names = [f"{what} {axis}" for what in ("position", "velocity", "tilt") for axis in "xyz"]
        return linear_model(Phi, Q, np.eye(3, 9), position_sigma**2 * np.eye(3), names)

    return model


def _star_tracker(hr_hz: float) -> LinearModel:
    """One axis: an attitude and the drift of its gyro.

    R. L. Farrenkopf, Analytic steady-state accuracy solutions for two common spacecraft attitude estimators, Journal of
    Guidance and Control 1, 1978.
    """
    walk, drift, tracker = sqrt(10.0) * 1e-7, sqrt(10.0) * 1e-10, radians(0.005)
    Phi, Q = discretised(np.array([[0.0, -1.0], [0.0, 0.0]]), np.diag([walk**2, drift**2]), _period_s(hr_hz))
    return linear_model(Phi, Q, [[1.0, 0.0]], [[tracker**2]], ["attitude", "gyro drift"])


def _camera(hr_hz: float) -> LinearModel:
    """One axis: position, velocity and acceleration, which wanders."""
    Phi, Q = discretised(np.diag([1.0, 1.0], 1), np.diag([0.0, 0.0, 50.0]), _period_s(hr_hz))
    return linear_model(Phi, Q, [[1.0, 0.0, 0.0]], [[0.01**2]], ["position", "velocity", "acceleration"])


def _period_s(hr_hz: float) -> float:
    if not 0.0 < hr_hz < np.inf:
        raise ValueError(f"hr_hz={hr_hz!r} must be a positive number of steps in a second")
    return 1.0 / hr_hz


def _cross(v: FloatArray) -> FloatArray:
    """[v]x, so that [v]x u = v x u."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


_INERTIAL_OUTPUTS = {"position": Output(0, 3, "m"), "velocity": Output(3, 6, "m/s"), "tilt": Output(6, 9, "rad")}

_AUTOPILOT = (
    "defaults of PX4-Autopilot, src/modules/ekf2: EKF2_ACC_NOISE 0.35 m/s^2 and EKF2_GYR_NOISE 0.015 rad/s in each "
    "10 ms of EKF2_PREDICT_US (module.yaml), so 0.035 m/s/sqrt(s) and 0.0015 rad/sqrt(s); EKF2_GPS_DELAY 110 ms "
    "(params_gnss.yaml)"
)
_TURN = "assumed: 400 Hz, 5 Hz, the turn of 15 m/s at 0.2 rad/s"

SHIPPED_MODELS: Mapping[str, ShippedModel] = MappingProxyType(
    {
        model.name: model
        for model in (
            ShippedModel(
                "ins-gps",
                "inertial navigation in a turn, with GPS positions at 5 Hz, 110 ms late",
                f"{_AUTOPILOT}, EKF2_GPS_P_NOISE 0.5 m (there too); {_TURN}, that noise also of the height",
                _inertial(0.5),
                MappingProxyType(_INERTIAL_OUTPUTS),
                400.0,
                0.2,
                0.11,
            ),
            ShippedModel(
                "ins-rtk",
                "the same with RTK positions",
                f"{_AUTOPILOT}; u-blox, ZED-F9P integration manual, UBX-18010802 R16, section 2.1.2: RTK to 0.01 m + "
                f"1 ppm CEP, of which 2 cm on each axis is an assumption, twice as much; {_TURN}",
                _inertial(0.02),
                MappingProxyType(_INERTIAL_OUTPUTS),
                400.0,
                0.2,
                0.11,
            ),
            ShippedModel(
                "star-tracker",
                "attitude of a spacecraft about one axis, a gyro of navigation grade and a star tracker at 2 Hz, "
                "200 ms late",
                "gyro sqrt(10) 1e-7 rad/sqrt(s) and sqrt(10) 1e-10 rad/s^(3/2): J. L. Crassidis and J. L. Junkins, "
                "Optimal Estimation of Dynamic Systems, 2nd ed., 2012, Examples 3.3 and 7.1, by the authors' programs "
                "for them; assumed: tracker 0.005 deg, one standard deviation (three in Example 7.1, of each star), "
                "100 Hz, 2 Hz, the delay",
                _star_tracker,
                MappingProxyType({"attitude": Output(0, 1, "rad"), "drift": Output(1, 2, "rad/s")}),
                100.0,
                0.5,
                0.2,
            ),
            ShippedModel(
                "camera",
                "a vehicle that a camera sees, one axis, at 20 Hz, 30 ms late",
                "acceleration as a Wiener process: Y. Bar-Shalom, X. R. Li and T. Kirubarajan, Estimation with "
                "Applications to Tracking and Navigation, 2001, section 6.2.3; assumed: all figures, namely jerk "
                "50 m^2/s^5, markers to 1 cm, 200 Hz, 20 Hz, the delay",
                _camera,
                MappingProxyType(
                    {
                        "position": Output(0, 1, "m"),
                        "velocity": Output(1, 2, "m/s"),
                        "acceleration": Output(2, 3, "m/s^2"),
                    }
                ),
                200.0,
                0.05,
                0.03,
            ),
        )
    }
)
