"""The numbers of the rocket's setting in the text of the report on modular filters."""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.systems.rocket import PAD_S, RATE_HZ, THRUST_AT_S
from filters.systems.rocket_filter import BAROMETER, CAMERA, GPS, GRAVITY, sensors
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
        "hz": RATE_HZ,
        "pad": f"{PAD_S:g}",
        "onset": f"{1000 * THRUST_AT_S[1]:g}",
        "jump": f"{np.ptp(jumped) / GRAVITY:.0f}",
        "quaternion": f"{np.degrees(4 * np.arcsin(CLAIM_PERCENT / 200)):.0f}",
        "fix": f"{PERIOD_MS * DELAY:g}",
    }
