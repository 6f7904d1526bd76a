"""Docstrings are plain text: here they become reStructuredText, with the public names of lazy packages at hand."""

from __future__ import annotations

import re
from typing import Any

ITEM = re.compile(r"(\w[\w, .]*(?: \([^)]*\))?)(: .*)")  # a line that says what a field or an argument is


def markup(line: str) -> str:
    line = re.sub(r"([*|\\]|_\b)", r"\\\1", line)
    return re.sub(r"`([^`]+)`", r"``\1``", line)


def as_text(_app: Any, _what: str, _name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """Each line `field: ...` becomes a paragraph of its own, its name in bold."""
    made: list[str] = []
    for line in lines:
        if found := ITEM.fullmatch(line):
            made += ["", f"**{found[1]}**{markup(found[2])}"]
        else:
            made.append(markup(line))
    lines[:] = made


def is_no_alias(_app: Any, _what: str, _name: str, member: Any, _skip: bool, _options: Any) -> bool | None:
    """Fields of named tuples say nothing of themselves."""
    return True if (getattr(member, "__doc__", None) or "").startswith("Alias for field number") else None


def setup(app: Any) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", as_text)
    app.connect("autodoc-skip-member", is_no_alias)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
