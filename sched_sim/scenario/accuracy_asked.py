"""What a scenario's file asks of the accuracy along its simulation; what it is worth is computed elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

Rows = tuple[tuple[float, ...], ...]
"""A matrix."""


class Seen(NamedTuple):
    """What a sensor measures: its H and its R; None where the model says it."""

    H: Rows | None
    R: Rows | None


@dataclass(frozen=True)
class AccuracyAsked:
    """model: a shipped one's name, or "module:function" in the folder of the scenario; None: its filter's.

    output, unit: as `sched-sim accuracy` has them. initial_std: of each state in step 0. sensors: by name, what the
    model does not say.
    """

    model: str | None = None
    output: str | None = None
    unit: str | None = None
    initial_std: tuple[float, ...] | None = None
    sensors: Mapping[str, Seen] = field(default_factory=dict)
