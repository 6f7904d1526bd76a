"""Heaps in one array, for event loops that are compiled: of (rank, order, item), the least rank on top, and of equals
the least order.

heaps[which, i]: the i-th entry of a heap; size: how many it has. Whole numbers of 64 bits, and room for one more.
"""

from __future__ import annotations

from typing import Any


def push(heaps: Any, which: int, size: int, rank: int, order: int, item: int) -> int:
    """The size with this entry."""
    at = size
    while at:
        above = (at - 1) >> 1
        if _before(heaps, which, above, rank, order):
            break
        _copy(heaps, which, above, at)
        at = above
    _put(heaps, which, at, rank, order, item)
    return size + 1


def replace(heaps: Any, which: int, size: int, rank: int, order: int, item: int) -> None:
    """This entry instead of the one on top."""
    at = 0
    while True:
        below = 2 * at + 1
        if below >= size:
            break
        if below + 1 < size and _before(heaps, which, below + 1, heaps[which, below, 0], heaps[which, below, 1]):
            below += 1
        if not _before(heaps, which, below, rank, order):
            break
        _copy(heaps, which, below, at)
        at = below
    _put(heaps, which, at, rank, order, item)


def pop(heaps: Any, which: int, size: int) -> int:
    """The size without the one on top."""
    last = size - 1
    replace(heaps, which, last, heaps[which, last, 0], heaps[which, last, 1], heaps[which, last, 2])
    return last


def _before(heaps: Any, which: int, at: int, rank: int, order: int) -> bool:
    return bool(heaps[which, at, 0] < rank or (heaps[which, at, 0] == rank and heaps[which, at, 1] < order))


def _copy(heaps: Any, which: int, source: int, target: int) -> None:
    for field in range(3):
        heaps[which, target, field] = heaps[which, source, field]


def _put(heaps: Any, which: int, at: int, rank: int, order: int, item: int) -> None:
    heaps[which, at, 0], heaps[which, at, 1], heaps[which, at, 2] = rank, order, item
