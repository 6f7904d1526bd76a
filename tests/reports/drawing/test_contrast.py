"""What is drawn is seen: marks 3:1 and texts 4.5:1 against their ground, on paper and in the dark."""

from __future__ import annotations

from itertools import chain

import pytest
from matplotlib.colors import to_hex

from reports.drawing.dark import DARK_GROUND, contrast, dark
from reports.drawing.style import FILLS, GREY, INK, METHOD_LINES, PALE, RED, SOURCE_LINES, SOURCES, TASK_FILLS, Fill

MARK, TEXT = 3.0, 4.5
LINES = {line.colour for line in chain(METHOD_LINES.values(), SOURCES.values(), SOURCE_LINES)}
SCENERY = {PALE}
"""Grid lines: numbers beside them say the same."""
OUTLINED = {"#b3d4ee", "#f4e9d8", "#dfe8f0", "#e3edf5", "#fbe3b5", "#dcdcdc", "#b7cfbc", "#d5c3dc"}
"""Pale fills, of which hatch, label and outline are seen."""


def in_both(colour: str) -> list[float]:
    """Its contrast on paper and in the dark."""
    return [contrast(colour, "#ffffff"), contrast(dark(colour), DARK_GROUND)]


@pytest.mark.parametrize("colour", sorted(LINES | {INK, GREY, RED}))
def test_marks_stand_out(colour: str) -> None:
    assert min(in_both(colour)) >= MARK


@pytest.mark.parametrize("colour", [INK, GREY, RED])
def test_texts_can_be_read(colour: str) -> None:
    assert min(in_both(colour)) >= TEXT


@pytest.mark.parametrize("fill", [*FILLS.values(), *TASK_FILLS], ids=lambda fill: f"{fill.meaning} {fill.colour}")
def test_work_stands_out_by_its_fill_or_its_ink(fill: Fill) -> None:
    pale = fill.colour in OUTLINED
    assert (contrast(fill.colour, "#ffffff") < MARK) == pale
    assert min(in_both(to_hex(fill.ink) if pale else fill.colour)) >= MARK


@pytest.mark.parametrize("fill", [*FILLS.values(), *TASK_FILLS], ids=lambda fill: f"{fill.meaning} {fill.colour}")
def test_labels_in_the_dark_can_be_read_if_they_can_on_paper(fill: Fill) -> None:
    for ink in (INK, "#ffffff"):
        if contrast(ink, fill.colour) >= TEXT:
            assert contrast(dark(ink), dark(fill.colour)) >= TEXT


def test_scenery_is_there_and_no_louder_than_marks() -> None:
    assert all(1.3 < ratio < MARK for colour in SCENERY for ratio in in_both(colour))
