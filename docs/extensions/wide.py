"""What is wider than a phone: the keyboard can scroll it too, and a picture opens on its own. Options stay whole."""

from __future__ import annotations

import re
from html import unescape
from typing import Any

from docutils import nodes

from reports.drawing.style import WIDTH_MM

NARROWEST = 36
"""Characters of code that are on a line of a phone."""

HYPHENED = re.compile(r'<span class="pre">(?=[^<]*-[^<]*</span>)(?=[^<]{1,18}<)')
"""A short word of code at whose hyphens a line would be broken, such as --hr-hz."""


def open_alone(_app: Any, doctree: nodes.document) -> None:
    """Sphinx links a picture whose width is stated to its file."""
    for image in doctree.findall(nodes.image):
        image["width"] = f"{WIDTH_MM:g}mm"


def to_scroll(_app: Any, _page: str, _template: str, context: dict[str, Any], _doctree: Any) -> None:
    """Code with a long line, and tables, are stops of the Tab key."""
    code = re.compile(r"<pre>(?=(.*?)</pre>)", re.DOTALL)
    body = code.sub(lambda tag: '<pre tabindex="0">' if is_long(tag[1]) else tag[0], context.get("body", ""))
    body = HYPHENED.sub('<span class="pre whole">', body)
    context["body"] = body.replace('<div class="table-wrapper ', '<div tabindex="0" class="table-wrapper ')


def is_long(code: str) -> bool:
    return any(len(unescape(line)) > NARROWEST for line in re.sub(r"<[^>]*>", "", code).splitlines())


def setup(app: Any) -> dict[str, bool]:
    app.connect("doctree-read", open_alone)
    app.connect("html-page-context", to_scroll)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
