"""Docstrings are plain text: here they become reStructuredText, and what they say of an argument its description."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

NAME = r"\*{0,2}\w+(?: \([^)]*\))?"  # of an argument, perhaps with its shape: P0 (n, n)
ITEM = re.compile(rf"(?:^|(?<=[;.] ))({NAME}(?:, {NAME})*): ", re.MULTILINE)
ONE = r"(\w+)(?: \([^)]*\))?"
RAISES = re.compile(r"^Raises:\n((?: {4}.*\n?)+)", re.MULTILINE)


def markup(text: str) -> str:
    """Plain text, with code between single backquotes."""
    return re.sub(r"`([^`]+)`", r"``\1``", re.sub(r"([*|\\]|_\b)", r"\\\1", text))


def described(paragraph: str, arguments: set[str]) -> Iterator[str]:
    """The paragraph, and a field for each argument that it describes."""
    items = [
        item for item in ITEM.finditer(paragraph) if arguments >= set(re.findall(r"(\w+)(?: \([^)]*\))?", item[1]))
    ]
    starts = [item.start() for item in items]
    yield markup(" ".join(paragraph[: min(starts, default=len(paragraph))].split()))
    for item, end in zip(items, [*starts, len(paragraph)][1:], strict=True):
        words = markup(" ".join(paragraph[item.end() : end].split()).rstrip(";"))
        names = re.findall(r"(\w+)( \([^)]*\))?", item[1])
        for name, shape in names:
            yield f":param {name}: {markup(shape.strip()) + '; ' if shape else ''}{words}"


def raises(text: str) -> str:
    """`Raises:` with a list below it, as sentences."""
    return RAISES.sub(lambda found: "Raises " + re.sub(r"\n? {4}(?=\w+: )", "\n\nRaises ", found[1])[9:], text)


def as_text(_app: Any, what: str, _name: str, documented: Any, _options: Any, lines: list[str]) -> None:
    text = re.sub(r"\n(?=Raises )", "\n\n", raises("\n".join(lines)))
    if what == "module":
        text = text.partition("\n\n")[0]
    try:
        arguments = set(inspect.signature(documented).parameters)
    except (TypeError, ValueError):
        arguments = set()
    lines[:] = [
        line for paragraph in text.split("\n\n") for part in described(paragraph, arguments) for line in ("", part)
    ]


def is_no_alias(_app: Any, _what: str, _name: str, member: Any, _skip: bool, _options: Any) -> bool | None:
    """Fields of named tuples say nothing of themselves."""
    return True if (getattr(member, "__doc__", None) or "").startswith("Alias for field number") else None


def setup(app: Any) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", as_text)
    app.connect("autodoc-skip-member", is_no_alias)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
