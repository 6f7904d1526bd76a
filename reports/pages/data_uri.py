"""A picture as an address, so that a page holds it: smaller than the file, and the same to the eye."""

from __future__ import annotations

import re


def data_uri(svg: bytes) -> str:
    """For an attribute in double quotes. Comments, metadata and line breaks are left out, and coordinates are given to
    a hundredth of a point."""
    text = svg.decode()
    text = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)
    text = re.sub(r' d="[^"]*"', lambda path: re.sub(r"-?\d+\.\d{3,}", _rounded, path[0]), text)
    text = re.sub(r"\s+", " ", text).replace("> <", "><").replace('"', "'")
    return "data:image/svg+xml," + text.replace("%", "%25").replace("#", "%23")


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}"
