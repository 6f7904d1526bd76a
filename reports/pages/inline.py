"""A picture as elements of a page: its texts are found and copied, and it follows the page into the dark."""

from __future__ import annotations

import re
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from reports.drawing.dark import themed
from reports.pages.smaller import plain, smaller

RULE = re.compile(r"([\w*]+)\s*\{([^}]*)\}")
ALONE = re.compile(r"(?:^|;)opacity:")
"""Of an element, not of those in it."""
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
    looks = _looks(root, name)
    _hoist(root, {named for look, named in looks.items() if not ALONE.search(look)})
    rules = [f".{named}{{{themed(look)}}}" for look, named in looks.items()]
    _titled(root, title, "".join([f".{name}{{fill:{themed('#000000')}}}", *common, *rules]))
    return ElementTree.tostring(root, encoding="unicode").replace(" />", "/>")


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
    names = {old: f"{name}i{number}" for number, old in enumerate(_ids(root))}
    for element in root.iter():
        for key, value in element.items():
            element.set(key, names[value] if key == "id" else _referring(value, names))


def _ids(root: Element) -> list[str]:
    return [element.attrib["id"] for element in root.iter() if "id" in element.attrib]


def _referring(value: str, names: dict[str, str]) -> str:
    return re.sub(r"#([\w-]+)", lambda old: f"#{names.get(old[1], old[1])}", value)


def _looks(root: Element, name: str) -> dict[str, str]:
    """Names of classes by their declarations, which elements have instead."""
    looks: dict[str, str] = {}
    for element in root.iter():
        look = ";".join(filter(None, (element.attrib.pop("style", ""), *_paints(element))))
        if look == "fill:none":
            element.set("fill", "none")
        elif look:
            element.set("class", looks.setdefault(look, f"{name}s{len(looks)}"))
    return looks


def _hoist(root: Element, inherited: set[str]) -> None:
    """Of signs in one group that all look alike, their group has the class, if it is one that is `inherited`."""
    for group in root.iter("g"):
        looks = {child.get("class", "") for child in group}
        if (
            {child.tag for child in group} == {"use"}
            and len(looks) == 1
            and looks <= inherited
            and not group.get("class")
        ):
            group.set("class", looks.pop())
            for child in group:
                child.attrib.pop("class", None)


def _paints(element: Element) -> list[str]:
    return [f"{paint}:{element.attrib.pop(paint)}" for paint in PAINTS if paint in element.attrib]


def _titled(root: Element, title: str, rules: str) -> None:
    said, style = Element("title"), Element("style")
    said.text, style.text = title, rules
    root[:] = [said, style, *root]
