"""The numbers of the rocket's setting in the text of the report on modular filters."""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.systems.rocket import PAD_S, RATE_HZ, THRUST_AT_S
from filters.systems.rocket_filter import (
    ACCELEROMETER,
    BAROMETER,
    BRIDGED_S,
    CAMERA,
    GPS,
    GRAVITY,
    GYRO,
    TUNED,
    sensors,
)
from reports.modular.results import Results
from reports.modular.schedule_gantt import DELAY
from studies.modular.rocket import CLAIM_PERCENT
from studies.modular.rocket_schedule import PERIOD_MS

ONSET_S = 0.3
"""By then the thrust is there."""


def setting_words(results: Results) -> dict[str, Any]:
    """Rates and delays of sensors; how far the acceleration of the flight that is drawn jumps as the motor burns."""
    flight = results.columns("flight")
    jumped = flight["acceleration true"][(flight["time_s"] >= 0) & (flight["time_s"] <= ONSET_S)]
    late = {
        sensor.name: f"{RATE_HZ / float(sensor.every):g} Hz ({PERIOD_MS * sensor.longest_delay:g} ms"
        for sensor in sensors()
        if sensor.name in (BAROMETER, CAMERA, GPS)
    }
    return {
        **late,
        "noise": rocket_noise(),
        "process": {
            "jerk": f"{TUNED.jerk:g}",
            "angular": [f"{density:g}" for density in (TUNED.roll, TUNED.across)],
            "bridged_ms": f"{1000 * BRIDGED_S:g}",
        },
        "hz": RATE_HZ,
        "pad": f"{PAD_S:g}",
        "onset": f"{1000 * THRUST_AT_S[1]:g}",
        "jump": f"{np.ptp(jumped) / GRAVITY:.0f}",
        "quaternion": f"{np.degrees(4 * np.arcsin(CLAIM_PERCENT / 200)):.0f}",
        "fix": f"{PERIOD_MS * DELAY:g}",
    }


def rocket_noise() -> dict[str, Any]:
    """Standard deviations of the rocket's sensors; of GPS level and upward, first of position, then of velocity; of the
    camera in degrees."""
    sigmas = {sensor.name: np.sqrt(np.diagonal(sensor.corrector.R)) for sensor in sensors()}
    level, up = sigmas[GPS][[0, 3]], sigmas[GPS][[2, 5]]
    return {
        "level": [f"{sigma:g}" for sigma in level],
        "up": [f"{sigma:g}" for sigma in up],
        "camera": f"{np.degrees(sigmas[CAMERA][0]):g}",
        **{
            word: f"{sigmas[name][0]:g}"
            for word, name in (("barometer", BAROMETER), ("gyro", GYRO), ("accelerometer", ACCELEROMETER))
        },
    }
