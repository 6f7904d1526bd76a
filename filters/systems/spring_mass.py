"""A mass on a spring, and a filter that tracks it without knowing of the spring.

State of both: position (m), velocity (m/s), acceleration (m/s^2). The filter takes the jerk for white noise; its
sensors are of position and of acceleration, each with its own rate and dropout. After MacCormack and Rubinstein,
"Implementation of a Modular Linear and Unscented Kalman Filter", which gives no numbers: those here are ours.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray
from filters.modular import ModularFilter, Sensor, linear_corrector, linear_predictor

POSITION, VELOCITY, ACCELERATION = range(3)


class Oscillator(NamedTuple):
    """Lightly damped: in 20 periods the amplitude falls to two thirds."""

    mass_kg: float = 1.0
    spring_n_m: float = 10.0
    damping_n_s_m: float = 0.02


class Instrument(NamedTuple):
    """sigma: of its white noise; every: steps between measurements; dropout: the probability that one is lost."""

    sigma: float
    every: int = 1
    dropout: float = 0.0


def frequency(oscillator: Oscillator) -> float:
    """The angular frequency of the damped oscillation, rad/s.

    Raises:
        ValueError: mass or spring is not positive, the damping is negative, or so strong that nothing oscillates.
    """
    mass_kg, spring_n_m, damping_n_s_m = oscillator
    if mass_kg <= 0 or spring_n_m <= 0 or not 0 <= damping_n_s_m**2 < 4 * mass_kg * spring_n_m or damping_n_s_m < 0:
        raise ValueError(
            f"oscillator: mass_kg={mass_kg} and spring_n_m={spring_n_m} must be positive, and damping_n_s_m="
            f"{damping_n_s_m} at least 0 and less than 2 sqrt(mass spring): a stronger one lets nothing oscillate"
        )
    return float(np.sqrt(spring_n_m / mass_kg - (damping_n_s_m / (2 * mass_kg)) ** 2))


def period_s(oscillator: Oscillator) -> float:
    """The time of one oscillation."""
    return 2 * np.pi / frequency(oscillator)


def motion(oscillator: Oscillator, time_s: ArrayLike, position_m: float, velocity_m_s: float) -> FloatArray:
    """Position, velocity and acceleration (times, 3) at these times, from the first two at time 0; exact."""
    mass_kg, spring_n_m, damping_n_s_m = oscillator
    time = np.asarray(time_s, dtype=np.float64)
    rate, decay = frequency(oscillator), damping_n_s_m / (2 * mass_kg)
    fade, cosine, sine = np.exp(-decay * time), np.cos(rate * time), np.sin(rate * time) / rate
    position = fade * (position_m * cosine + (velocity_m_s + decay * position_m) * sine)
    velocity = fade * (velocity_m_s * cosine - (spring_n_m / mass_kg * position_m + decay * velocity_m_s) * sine)
    return np.stack([position, velocity, -(spring_n_m * position + damping_n_s_m * velocity) / mass_kg], axis=-1)


def tracker(dt_s: float, jerk_noise: float, position: Instrument, acceleration: Instrument) -> ModularFilter:
    """The linear filter, with sensors called "position" and "acceleration"; their sigmas in m and m/s^2.

    jerk_noise (m/s^3/sqrt(Hz)): of the white jerk.

    Raises:
        ValueError: dt_s or a sigma is not positive, or as in `filters.modular.Sensor`.
    """
    if dt_s <= 0:
        raise ValueError(f"tracker: dt_s={dt_s} must be positive: it is the time of a step")
    sensors = [
        Sensor(
            name,
            linear_corrector(np.eye(3)[[seen]], [[instrument.sigma**2]]),
            every=instrument.every,
            dropout=instrument.dropout,
        )
        for name, seen, instrument in (("position", POSITION, position), ("acceleration", ACCELERATION, acceleration))
    ]
    return ModularFilter(linear_predictor(transition(dt_s), white_jerk(dt_s, jerk_noise)), sensors, dt_s)


def transition(dt_s: float) -> FloatArray:
    """F (3, 3): constant acceleration over dt."""
    return np.array([[1.0, dt_s, dt_s**2 / 2], [0.0, 1.0, dt_s], [0.0, 0.0, 1.0]])


def white_jerk(dt_s: float, jerk_noise: float) -> FloatArray:
    """Q (3, 3) of white jerk over dt, exactly. Bar-Shalom, Li and Kirubarajan, 2001, section 6.2.3."""
    T = dt_s
    over_density = [[T**5 / 20, T**4 / 8, T**3 / 6], [T**4 / 8, T**3 / 3, T**2 / 2], [T**3 / 6, T**2 / 2, T]]
    return jerk_noise**2 * np.array(over_density)
