"""A picture as elements of a page: its texts are found and copied, and it follows the page into the dark."""

from __future__ import annotations

import re
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from reports.drawing.dark import themed
from reports.pages.smaller import plain, smaller

RULE = re.compile(r"([\w*]+)\s*\{([^}]*)\}")
PAINTS = ("fill", "stroke")


def inline(svg: bytes, name: str, title: str) -> str:
    """An <svg> element that says `title`; see `smaller`.

    name: a word; what the picture refers to has names that begin with it, so that several pictures are in one page.
    """
    root = smaller(svg)
    rest = root.attrib
    common = _rules_of_file(root, name)
    root.attrib = {"class": name, "role": "img", "viewBox": rest["viewBox"]}
    _rename(root, name)
    rules = [f".{name}{{fill:{themed('#000000')}}}", *common, *_classes(root, name)]
    _titled(root, title, "".join(rules))
    return ElementTree.tostring(root, encoding="unicode")


def _rules_of_file(root: Element, name: str) -> list[str]:
    """The file's own style sheet, which is taken out, for this picture alone; what it says of all is inherited."""
    found = [rule for style in root.iter("style") for rule in RULE.findall(style.text or "")]
    for parent in root.iter():
        for child in [child for child in parent if child.tag in ("style", "title")]:
            parent.remove(child)
    of = {"*": f".{name}"}
    return [f"{of.get(which, f'.{name} {which}')}{{{plain(declared)}}}" for which, declared in found]


def _rename(root: Element, name: str) -> None:
    """Short, and none that another picture has."""
    names = {old: f"{name}-{number}" for number, old in enumerate(_ids(root))}
    for element in root.iter():
        for key, value in element.items():
            element.set(key, names[value] if key == "id" else _referring(value, names))


def _ids(root: Element) -> list[str]:
    return [element.attrib["id"] for element in root.iter() if "id" in element.attrib]


def _referring(value: str, names: dict[str, str]) -> str:
    return re.sub(r"#([\w-]+)", lambda old: f"#{names.get(old[1], old[1])}", value)


def _classes(root: Element, name: str) -> list[str]:
    """Rules, one for each look; elements have its class instead."""
    looks: dict[str, str] = {}
    for element in root.iter():
        look = ";".join(filter(None, (element.attrib.pop("style", ""), *_paints(element))))
        if look and look != "fill:none":
            element.set("class", looks.setdefault(look, f"{name}-s{len(looks)}"))
        elif look:
            element.set("fill", "none")
    return [f".{named}{{{themed(look)}}}" for look, named in looks.items()]


def _paints(element: Element) -> list[str]:
    return [f"{paint}:{element.attrib.pop(paint)}" for paint in PAINTS if paint in element.attrib]


def _titled(root: Element, title: str, rules: str) -> None:
    said, style = Element("title"), Element("style")
    said.text, style.text = title, rules
    root[:] = [said, style, *root]
