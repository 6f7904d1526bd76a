"""What a picture says: the texts of an SVG."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

SVG = "{http://www.w3.org/2000/svg}"


def texts(svg: bytes) -> list[str]:
    """In the order in which they are drawn; those of formulas as they are read, without their typesetting."""
    return ["".join(text.itertext()) for text in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def texts_of(picture: Path) -> list[str]:
    return texts(picture.read_bytes())
