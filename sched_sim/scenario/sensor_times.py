"""Below the table of `simulate --scenario`: what the sensors' times are in steps, and where they were rounded."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from sched_sim.scenario.fields import ends
from sched_sim.scenario.file_units import shown
from sched_sim.scenario.instants import Steps
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.text import visible

FEW = 4
"""Delays, and steps in which measurements are taken, are listed up to so many."""


def times(scenario: Scenario) -> list[str]:
    """A line for each sensor, such as "gps: 5 Hz = every 80 steps; 110 ms late = 44 steps"; none without hr_hz."""
    if scenario.hr_hz is None:
        return []
    ms = 1000 / scenario.hr_hz
    return [f"{visible(sensor.name)}: {'; '.join(_words(sensor, ms, scenario.steps))}" for sensor in scenario.sensors]


def _words(sensor: Sensor, ms: Fraction, steps: int) -> Iterator[str]:
    """ms: of a step."""
    yield f"{_decimal(1000 / (ms * sensor.every))} Hz = every {_count(sensor.every)}"
    if sensor.offset:
        yield f"the first at {_decimal(ms * sensor.offset)} ms = {_count(sensor.offset)}"
    if sensor.between_steps:
        taken = [*map(str, sensor.takes(steps)[: FEW + 1])]
        more = ", ..." if len(taken) > FEW else ""
        yield f"taken in {'step' if len(taken) == 1 else 'steps'} {', '.join(taken[:FEW])}{more}"
    least, most = ends(sensor.delays)
    if most:
        late = _drawn(sensor.delays, ms)
        yield f"{late} ms late = {_drawn(sensor.delays)} {'step' if most == least == 1 else 'steps'}"
    if Fraction(least).denominator > 1 or Fraction(most).denominator > 1:
        first, last = sensor.least_delay, sensor.longest_delay
        yield f"used {last if first == last else f'{first} to {last}'} {'step' if last == 1 else 'steps'} later"


def _drawn(delays: Sequence[Steps], unit: Fraction = Fraction(1)) -> str:
    least, most = ends(delays)
    if least == most:
        return _decimal(unit * least)
    if len(delays) > FEW or isinstance(delays, range):
        return f"{_decimal(unit * least)} to {_decimal(unit * most)}"
    return ", ".join(_decimal(unit * delay) for delay in delays)


def _count(steps: Steps) -> str:
    return "step" if steps == 1 else f"{shown(steps)} steps"


def _decimal(number: Fraction) -> str:
    """As it is where it is a short decimal, else to four digits."""
    written = shown(number)
    return f"{float(number):.4g}" if "/" in written else written
