"""What the page on the explorer calls the controls and headings is what they are called."""

from __future__ import annotations

import re

from reports.explorer.module import module
from tests.docs.test_examples import ROOT

PAGE = (ROOT / "docs" / "howto" / "explorer.md").read_text(encoding="utf-8")


def test_its_bold_words_are_labels_and_its_italic_ones_headings_and_buttons() -> None:
    said = set(re.findall(r'"([^"\n]+)"', module("page")))
    bold = set(re.findall(r"\*\*([^*]+)\*\*", PAGE)) - {"Four curves", "The schedule", "Parts"}
    assert {"Loop rate", "Delay", "Needed accuracy", "Land by"} <= bold
    assert bold <= said
    italic = set(re.findall(r"(?<!\*)\*([^*]+)\*(?!\*)", PAGE)) - {"Designs that keep 0.4 m"}
    assert italic <= said
