"""A filter put together from one predictor and a corrector for each sensor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil
from typing import Any

import numpy as np

from filters.choice import check_choice
from filters.kind import check_kind
from filters.modular.check import check_functions
from filters.modular.correctors import Corrector, check_noise
from filters.modular.predictors import Predictor
from filters.modular.space import Space, as_space, space
from filters.modular.updates import UPDATES, UpdateName


@dataclass(frozen=True, slots=True)
class Sensor:
    """One sensor.

    every: steps between its measurements, the first in step 0; a Fraction where they are not whole, and then each is
        taken in the first step at its instant or after it. delay: steps until one is available; of a range or a list
        any, equally likely. dropout: the probability that one never is.

    Raises:
        ValueError: a number is out of range.
    """

    name: str
    corrector: Corrector
    every: int | Fraction = 1
    delay: int | Sequence[int] = 0
    dropout: float = 0.0

    def __post_init__(self) -> None:
        if not (isinstance(self.name, str) and self.name.strip()):
            raise ValueError(
                f"Sensor: name={self.name!r:.60} must be text, and not empty: its measurements are known by it"
            )
        if not isinstance(self.corrector, Corrector):
            raise ValueError(
                f"sensor {self.name!r}: the corrector is a {type(self.corrector).__name__}; make one by "
                f"linear_corrector, extended_corrector or unscented_corrector"
            )
        if not isinstance(self.every, int | np.integer | Fraction) or self.every < 1:
            raise ValueError(
                f"sensor {self.name!r}: every={self.every!r} must be a whole number or a Fraction, at least 1: the "
                f"steps between measurements"
            )
        if isinstance(self.every, Fraction) and self.every.denominator == 1:
            object.__setattr__(self, "every", self.every.numerator)
        if not isinstance(self.delay, int | np.integer | range):
            object.__setattr__(self, "delay", _listed(self.delay))
        if not all(isinstance(delay, int | np.integer) and delay >= 0 for delay in _ends(self.delays)):
            raise ValueError(
                f"sensor {self.name!r}: delay={self.delay!r:.60} must be a whole number, at least 0, or a range or a "
                f"list of such: the steps until a measurement is available"
            )
        if not (isinstance(self.dropout, int | float) and 0 <= self.dropout <= 1):
            raise ValueError(
                f"sensor {self.name!r}: dropout={self.dropout!r} must lie in [0, 1]: it is a probability; 10 % is 0.1"
            )

    @property
    def delays(self) -> Sequence[int]:
        """What its delay is drawn from; one if it is always the same."""
        return self.delay if isinstance(self.delay, Sequence) else (self.delay,)

    @property
    def longest_delay(self) -> int:
        """In steps."""
        return max(map(int, _ends(self.delays)))

    def takes(self, steps: int) -> list[int]:
        """The steps, of 0, 1, ... so many, in which its measurements are taken."""
        count = int((steps - 1) // self.every) + 1
        return [ceil(number * self.every) for number in range(count)]


def _listed(delay: Any) -> Any:
    """A list, or an array, as a tuple; what is neither, and a list of none, stays as it is."""
    if isinstance(delay, np.ndarray):
        delay = delay.tolist()
    return tuple(delay) if isinstance(delay, Sequence) and not isinstance(delay, str) and delay else delay


def _ends(delays: Sequence[Any]) -> Sequence[Any]:
    """Those among which the least and the greatest are."""
    return (delays[0], delays[-1]) if isinstance(delays, range) and delays else delays or (None,)


@dataclass(frozen=True, slots=True)
class ModularFilter:
    """One predictor, which evolves the state each step, and the sensors, each with its own corrector.

    dt: the time of a step, in seconds, as the predictor's f gets it. of: what the state stands for; plain quantities
    if not given, as many as the predictor's noise has. In one step the sensors are used in their order.
    update: how the covariance is corrected, "short" with the least work; "joseph", less of which is lost
        to rounding where measurements tell far more than was known, see `updates`; or "u-d", of which nothing is, for
        linear and extended parts, see `u_d`.

    Raises:
        ValueError: dt is not positive, two sensors have one name, or a part does not fit the state; it is named.
    """

    predictor: Predictor
    sensors: tuple[Sensor, ...]
    dt: float
    of: Space
    update: UpdateName

    def __init__(
        self,
        predictor: Predictor,
        sensors: tuple[Sensor, ...] | list[Sensor],
        dt: float = 1.0,
        of: Space | None = None,
        *,
        update: UpdateName = "short",
    ) -> None:
        if not isinstance(predictor, Predictor):
            raise ValueError(
                f"the predictor is a {type(predictor).__name__}; make one by linear_predictor, extended_predictor or "
                f"unscented_predictor"
            )
        if not (isinstance(sensors, list | tuple) and all(isinstance(sensor, Sensor) for sensor in sensors)):
            raise ValueError(f"sensors is {sensors!r:.60}; give a list of Sensor(name, corrector, ...)")
        object.__setattr__(self, "predictor", predictor)
        object.__setattr__(self, "sensors", tuple(sensors))
        if not isinstance(dt, int | float | np.integer | np.floating):
            raise ValueError(f"dt={dt!r} must be a number: it is the time of a step, in seconds")
        object.__setattr__(self, "dt", float(dt))
        object.__setattr__(self, "of", space(predictor.states) if of is None else as_space("of", of))
        check_choice("update", update, UPDATES)
        object.__setattr__(self, "update", update)
        self._check()

    def _check(self) -> None:
        n = self.predictor.states
        if not 0 < self.dt < np.inf:
            raise ValueError(f"dt={self.dt} must be positive and finite: it is the time of a step, in seconds")
        if self.of.errors != n:
            raise ValueError(
                f"predictor: its Q has shape {(n, n)}, but an error of the state has {self.of.errors} numbers (an "
                f"attitude has 3)"
            )
        check_functions("predictor", self.predictor.motion, "x, u, dt, out")
        if self.predictor.kind == "linear" and len(self.of.attitudes):
            raise ValueError("predictor: a linear one cannot turn an attitude; make it extended or unscented")
        if self.update == "u-d":
            for part in unscented_parts(self):
                raise ValueError(
                    f"{part}: update='u-d' keeps factors, which need the matrices of linear and extended parts, and "
                    f"this one is unscented; give update='joseph', or make it extended"
                )
        names = [sensor.name for sensor in self.sensors]
        for sensor in self.sensors:
            if names.count(sensor.name) > 1:
                raise ValueError(f"sensor {sensor.name!r}: the name is used twice; give each sensor its own")
            try:
                check_noise(sensor.corrector)
                view = sensor.corrector.view(n)
            except ValueError as error:
                raise ValueError(f"sensor {sensor.name!r}: {error}") from None
            check_functions(f"sensor {sensor.name!r}", view, "x, out")
            if sensor.corrector.kind == "linear":
                for at, start in enumerate(self.of.attitudes):
                    if np.any(view.H[:, start - at : start - at + 3]):
                        raise ValueError(
                            f"sensor {sensor.name!r}: H of a linear one sees an attitude (columns {start - at} to "
                            f"{start - at + 2}); make it extended or unscented"
                        )


def check_composed(composed: object) -> None:
    """Raises ValueError unless it is a filter."""
    check_kind("composed", composed, ModularFilter, "a ModularFilter(predictor, sensors, ...)")


def unscented_parts(composed: ModularFilter) -> list[str]:
    """The parts that leave no F or H, in words."""
    parts = {"predictor": composed.predictor.kind}
    parts |= {f"sensor {sensor.name!r}": sensor.corrector.kind for sensor in composed.sensors}
    return [part for part, kind in parts.items() if kind == "unscented"]
