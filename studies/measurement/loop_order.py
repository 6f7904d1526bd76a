"""In which order the loops of a filter run its parts: one loop for each way with late measurements."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from filters.kernels.place import IntArray
from filters.modular.composition import ModularFilter

LOOPS = (
    ("predict", "correct"),
    ("predict_accumulate", "correct_accumulate", "correct_late"),
    ("predict", "carry", "correct", "beside", "land"),
    ("predict", "carry_product", "correct", "beside_product", "land_product"),
    (
        "hr_propagate",
        "hr_restart",
        "lr_propagate",
        "gain",
        "gain_again",
        "gain_kept",
        "lr_correct",
        "hr_pass",
        "hr_update",
    ),
)
"""Kinds of parts, of a step in their order: to go back, Larsen with one in flight, carried gains, carried products of
transitions, and dual-rate. A kind is there once, or once for each sensor."""

EVERY_STEP = ("predict", "predict_accumulate", "carry", "carry_product", "hr_propagate")
"""All others run when a measurement is due: of their sensor, or of any."""


def loops_of(parts: Collection[str]) -> list[list[str]]:
    """The parts of each loop that has one of which no loop before it has."""
    loops: list[list[str]] = []
    seen: set[str] = set()
    for kinds in LOOPS:
        loop = [part for kind in kinds for part in parts if part.partition(".")[0] == kind]
        if not seen.issuperset(loop):
            loops.append(loop)
            seen.update(loop)
    return loops


def order_of(loop: Sequence[str], composed: ModularFilter, steps: int) -> IntArray:
    """The numbers of parts of the loop, in so many steps, one after the other."""
    due = np.zeros((steps, len(loop)), dtype=bool)
    for number, part in enumerate(loop):
        kind, _, name = part.partition(".")
        if kind in EVERY_STEP:
            due[:, number] = True
        else:
            for sensor in composed.sensors:
                if name in ("", sensor.name):
                    due[sensor.takes(steps), number] = True
    return np.asarray(np.nonzero(due)[1])
