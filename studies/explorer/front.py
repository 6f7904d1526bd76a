"""Power against accuracy: each landing of each method, and which no other design beats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from studies.explorer.accuracy import Accuracy
from studies.selection.unbeaten import unbeaten


@dataclass(frozen=True, slots=True)
class FrontLine:
    """Columns: landings, the power that each takes and the standard deviation of the output there. on_front: no other
    design, of any method, is as accurate with less."""

    L: list[int]
    power: list[float]
    std: list[float]
    on_front: list[bool]


def front(
    stairs: Mapping[str, tuple[Sequence[int], Sequence[float]]], accuracies: Mapping[str, Accuracy]
) -> dict[str, FrontLine]:
    """By method, of those that have both.

    stairs: by method the landings, and the power that each takes; a method that lands in one step alone has one stair.
    """
    points = [
        (method, L, power, std)
        for method, (landings, powers) in stairs.items()
        for L, power in zip(landings, powers, strict=True)
        if method in accuracies and (std := accuracies[method].at(L)) is not None
    ]
    best = unbeaten([(power, std) for _, _, power, std in points])
    found: dict[str, FrontLine] = {}
    for (method, L, power, std), on_front in zip(points, best, strict=True):
        of = found.setdefault(method, FrontLine([], [], [], []))
        of.L.append(L)
        of.power.append(power)
        of.std.append(std)
        of.on_front.append(on_front)
    return found
