"""The minus signs of a page."""

from __future__ import annotations

import re

NOT_TEXT = re.compile(r"(`[^`]*`|\]\([^)]*\)|<[^>]*>)")
HYPHEN = re.compile(r"(?<![\w.,)\]†'\"-])-(?=\.?\d)|(?<=\de)-(?=\d)")
"""Before a number, or before the power of ten of one: no range, no date, no name."""


def true_minus(text: str) -> str:
    """Markdown, or a text of a figure, whose negative numbers have a minus sign instead of a hyphen.

    Code, names of files and elements of HTML are as they were.
    """
    parts = NOT_TEXT.split(text)
    return "".join(part if number % 2 else HYPHEN.sub("\N{MINUS SIGN}", part) for number, part in enumerate(parts))
