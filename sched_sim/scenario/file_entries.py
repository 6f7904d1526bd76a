"""[predictor] and [[sensor]] of a scenario file, checked."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import ceil, floor
from typing import Annotated, Any, ClassVar, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, ValidationInfo, model_validator

from sched_sim.bounds import MOST_STEPS, short
from sched_sim.errors import InputError
from sched_sim.files.toml_numbers import Number, Whole, above_zero, number
from sched_sim.files.toml_problems import problems
from sched_sim.scenario.composition import ComposedSensor
from sched_sim.scenario.fields import ends
from sched_sim.scenario.file_units import Said, Units, agreed, plain_cost, shown, time, timed_cost, units_of
from sched_sim.scenario.instants import Steps, roundings, spread
from sched_sim.scenario.scenario import Sensor
from sched_sim.schedule.jobs import HR, LR


def _several(value: Any, what: str, read: Callable[[Any], Any]) -> tuple[Any, ...]:
    """A number, or a list of at least one."""
    if not isinstance(value, list):
        return (read(value),)
    if not value:
        raise ValueError(f"is an empty list: give at least one {what}")
    entries = []
    for place, item in enumerate(value):
        try:
            entries.append(read(item))
        except ValueError as error:
            given = "" if isinstance(item, dict | list) else f" is {short(item)}"
            raise ValueError(f"entry {place}{given}: {error}") from None
    return tuple(entries)


def _cost(value: Any) -> tuple[Fraction, ...]:
    if isinstance(value, dict):
        raise ValueError("must be a number, or a list to draw from, such as [0.3, 0.5]")
    return _several(value, "execution time", above_zero)


def not_negative(value: Any) -> Fraction:
    found = number(value)
    if found < 0:
        raise ValueError("must be at least 0")
    return found


def _not_before(value: Any) -> Fraction:
    found = number(value)
    if found < 0:
        raise ValueError("must be 0 or more: no measurement arrives before it is taken")
    return found


class _Range(BaseModel):
    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    least: Number
    most: Number


def _drawn(value: Any, what: str, example: str, read: Callable[[Any], Fraction]) -> tuple[Fraction, ...] | _Range:
    if not isinstance(value, dict):
        return _several(value, f"number of {what}", read)
    if lacking := [key for key in _Range.model_fields if key not in value]:
        raise ValueError(f"has no {' and no '.join(lacking)}: give both, as {{ {example} }}, in {what}")
    try:
        between = _Range.model_validate(value)
    except ValidationError as error:
        raise ValueError(f"{{ least = ..., most = ... }} in {what}: {problems(error, _Range)}") from None
    if between.least > between.most:
        raise ValueError(f"least = {shown(between.least)} is above most = {shown(between.most)}: exchange them")
    read(value["least"])
    return between


def _delay(value: Any) -> Any:
    return _drawn(value, "steps", "least = 3, most = 5", number)


def _delay_ms(value: Any) -> Any:
    return _drawn(value, "ms", "least = 120, most = 200", _not_before)


Cost = Annotated[tuple[Fraction, ...] | None, BeforeValidator(plain_cost(_cost))]
TimedCost = Annotated[tuple[Fraction, ...] | None, BeforeValidator(timed_cost(_cost))]
_Rate = Annotated[Fraction | None, BeforeValidator(time(above_zero))]
_Time = Annotated[Fraction | None, BeforeValidator(time(not_negative))]
_Delay = Annotated[Any, BeforeValidator(_delay)]
_DelayMs = Annotated[Any, BeforeValidator(time(_delay_ms))]


def _every_or_hz(value: Any, info: ValidationInfo) -> Fraction | None:
    """It may be left out where `hz`, or the filter that the file names, says it."""
    if value is not None:
        return number(value)
    if "hz" in info.data and info.data["hz"] is None and units_of(info).sensors is None:
        raise ValueError("is missing: write `every = ...` in steps, or `hz = ...` beside hr_hz")
    return None


class Entry(BaseModel):
    """A table that has no other keys."""

    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)


class PredictorEntry(Entry):
    """[predictor]."""

    priority: Whole = HR
    cost: Cost = None
    cost_us: TimedCost = None
    cost_ms: TimedCost = None
    cost_s: TimedCost = None


class SensorEntry(Entry):
    """One [[sensor]]. It is checked beside the `Units` of its file."""

    one_of: ClassVar[Sequence[str]] = ("every (or hz)",)
    """What is required besides the keys that are."""

    name: str
    hz: _Rate = None
    every: Annotated[Fraction | None, BeforeValidator(_every_or_hz), Field(validate_default=True)] = None
    delay_ms: _DelayMs = None
    delay: _Delay = None
    offset_ms: _Time = None
    offset: Number | None = None
    dropout: Number | None = None
    priority: Whole = LR
    land_within_ms: _Time = None
    land_by: Whole | None = None
    cost: Cost = None
    cost_us: TimedCost = None
    cost_ms: TimedCost = None
    cost_s: TimedCost = None

    @model_validator(mode="after")
    def _possible(self, info: ValidationInfo) -> Self:
        units = units_of(info)
        if units.sure:
            try:
                self.sensor(units)
            except InputError as error:
                raise ValueError(str(error).removeprefix(f"sensor {self.name!r}: ")) from None
        return self

    def sensor(self, units: Units) -> Sensor:
        """Raises InputError that lists what is wrong with it, or does not agree."""
        if units.sensors is not None and self.name not in units.sensors:
            known = ", ".join(units.sensors)
            raise InputError(f"it is none of the filter's, which are {known}: give the name of one, or delete it")
        readers = {"every": self._every, "delays": self._delays, "offset": self._offset, "dropout": self._dropout}
        fields: dict[str, Any] = {}
        wrong = []
        for field, read in readers.items():
            try:
                fields[field] = read(units)
            except InputError as error:
                wrong.append(str(error))
        if wrong:
            raise InputError("; ".join(wrong))
        land_by = self._land_by(units, fields["every"], fields["delays"], fields["offset"])
        return Sensor(name=self.name, land_by=land_by, priority=self.priority, **fields)

    def first(self, sensor: Sensor) -> str:
        """The earliest step in which one arrives, as the subject of a sentence."""
        offset, least = shown(sensor.offset), shown(ends(sensor.delays)[0])
        if sensor.offset and ends(sensor.delays)[0]:
            return f"offset {offset} and the least delay {least} together are"
        return f"the offset {offset} is" if sensor.offset else f"the least delay {least} is"

    def _every(self, units: Units) -> Steps:
        if self.hz is not None and units.hr_hz is not None and self.hz > units.hr_hz:
            raise InputError(
                f"hz = {shown(self.hz)} is above hr_hz = {shown(units.hr_hz)}: a sensor measures once in a step at "
                f"most; give {shown(units.hr_hz)} or less"
            )
        of_hz = None if self.hz is None or units.hr_hz is None else units.hr_hz / self.hz
        of = self._composed(units)
        every: Steps = agreed(
            [
                _said("every", self.every, self.every),
                _said("hz", self.hz, of_hz, "every {} steps"),
                of and _said("the filter's every", of.every, of.every),
            ]
        )
        return every

    def _delays(self, units: Units) -> Sequence[Steps]:
        of_steps = None if self.delay is None else _in_steps(self.delay, Fraction)
        of_ms = None if self.delay_ms is None else _in_steps(self.delay_ms, units.steps)
        of = self._composed(units)
        delays: Sequence[Steps] | None = agreed(
            [
                _said("delay", self.delay, of_steps),
                _said("delay_ms", self.delay_ms, of_ms, "{} steps"),
                of and _said("the filter's delay", of.delays, of.delays),
            ]
        )
        return (0,) if delays is None else delays

    def _offset(self, units: Units) -> Steps:
        of_ms = None if self.offset_ms is None else units.steps(self.offset_ms)
        said = [_said("offset", self.offset, self.offset), _said("offset_ms", self.offset_ms, of_ms, "{} steps")]
        offset: Steps | None = agreed(said)
        return 0 if offset is None else offset

    def _dropout(self, units: Units) -> float:
        stated = None if self.dropout is None else float(self.dropout)
        of = self._composed(units)
        dropout: float | None = agreed(
            [_said("dropout", self.dropout, stated), of and _said("the filter's dropout", of.dropout, of.dropout)]
        )
        return 0.0 if dropout is None else dropout

    def _land_by(self, units: Units, every: Steps, delays: Sequence[Steps], offset: Steps) -> int:
        """Of a time: the last step that starts within it after every instant, however long that waits for its step."""
        within, (least, longest), (least_wait, longest_wait) = (
            self.land_within_ms,
            ends(delays),
            roundings(every, offset),
        )
        of_ms = None if within is None else floor(units.steps(within) - longest_wait)
        first = ceil(least - longest_wait) + units.next_step
        if within is not None and of_ms is not None and of_ms < first:
            possible = ceil(10 * units.ms(first + longest_wait)) / 10
            raise InputError(
                f"land_within_ms = {shown(within)} is before any correction can land: a measurement is used in the "
                f"first step at its arrival or after it{', and lands in the next' if units.next_step else ''}; give "
                f"{possible:g} or more"
            )
        said = [_said("land_by", self.land_by, self.land_by), _said("land_within_ms", within, of_ms, "land_by {}")]
        land_by: int | None = agreed(said)
        if land_by is not None:
            return land_by
        return ceil(longest - least_wait) + max(floor(every) - 1, units.next_step)

    def _composed(self, units: Units) -> ComposedSensor | None:
        return None if units.sensors is None else units.sensors[self.name]


def _said(key: str, given: Any, value: Any, became: str = "") -> Said | None:
    """None if it is not given. became: what it is in steps, with {} for the value."""
    if given is None:
        return None
    written = f"{{ least = {shown(given.least)}, most = {shown(given.most)} }}" if isinstance(given, _Range) else None
    return Said(f"{key} = {written or shown(given)}{f' ({became.format(shown(value))})' if became else ''}", value)


def _in_steps(given: tuple[Fraction, ...] | _Range, steps: Callable[[Fraction], Fraction]) -> Sequence[Steps]:
    if not isinstance(given, _Range):
        return tuple(map(steps, given))
    least, most = steps(given.least), steps(given.most)
    return spread(least, most) if most <= MOST_STEPS else (most,)  # which is no sensor's
