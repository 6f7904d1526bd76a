"""Published timings of others beside instructions of the same jobs on an emulated core."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from filters.jobs import Job
from studies.measurement.emulation.jobs import emulate
from studies.measurement.emulation.targets import TARGETS, precision_of
from studies.measurement.published_timings import PublishedTiming


def instructions(timing: PublishedTiming) -> int | None:
    """Of the job on the core of the part, in the part's precision; None if no such core is emulated.

    Raises:
        ValueError: the program cannot be compiled, or fails on the board.
    """
    stated = timing.on.cycles_per_instruction
    if stated is None or stated.target not in TARGETS:
        return None
    jobs = {at: Job(str(at), call.function, _always(call.arguments)) for at, call in enumerate(timing.calls)}
    found = emulate(jobs, TARGETS[stated.target], precision_of(TARGETS[stated.target], timing.on.precision), sets=1)
    return sum(emulated.instructions[0] for emulated in found.values())


def times_us(timing: PublishedTiming, number: int) -> tuple[Fraction, Fraction]:
    """What so many instructions take at the cycles that the part states, least and most, microseconds."""
    stated = timing.on.cycles_per_instruction
    assert stated is not None
    return number * stated.least / timing.clock_mhz, number * stated.most / timing.clock_mhz


def _always(arguments: tuple[Any, ...]) -> Callable[[int], tuple[Any, ...]]:
    return lambda _index: arguments
