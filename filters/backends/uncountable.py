"""What a function does that cannot be counted, and where, said in the user's words."""

from __future__ import annotations

import linecache
import traceback
from functools import partial
from pathlib import Path
from types import FrameType
from typing import Any

from filters.backends.counted_scalar import UncountedError
from filters.backends.installed import is_installed

_REMEDY = "write it with + - * / and functions of single numbers, such as np.sin or math.sin, in arrays of its own"


class UncountableError(ValueError):
    """A function does something with its numbers that cannot be counted."""


def uncountable(error: Exception, function: Any = None) -> UncountableError | None:
    """What is to be said of an error that came out of a function run on numbers that count; None if it is no one's.

    The line that is named is the last that is not of a library, and of the user's if there is one; where all are of
    libraries, the function is.
    """
    steps = zip(traceback.walk_tb(error.__traceback__), traceback.extract_tb(error.__traceback__), strict=True)
    written = [(frame, step) for (frame, _), step in steps if not _is_machinery(frame)]
    users = [each for each in written if not _module(each[0]).startswith("filters.")]
    reason = f": {error}" if isinstance(error, UncountedError) else ""
    if written:
        frame, step = (users or written)[-1]
        what = f"{_name(frame)} in {Path(step.filename).name}, line {step.lineno}: {_expression(step)}"
    elif reason or _ends_in_library(error):
        what = f"{getattr(_innermost(function), '__name__', 'what it calls')}()"
    else:
        return None
    return UncountableError(f"{what} cannot be counted{reason}; {_REMEDY}")


def _ends_in_library(error: Exception) -> bool:
    frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
    return bool(frames) and is_installed(frames[-1].f_code.co_filename)


def _innermost(function: Any) -> Any:
    """What a partial function calls."""
    return _innermost(function.func) if isinstance(function, partial) else function


def _is_machinery(frame: FrameType) -> bool:
    return is_installed(frame.f_code.co_filename) or _module(frame).startswith("filters.backends.counted")


def _module(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__"))


def _name(frame: FrameType) -> str:
    """The function's, or that around a comprehension."""
    named = [
        part for part in frame.f_code.co_qualname.split(".") if part not in ("<locals>", "<listcomp>", "<genexpr>")
    ]
    return "a lambda" if named[-1] == "<lambda>" else f"{named[-1]}()"


def _expression(step: traceback.FrameSummary) -> str:
    """What was being evaluated, or all of its line where that is not known; without a source, no more than that."""
    line = linecache.getline(step.filename, step.lineno or 0)
    if step.colno is None or step.end_colno is None or step.lineno != step.end_lineno:
        part = line.strip()
    else:
        part = line.encode()[step.colno : step.end_colno].decode(errors="replace")
    return part or "what it does"
