"""A picture as an address, so that a page holds it as an image."""

from __future__ import annotations

from xml.etree import ElementTree

from reports.pages.smaller import smaller

ESCAPES = str.maketrans({"%": "%25", "#": "%23", '"': "%22", "\n": "%0A"})


def data_uri(svg: bytes) -> str:
    """For an attribute in double quotes; see `smaller`."""
    root = smaller(svg)
    root.set("xmlns", "http://www.w3.org/2000/svg")
    return "data:image/svg+xml," + ElementTree.tostring(root, encoding="unicode").translate(ESCAPES)
