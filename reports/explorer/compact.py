"""Scripts and style sheets as they are put into pages, of which each has its own copy."""

from __future__ import annotations

import re

_COMMENT = re.compile(r"^[ \t]*/\*.*?\*/[ \t]*\n", re.MULTILINE | re.DOTALL)


def compact(text: str) -> str:
    """Without indentation, empty lines, and comments that have lines of their own. Line ends stay: in a script they may
    end a statement. A script must have no text of several lines."""
    lines = (line.strip() for line in _COMMENT.sub("", text).splitlines())
    return "".join(f"{line}\n" for line in lines if line and not line.startswith("//"))
