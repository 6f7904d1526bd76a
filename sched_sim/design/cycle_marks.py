"""The steps that the paper names: k, m and l of every cycle, as a picture marks them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from sched_sim.design.timing import Timing


class Mark(NamedTuple):
    """A step that the paper names. text: without dollar signs, such as "l = k+N"; cycle: from 0; is_k: whether a
    measurement is taken there; meaning: what happens, in words."""

    step: int
    text: str
    cycle: int
    is_k: bool
    meaning: str = ""


def cycle_marks(
    timing: Timing,
    cycles: int,
    landings: Mapping[int, int],
    *,
    arrives: bool = True,
    end: int = 0,
    landing: str = "correction {} lands",
) -> list[Mark]:
    """k, m and l of every cycle; steps that coincide share one mark, "m = l".

    landings: achieved L by cycle, for the cycles whose correction landed; arrives: whether there is an m; end: where
    the last of them must have landed after the last cycle, the step until which each k has its mark; landing: what
    happens at l, with a place for its number.
    """
    names: dict[int, list[Mark]] = {}

    def add(step: int, text: str, cycle: int, meaning: str, is_k: bool = False) -> None:
        names.setdefault(step, []).append(Mark(step, text, cycle, is_k, meaning))

    taken = timing.taken
    for cycle in range(max(cycles, taken.before(end + 1) - 1) + 1):
        k, number = taken.step(cycle), cycle + 1
        later = "" if cycle == 0 else "+N" if cycle == 1 else f"+{cycle}N"
        add(k, f"k{later}", cycle, f"measurement {number} is taken", True)
        if cycle >= cycles:
            continue
        if arrives:
            add(k + timing.M, f"m{later}", cycle, f"measurement {number} arrives")
        if cycle in landings:
            L = landings[cycle]
            text = f"l{later}" if landings.get(0) == L else f"l = k{later}+{L}"
            add(k + L, text, cycle, landing.format(number))
    return [_joined(step, marks) for step, marks in sorted(names.items())]


def _joined(step: int, marks: Sequence[Mark]) -> Mark:
    """In order of their cycles: "m = k+N" where the measurement arrives as the next one is taken."""
    ordered = sorted(marks, key=lambda mark: mark.cycle)
    text, meaning = (
        joint.join(getattr(mark, name) for mark in ordered) for joint, name in ((" = ", "text"), (", ", "meaning"))
    )
    return Mark(step, text, ordered[0].cycle, any(mark.is_k for mark in ordered), meaning)
