"""The one door through which text of the user's (names, paths, what their code says) reaches a terminal, a picture, CSV
or JSON.

What cannot be seen is shown as its escape: "\\x1b" for the escape character, "\\u202e" for what turns the direction of
writing, "\\udcff" for a byte of a path that is no UTF-8. Nothing is taken for markup. A cell of CSV that a spreadsheet
would compute has an apostrophe before it.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any

FORMULA = ("=", "+", "-", "@")
"""What a cell begins with that a spreadsheet takes for a formula."""


def visible(text: str) -> str:
    """On one line, with an escape for each character that has no shape of its own: controls, line ends, surrogates."""
    return text if text.isprintable() else "".join(map(_visible, text))


def visible_lines(text: str) -> str:
    """Text made `visible`, but the line ends stay; each line but the first is indented, so that it is seen to go on."""
    return "\n  ".join(visible(line) for line in text.split("\n"))


def csv_cell(value: Any) -> Any:
    """Text that is safe to open in a spreadsheet; anything else as it is."""
    if not isinstance(value, str):
        return value
    text = visible(value)
    return f"'{text}" if text.startswith(FORMULA) else text


def json_text(document: Any, indent: int | None = None) -> str:
    """ASCII that every parser takes: what is no character, a surrogate alone, is written as its escape."""
    return json.dumps(_encodable(document), indent=indent)


def did_you_mean(word: str, known: Sequence[str]) -> str:
    """The beginning of a remedy, where a known word is close to the one that was given; else nothing."""
    close = get_close_matches(word, known, 1)
    return f"did you mean {close[0]}? " if close else ""


def _visible(character: str) -> str:
    return character if character.isprintable() else character.encode("unicode_escape").decode()


def _encodable(value: Any) -> Any:
    match value:
        case str():
            return value.encode("utf-8", "backslashreplace").decode()
        case dict():
            return {_encodable(key): _encodable(item) for key, item in value.items()}
        case list() | tuple():
            return [_encodable(item) for item in value]
        case _:
            return value
