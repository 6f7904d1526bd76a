"""What numba says of a function that it cannot compile, in one line: its own message has fifty."""

from __future__ import annotations

import re
from pathlib import Path

UNKNOWN = re.compile(
    r"^(?:Unknown attribute '(?P<attribute>\w+)' of type Module\(<module '(?P<module>[\w.]+)'|"
    r"Untyped global name '(?P<name>\w+)': Cannot determine Numba type of <class '(?:function|numpy\.ufunc)'>)"
)
WHERE = re.compile(r'^File "(?P<file>[^"]+)", line (?P<line>\d+):$')


def is_numbas(error: Exception) -> bool:
    """Whether numba refused to compile something; asked without an import of numba, which costs half a second."""
    return type(error).__module__.startswith("numba.")


def gist(error: Exception) -> str:
    """The reason, and the line of the user's file that it is about, where there is one."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith("Failed in")] or [type(error).__name__]
    reason = lines[0]
    if reason.endswith("signature:"):
        reason = " ".join([reason.removesuffix(" found for signature:"), *_starting(">>>", lines)[:1]])
    if unknown := UNKNOWN.match(reason):
        function = unknown["name"] or f"{unknown['module']}.{unknown['attribute']}"
        return f"it has no code for {function}{_place(lines)}; compute that with functions of NumPy or in loops"
    return f"{reason.rstrip('.')}{place}" if (place := _place(lines)) else reason


def _place(lines: list[str]) -> str:
    places = [place for line in lines if (place := WHERE.match(line))]
    if not places or "^" not in lines:
        return ""
    return f", in {Path(places[0]['file']).name}, line {places[0]['line']}: {lines[lines.index('^') - 1]}"


def _starting(mark: str, lines: list[str]) -> list[str]:
    return [line.removeprefix(mark).strip() for line in lines if line.startswith(mark)]
