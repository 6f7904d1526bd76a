"""What the page on the explorer calls the controls and headings is what they are called."""

from __future__ import annotations

import re

from PIL import Image

from reports.explorer.module import module
from tests.docs.explorer_picture import HEIGHT, PICTURE, WIDTH
from tests.docs.test_examples import ROOT

PAGE = (ROOT / "docs" / "howto" / "explorer.md").read_text(encoding="utf-8")


def test_its_bold_words_are_labels_and_its_italic_ones_headings_and_buttons() -> None:
    said = set(re.findall(r'"([^"\n]+)"', module("page")))
    bold = set(re.findall(r"\*\*([^*]+)\*\*", PAGE)) - {"Four curves", "The schedule", "Parts"}
    assert {"Loop rate", "Delay", "Needed accuracy", "Land by"} <= bold
    assert bold <= said
    italic = set(re.findall(r"(?<!\*)\*([^*]+)\*(?!\*)", PAGE)) - {"Designs that keep 0.4 m"}
    assert italic <= said


def test_its_picture_is_small_and_as_it_was_made() -> None:
    """`python -m tests.docs.explorer_picture` makes it anew."""
    with Image.open(PICTURE) as picture:
        assert picture.size == (WIDTH, HEIGHT)
    assert PICTURE.stat().st_size <= 120_000
    assert f"]({PICTURE.name})" in PAGE
