"""Labels on a line are moved apart no more than they must be."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from reports.drawing.placing import spread, worst_shift


@given(
    st.lists(st.floats(0, 100), max_size=8),
    st.lists(st.floats(0.5, 12), min_size=8, max_size=8),
    st.floats(0, 3),
)
def test_spread_labels_neither_overlap_nor_leave_the_line(wished: list[float], sizes: list[float], gap: float) -> None:
    centres, widths = sorted(wished), sizes[: len(wished)]
    placed = spread(centres, widths, -10, 140, gap)
    assert len(placed) == len(centres)
    edges = [(at - width / 2, at + width / 2) for at, width in zip(placed, widths, strict=True)]
    assert all(before[1] + gap <= after[0] + 1e-9 for before, after in pairwise(edges))
    assert all(start >= -10 - 1e-9 and end <= 140 + 1e-9 for start, end in edges)
    free = all(b - a >= (u + v) / 2 + gap for (a, b), (u, v) in zip(pairwise(centres), pairwise(widths), strict=True))
    if free and all(w / 2 - 10 <= c <= 140 - w / 2 for c, w in zip(centres, widths, strict=True)):
        assert worst_shift(centres, placed) < 1e-9
