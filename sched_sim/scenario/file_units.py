"""What the times and costs of a scenario file are in: steps and cost units, or with hr_hz milliseconds and seconds."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from pydantic import ValidationInfo

from sched_sim.bounds import short
from sched_sim.costs.table import SECONDS
from sched_sim.errors import InputError
from sched_sim.files.toml_numbers import above_zero
from sched_sim.scenario.composition import ComposedSensor, Composition
from sched_sim.scenario.instants import Spread, Steps
from sched_sim.schedule.task_file import COST_UNITS

Read = Callable[[Any], Any]
"""What a key holds, of what stands in the file; raises ValueError."""
STEPS_KEY = {
    "hz": "every",
    "delay_ms": "delay",
    "offset_ms": "offset",
    "land_within_ms": "land_by",
    "duration_s": "steps",
}
"""By the key of a time, the key that says the same in steps."""


@dataclass(frozen=True)
class Units:
    """What the rest of a file says that its entries need. It is the context in which pydantic checks them.

    hr_hz: steps in a second; unit: of plain costs, one of `COST_UNITS`. None if the file gives none.
    sure: whether it is clear what they are; if not, nothing is said of what depends on them.
    composition: of the filter that the file names; None if it names none.
    next_step: whether corrections land in the step after that in which they finish.
    """

    hr_hz: Fraction | None
    unit: str | None
    sure: bool
    composition: Composition | None = None
    next_step: bool = False

    @classmethod
    def of(cls, document: Mapping[str, Any], composition: Composition | None) -> Units:
        rate, unit, next_step = document.get("hr_hz"), document.get("unit"), document.get("late") == "dual-rate"
        try:
            hr_hz = None if rate is None else above_zero(rate)
        except ValueError:
            return cls(None, None, False, composition, next_step)
        if composition is None and "filter" in document:  # no name, which is said where it stands
            return cls(hr_hz, None, False, Composition({}, None), next_step)
        sure = unit in (None, *COST_UNITS) and not (hr_hz is not None and "speed" in document)
        return cls(hr_hz, unit, sure, composition, next_step)

    @property
    def sensors(self) -> Mapping[str, ComposedSensor] | None:
        """The filter's, by name."""
        return None if self.composition is None else self.composition.sensors

    @property
    def plain(self) -> Fraction:
        """What a plain cost of 1 is: seconds with hr_hz, else cost units."""
        return Fraction(1) if self.unit is None else SECONDS[self.unit]

    def steps(self, ms: Fraction) -> Fraction:
        assert self.hr_hz is not None  # `time` has seen to it
        return ms * self.hr_hz / 1000

    def ms(self, steps: Steps) -> Fraction:
        assert self.hr_hz is not None
        return 1000 * steps / self.hr_hz


def units_of(info: ValidationInfo) -> Units:
    """Those beside which an entry is checked."""
    units = info.context
    assert isinstance(units, Units)
    return units


def time(read: Read) -> Callable[[Any, ValidationInfo], Any]:
    """A validator of a time, which needs hr_hz."""

    def checked(value: Any, info: ValidationInfo) -> Any:
        found, units = read(value), units_of(info)
        if units.hr_hz is None and units.sure:
            raise ValueError(
                f"it needs hr_hz, the steps in a second: give hr_hz, or {STEPS_KEY[str(info.field_name)]} = ... in "
                f"steps instead"
            )
        return found

    return checked


def plain_cost(read: Read) -> Callable[[Any, ValidationInfo], Any]:
    """A validator of a cost that says no unit itself."""

    def checked(value: Any, info: ValidationInfo) -> Any:
        found, units, key = read(value), units_of(info), info.field_name
        if units.hr_hz is not None and units.sure and units.unit is None and found not in (0, (0,)):
            raise ValueError(
                f"{shown(found)} has no unit, and with hr_hz costs are times: write {key}_us, {key}_ms or {key}_s "
                f'instead, or unit = "s", "ms" or "us" at the top of the file for all'
            )
        return found

    return checked


def timed_cost(read: Read) -> Callable[[Any, ValidationInfo], Any]:
    """A validator of a cost that is a time."""

    def checked(value: Any, info: ValidationInfo) -> Any:
        found, units = read(value), units_of(info)
        if units.hr_hz is None and units.sure:
            plain = str(info.field_name).rpartition("_")[0]
            raise ValueError(
                f"it is a time, and without hr_hz no period has one: give hr_hz (steps per second) instead of speed, "
                f"or {plain} = ... in cost units"
            )
        return found

    return checked


class Said(NamedTuple):
    """A value, and how the file says it."""

    words: str
    value: Any


def agreed(said: Sequence[Said | None]) -> Any:
    """The one value that all of these say, of which those that are not given are None; None if none is.

    Raises InputError that names two that differ.
    """
    first, *others = [one for one in said if one is not None] or [Said("", None)]
    for other in others:
        if not _same(first.value, other.value):
            raise InputError(f"{first.words} and {other.words} do not agree: leave out the one that is wrong")
    return first.value


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, Sequence) and isinstance(other, Sequence):
        return len(one) == len(other) and all(a == b for a, b in zip(one, other, strict=True))
    return bool(one == other)


def costs_said(entry: Any, key: str, units: Units) -> Any:
    """A cost, or several, by whichever of `key`, `key`_us, ... gives it; in seconds with hr_hz, else in cost units."""
    factors = {key: units.plain} | {f"{key}_{unit}": SECONDS[unit] for unit in COST_UNITS}
    given = {name: value for name in factors if (value := getattr(entry, name)) is not None}
    return agreed([Said(f"{name} = {shown(value)}", _times(factors[name], value)) for name, value in given.items()])


def _times(factor: Fraction, value: Any) -> Any:
    return tuple(factor * one for one in value) if isinstance(value, tuple) else factor * value


def shown(value: Any) -> str:
    """A number, or what it is drawn from, as a person would write it."""
    if isinstance(value, range | Spread):
        return f"{{ least = {shown(value[0])}, most = {shown(value[-1])} }}"
    if isinstance(value, Sequence):
        return shown(value[0]) if len(value) == 1 else short(f"[{', '.join(map(shown, value))}]")
    number = Fraction(str(value))
    decimal = f"{float(number):.10g}"
    return decimal if Fraction(decimal) == number else str(number)
