"""From ticks to steps and to millimetres on the page."""

from __future__ import annotations

from typing import NamedTuple


class Scale(NamedTuple):
    """period: the HR period in ticks; first, end: the steps at the ends of the axis; width_mm: its length."""

    period: int
    first: float
    end: float
    width_mm: float

    @property
    def mm_per_step(self) -> float:
        return self.width_mm / (self.end - self.first)

    def step(self, ticks: float) -> float:
        """The instant on the axis of steps."""
        return ticks / self.period

    def mm(self, step: float) -> float:
        """How far from the left end of the axis a step is."""
        return (step - self.first) * self.mm_per_step

    def at(self, mm: float) -> float:
        """The step that is so far from the left end."""
        return self.first + mm / self.mm_per_step

    def shows(self, ticks: float) -> bool:
        return self.first <= self.step(ticks) <= self.end

    def overlaps(self, start: int, end: int) -> bool:
        """Whether [start, end] ticks is on the axis, or touches it."""
        return self.step(start) <= self.end and self.first <= self.step(end)

    def visible_mm(self, start: int, end: int) -> tuple[float, float]:
        """The part of [start, end) ticks that is on the axis, in mm; empty if the second is not the greater."""
        return max(self.mm(self.step(start)), 0.0), min(self.mm(self.step(end)), self.width_mm)
