"""A measurement that is used when it is there: the standard filter, and the one that takes late ones for new."""

from __future__ import annotations

from studies.board.serial.method import TEXTS, Parts, Serial, add_arrays, add_correction


def _memory(parts: Parts) -> None:
    n = parts.system.states
    add_arrays(parts, x=(2, n), P=(2, n, n))
    add_correction(parts, "update")


STANDARD = Serial(
    title="Kalman filter",
    behaviour="A measurement is used in the step in which it is taken.",
    jobs=("propagate", "update"),
    order="after",
    template="at_once.c",
    texts={**TEXTS, "k": "filter.j"},
    memory=_memory,
)
FUSE_AS_FRESH = STANDARD._replace(
    title="Kalman filter that takes a late measurement for a new one",
    behaviour="It is used at m as if it were of m: the estimate is wrong by what has moved since k.",
)
