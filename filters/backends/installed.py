"""Whether code is of a library that was installed, or of Python itself, and not of the user's or of this project."""

from __future__ import annotations

import os
from pathlib import Path
from types import FunctionType

_ROOT = Path(__file__).resolve().parents[2]
_OURS = tuple(os.path.join(_ROOT, package, "") for package in ("filters", "reports", "sched_sim", "studies"))
_PYTHON = ("<frozen ", os.path.join(os.path.dirname(os.path.abspath(os.__file__)), ""))
_FOLDERS = frozenset({"site-packages", "dist-packages"})


def is_installed(file: str) -> bool:
    """By the file that the code is from."""
    if file.startswith(_OURS):
        return False
    return file.startswith(_PYTHON) or not _FOLDERS.isdisjoint(Path(file).parts)


def is_foreign(function: FunctionType, caller: FunctionType | None) -> bool:
    """Whether it is installed and not of the caller's package, so that what it needs around it is not known here."""
    if not is_installed(function.__code__.co_filename):
        return False
    return caller is None or _package(function) != _package(caller)


def _package(function: FunctionType) -> str:
    return str(function.__module__).partition(".")[0]
