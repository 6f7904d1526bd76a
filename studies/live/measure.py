"""One run, from the design to the word."""

from __future__ import annotations

from typing import NamedTuple

from studies.live.agreement import Agreement, agreement
from studies.live.design import Design
from studies.live.jobs import Ran
from studies.live.landed import achieved, wake_ups
from studies.live.taken import busy_periods, disturbed, taken_by_cycle


class Measured(NamedTuple):
    """What a run came to. predicted: l - k; achieved, taken, disturbed: by cycle, `taken` in ns; wake: ns by step;
    taken_share: of all time that the run took, what was taken from jobs that were ready."""

    design: Design
    predicted: int
    ran: Ran
    achieved: list[int | None]
    taken: list[int]
    disturbed: list[bool]
    wake: list[int]
    taken_share: float

    @property
    def agreement(self) -> Agreement:
        return agreement(self.predicted, self.achieved, self.disturbed)

    def shown_cycle(self) -> int:
        """That a picture is of, from 1: the first undisturbed one that landed elsewhere, else the first undisturbed."""
        cycles = range(1, len(self.achieved) + 1)
        calm = [cycle for cycle in cycles if not self.disturbed[cycle - 1]]
        elsewhere = [cycle for cycle in calm if self.achieved[cycle - 1] != self.predicted]
        return next(iter([*elsewhere, *calm]), 1)


def measured(ran: Ran, design: Design, predicted: int) -> Measured:
    """Judges a run."""
    busy = busy_periods(ran.jobs, design, ran.idle)
    taken = taken_by_cycle(busy, design)
    whole = max([design.steps * design.period_ns, *(period.end for period in busy)])
    share = sum(period.taken for period in busy) / whole
    return Measured(
        design,
        predicted,
        ran,
        achieved(ran.jobs, design),
        taken,
        disturbed(taken, design, predicted),
        wake_ups(ran.jobs, design),
        share,
    )
