"""Power against accuracy: each landing of each method, and which no other design beats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from studies.explorer.accuracy import Accuracy
from studies.selection.unbeaten import unbeaten


class Front(NamedTuple):
    """Columns: landings, the least speed for each, the standard deviation of the output there. on_front: no other
    design, of any method, is as accurate with less."""

    L: list[int]
    power: list[Fraction | float]
    std: list[float]
    on_front: list[bool]


def front(
    stairs: Mapping[str, tuple[Sequence[int], Sequence[Fraction | float]]], accuracies: Mapping[str, Accuracy]
) -> dict[str, Front]:
    """By method, of those that have both.

    stairs: by method the landings, and the least speed for each; a method that lands in one step alone has one stair.
    """
    points = [
        (method, L, speed, std)
        for method, (landings, speeds) in stairs.items()
        for L, speed in zip(landings, speeds, strict=True)
        if method in accuracies and (std := accuracies[method].at(L)) is not None
    ]
    best = unbeaten([(speed, std) for _, _, speed, std in points])
    found: dict[str, Front] = {}
    for (method, L, speed, std), on_front in zip(points, best, strict=True):
        of = found.setdefault(method, Front([], [], [], []))
        of.L.append(L)
        of.power.append(speed)
        of.std.append(std)
        of.on_front.append(on_front)
    return found
