"""Where in the user's own code something failed."""

from __future__ import annotations

import sysconfig
from pathlib import Path
from traceback import walk_tb

PROJECT = Path(__file__).parents[2]
OURS = tuple(PROJECT / package for package in ("sched_sim", "filters", "studies", "reports"))
LIBRARIES = tuple(Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "platstdlib", "purelib", "platlib"))


def failed_line(error: BaseException) -> str:
    """File and line, as "model.py, line 3": the last of the traceback that is neither in this project nor in a library;
    empty if there is none."""
    last = ""
    for frame, line in walk_tb(error.__traceback__):
        path = Path(frame.f_code.co_filename)
        if path.is_absolute() and not any(path.resolve().is_relative_to(folder) for folder in (*OURS, *LIBRARIES)):
            last = f"{shown_path(path)}, line {line}"
    return last


def shown_path(path: Path) -> str:
    """From the current folder, if it is in there."""
    here = Path.cwd()
    return str(path.relative_to(here) if path.is_relative_to(here) else path)
