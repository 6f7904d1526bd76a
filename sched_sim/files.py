"""Files that the user names for results."""

from __future__ import annotations

import os
from pathlib import Path

from sched_sim.errors import InputError


def check_writable(path: Path, what: str) -> None:
    """Raises InputError unless a file can be written at `path`, before the work that fills it; changes nothing.
    what: the option or thing the path is for."""
    folder = path.absolute().parent
    if path.is_dir() or not folder.is_dir() or not os.access(path if path.exists() else folder, os.W_OK):
        raise InputError(
            f"{what} {str(path)!r} cannot be written: give a file in a folder that exists and is yours to write"
        )
