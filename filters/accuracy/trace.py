"""The accuracy along a record of landings: several sensors, any delays, any order of arrival, some never arriving.

Exact for that record: in each step the output's covariance given all that has landed by then, as of a filter that goes
back to each measurement and replays. Time-varying models and transients are no different.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from filters.accuracy.model import output_rows
from filters.accuracy.outcome import check_steps
from filters.accuracy.riccati import posterior
from filters.arrays import FloatArray, as_array
from filters.covariances import check_covariance, check_measurement_noise


class Landing(NamedTuple):
    """A measurement of a sensor that was taken in step k and is in the output from `step` on."""

    sensor: str
    k: int
    step: int


class Along(NamedTuple):
    """In each of steps + 1 steps, after what lands in it.

    deviations: standard deviation of the output. ages: of each sensor, steps since the newest of its measurements that
        are in the output was taken; infinite before there is one.
    """

    deviations: FloatArray
    ages: dict[str, FloatArray]


class Spread(NamedTuple):
    """Over the steps of a record."""

    median: float
    p95: float
    worst: float


def along(
    Phi: ArrayLike,
    Q: ArrayLike,
    sensors: Mapping[str, tuple[ArrayLike, ArrayLike]],
    outputs: ArrayLike,
    P0: ArrayLike,
    steps: int,
    landings: Iterable[tuple[str, int, int]],
    *,
    on_step: Callable[[int], None] | None = None,
) -> Along:
    """The covariance recursion along steps 0 .. steps.

    Phi, Q (n, n), and H (p, n), R (p, p) of each sensor: constant, or one for each step, taken modulo their number, as
        in `linear_system`. P0 (n, n): covariance in step 0, before a measurement of that step.
    outputs: rows C (o, n), or the numbers of the states that are the outputs.
    landings: (sensor, k, step) in any order, see `Landing`; those after the last step come too late to matter.
    on_step: called with each step that is done.

    Raises ValueError, naming it, for a wrong shape, what is no covariance, an unknown sensor, and a landing before its
    measurement.
    """
    check_steps("steps", steps, 0)
    transitions, noises = _by_step("Phi", Phi), _by_step("Q", Q)
    n = transitions.shape[-1]
    for name, matrices in (("Phi", transitions), ("Q", noises)):
        _check_shape(name, matrices, (n, n))
    for noise in noises:
        check_covariance("Q", noise)
    known = {name: _sensor(name, H, R, n) for name, (H, R) in sensors.items()}
    start = as_array("P0", P0)
    if start.shape != (n, n):
        raise ValueError(f"P0 has shape {start.shape}, needed is ({n}, {n})")
    check_covariance("P0", start)
    C = output_rows(outputs, n)
    due, longest = _due(landings, known, steps)
    return _recursion(transitions, noises, known, C.T @ C, start, steps, due, longest + 1, on_step)


def spread(deviations: FloatArray, start: int = 0) -> Spread:
    """Of `Along.deviations` from a step on."""
    if not 0 <= start < len(deviations):
        raise ValueError(f"start={start} must be one of the steps 0 to {len(deviations) - 1}")
    later = deviations[start:]
    return Spread(float(np.median(later)), float(np.quantile(later, 0.95)), float(later.max()))


class _Sensor(NamedTuple):
    H: FloatArray
    R: FloatArray


def _recursion(
    transitions: FloatArray,
    noises: FloatArray,
    sensors: Mapping[str, _Sensor],
    weights: FloatArray,
    P0: FloatArray,
    steps: int,
    due: Mapping[int, list[Landing]],
    window: int,
    on_step: Callable[[int], None] | None,
) -> Along:
    """weights (n, n): C^T C. window: the states of so many steps are kept, each as it is before its measurements."""
    kept: list[FloatArray] = [P0] * window
    inserted: dict[int, list[Landing]] = defaultdict(list)
    newest: dict[str, float] = dict.fromkeys(sensors, -np.inf)
    deviations = np.empty(steps + 1)
    ages = {name: np.empty(steps + 1) for name in sensors}
    P = P0  # after the measurements of a step
    for j in range(steps + 1):
        if j > 0:
            kept[j % window] = P = _propagated(transitions, noises, j - 1, P)
        landed = due.get(j, ())
        if landed:
            for landing in landed:
                inserted[landing.k].append(landing)
                newest[landing.sensor] = max(newest[landing.sensor], landing.k)
            first = min(landing.k for landing in landed)
            for k in range(first, j + 1):
                if k > first:
                    kept[k % window] = _propagated(transitions, noises, k - 1, P)
                P = kept[k % window]
                for landing in inserted.get(k, ()):
                    H, R = sensors[landing.sensor]
                    P = posterior(P, H[k % len(H)], R[k % len(R)])[1]
        inserted.pop(j - window, None)
        deviations[j] = np.vdot(weights, P)
        for name, last in newest.items():
            ages[name][j] = j - last
        if on_step is not None:
            on_step(j)
    return Along(np.sqrt(deviations.clip(0.0)), ages)


def _propagated(transitions: FloatArray, noises: FloatArray, j: int, P: FloatArray) -> FloatArray:
    Phi = transitions[j % len(transitions)]
    return np.asarray(Phi @ P @ Phi.T + noises[j % len(noises)])


def _due(
    landings: Iterable[tuple[str, int, int]], sensors: Mapping[str, _Sensor], steps: int
) -> tuple[dict[int, list[Landing]], int]:
    """By the step in which they land; and the longest that one takes."""
    due: dict[int, list[Landing]] = defaultdict(list)
    longest = 0
    for sensor, k, step in landings:
        if sensor not in sensors:
            raise ValueError(f"a landing is of sensor {sensor!r}, which is unknown; there are {', '.join(sensors)}")
        check_steps("k of a landing", k, 0)
        check_steps("step of a landing", step, 0)
        if step < k:
            raise ValueError(f"a landing of {sensor!r} is in step {step}, before its measurement is taken in k={k}")
        if step <= steps:
            due[int(step)].append(Landing(sensor, int(k), int(step)))
            longest = max(longest, int(step) - int(k))
    return due, longest


def _sensor(name: str, H: ArrayLike, R: ArrayLike, n: int) -> _Sensor:
    sensor = _Sensor(_by_step(f"H of {name}", H), _by_step(f"R of {name}", R))
    p = sensor.H.shape[1]
    _check_shape(f"H of {name}", sensor.H, (p, n))
    _check_shape(f"R of {name}", sensor.R, (p, p))
    for k, noise in enumerate(sensor.R):
        check_measurement_noise(noise, None if len(sensor.R) == 1 else k, f"R of {name}")
    return sensor


def _by_step(name: str, value: ArrayLike) -> NDArray[np.float64]:
    matrices = as_array(name, value)
    if matrices.ndim == 2:
        matrices = matrices[np.newaxis]
    if matrices.ndim != 3 or 0 in matrices.shape:
        raise ValueError(f"{name} has shape {np.shape(value)}; needed is a matrix, or one for each step")
    if not np.isfinite(matrices).all():
        raise ValueError(f"{name} holds a value that is not finite; give numbers")
    return matrices


def _check_shape(name: str, matrices: FloatArray, needed: tuple[int, int]) -> None:
    if matrices.shape[1:] != needed:
        raise ValueError(f"{name} has shape {matrices.shape[1:]}, needed is {needed}")
