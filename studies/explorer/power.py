"""The one scale on which a view shows speeds: shares of a processor, or cost units per HR period."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from sched_sim.costs.table import units
from studies.explorer.resolved import Resolved
from studies.explorer.words import machine


@dataclass(frozen=True, slots=True)
class Power:
    """unit, short: in words; per_unit: powers in a cost unit per HR period."""

    unit: str
    short: str
    per_unit: Fraction

    def of(self, speed: Fraction) -> float:
        per_unit = self.per_unit
        return (speed.numerator * per_unit.numerator) / (speed.denominator * per_unit.denominator)


def power_of(asked: Resolved) -> Power:
    """In percent of the part, or of the machine whose times the costs are, where the rate is known."""
    pace = asked.machine_pace
    if pace is None:
        return Power(f"{units(asked.table.unit)} per HR period", "speed", Fraction(1))
    short = "the machine" if asked.part is None else asked.part.name
    return Power(f"% of {machine_name(asked)}", f"% of {short}", 100 / pace)


def machine_name(asked: Resolved) -> str:
    """With its clock, where it has one."""
    clock = None if asked.part is None else asked.part.clock_hz
    return machine(asked) if clock is None else f"{machine(asked)} at {float(clock / 10**6):g} MHz"
