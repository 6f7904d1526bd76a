"""Where labels go on a line so that none covers another."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise


def spread(centres: Sequence[float], widths: Sequence[float], low: float, high: float, gap: float) -> list[float]:
    """New centres, as near the wished ones as can be (least squares), `gap` apart and within [low, high].

    The wished centres come in ascending order. If all together are wider than the line, they overlap its ends.
    """
    if not centres:
        return []
    offsets = [0.0]
    for left, right in pairwise(widths):
        offsets.append(offsets[-1] + (left + right) / 2 + gap)
    blocks: list[tuple[float, int]] = []  # labels that touch: mean of (wished - offset), how many
    for centre, offset in zip(centres, offsets, strict=True):
        mean, count = centre - offset, 1
        while blocks and blocks[-1][0] > mean:
            before, more = blocks.pop()
            mean, count = (before * more + mean * count) / (more + count), more + count
        blocks.append((mean, count))
    least, most = low + widths[0] / 2, high - widths[-1] / 2 - offsets[-1]
    shifts = [min(max(mean, least), most) for mean, count in blocks for _ in range(count)]
    return [shift + offset for shift, offset in zip(shifts, offsets, strict=True)]


def worst_shift(centres: Sequence[float], placed: Sequence[float]) -> float:
    """The farthest that a label stands from where it was wished."""
    return max((abs(wished - got) for wished, got in zip(centres, placed, strict=True)), default=0.0)
