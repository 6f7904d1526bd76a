"""Late measurements on their way, and whether two of them are at once."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import NamedTuple


class Flight(NamedTuple):
    """A measurement of the sensor of this name, taken in one HR step, that arrives in a later one."""

    sensor: str
    taken: int
    arrives: int


def first_overlap(flights: Iterable[Flight]) -> tuple[Flight, Flight] | None:
    """The first two of which one is taken before the other has arrived; one that is taken in the very step in which the
    other arrives is not."""
    in_order = sorted(flights, key=lambda flight: (flight.taken, flight.arrives))
    return next(
        ((flight, following) for flight, following in pairwise(in_order) if following.taken < flight.arrives), None
    )
