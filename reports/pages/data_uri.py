"""A picture as an address, so that a page holds it: smaller than the file, and the same to the eye."""

from __future__ import annotations

import re


def data_uri(svg: bytes) -> str:
    """For an attribute in double quotes. Comments, metadata, spaces and names that nothing refers to are left out, and
    coordinates are given to a hundredth of a point."""
    text = svg.decode()
    text = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)
    text = re.sub(r' d="([^"]*)"', lambda path: f' d="{_short(path[1])}"', text)
    text = re.sub(r' style="[^"]*"', lambda style: style[0].replace(": ", ":").replace("; ", ";"), text)
    named = set(re.findall(r"#([\w-]+)", text))
    text = re.sub(r' id="([^"]*)"', lambda name: name[0] if name[1] in named else "", text)
    text = re.sub(r"\s+", " ", text).replace("> <", "><").replace('"', "'")
    return "data:image/svg+xml," + text.replace("%", "%25").replace("#", "%23")


def _short(path: str) -> str:
    """The same outline: no spaces beside letters and signs, no zeros at the end of decimals."""
    path = re.sub(r"-?\d+\.\d+", _rounded, path)
    return re.sub(r"\s*([A-Za-z])\s*| (?=-)", lambda letter: letter[1] or "", " ".join(path.split()))


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")
