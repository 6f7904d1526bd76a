"""A picture as a page holds it: smaller than the file, and the same to the eye."""

from __future__ import annotations

import re
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

WRITTEN = ("text", "tspan", "title", "style")
"""Elements of which spaces are text."""
PLACES = ("x", "y", "width", "height")


def smaller(svg: bytes) -> Element:
    """Without comments, metadata, spaces, and names and groups that nothing refers to; coordinates to a hundredth of a
    point. Names of elements and attributes are without namespaces."""
    root = ElementTree.fromstring(svg)
    for element in root.iter():
        element.tag = _local(element.tag)
        element.attrib = {_local(name): value for name, value in element.attrib.items()}
    named = set(
        re.findall(r"#([\w-]+)", " ".join(value for element in root.iter() for value in element.attrib.values()))
    )
    _shorten(root, named)
    return root


def _local(name: str) -> str:
    return name.rpartition("}")[2]


def _shorten(element: Element, named: set[str]) -> None:
    children = []
    for child in element:
        if child.tag == "metadata":
            continue
        _shorten(child, named)
        children += list(child) if child.tag == "g" and not child.attrib else [child]
    element[:] = children
    if element.tag not in WRITTEN:
        element.text = None
    if element.tag != "tspan":
        element.tail = None
    element.attrib = {name: _value(name, value) for name, value in element.items() if name != "id" or value in named}


def _value(name: str, value: str) -> str:
    if name == "d":
        return _path(value)
    if name == "style":
        return plain(value)
    if name == "transform":
        return re.sub(r"(?:translate|rotate)\([^)]*\)", lambda moved: _numbers(moved[0]), value)
    return _numbers(value) if name in PLACES else value


def _numbers(text: str) -> str:
    return re.sub(r"-?\d+\.\d+", _rounded, text)


def plain(declarations: str) -> str:
    """Of CSS, without spaces."""
    return declarations.replace(": ", ":").replace("; ", ";")


def _path(path: str) -> str:
    """The same outline: no spaces beside letters and signs, no zeros at the end of decimals."""
    return re.sub(r"\s*([A-Za-z])\s*| (?=-)", lambda letter: letter[1] or "", " ".join(_numbers(path).split()))


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")
