"""The folder in which the files are written: a new one, or one that holds such files already."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from sched_sim.errors import InputError
from sched_sim.files.writable import write


def check_folder(folder: Path, names: frozenset[str], what: str) -> None:
    """Raises InputError unless the folder is new, or holds none but files of these names. what: the option."""
    if folder.exists() and not folder.is_dir():
        raise InputError(
            f"{what} {str(folder)!r} is a file: give a folder, a new one or one that this command has made"
        )
    others = sorted(path.name for path in folder.iterdir() if path.name not in names) if folder.exists() else []
    if others:
        more = f" and {len(others) - MOST_NAMED} more" if len(others) > MOST_NAMED else ""
        raise InputError(
            f"{what} {str(folder)!r} holds {', '.join(others[:MOST_NAMED])}{more}, not made by this command: give a "
            f"folder of its own"
        )


MOST_NAMED = 3
"""Files, in a message."""


def write_folder(folder: Path, files: Mapping[str, str], names: frozenset[str], what: str) -> None:
    """Those of `names` that are there and not among the files, of another method, are removed.

    Raises InputError where it cannot be made or written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{what} {str(folder)!r} cannot be made: {error.strerror}; give another folder") from error
    for name in names - files.keys():
        (folder / name).unlink(missing_ok=True)
    for name, text in files.items():
        write(folder / name, text.encode(), what)
