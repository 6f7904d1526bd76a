"""What a command writes against what else it writes and what it reads."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from types import ModuleType
from typing import TypeAlias

from sched_sim.errors import InputError

Named: TypeAlias = Iterable[tuple[str, str | Path | None]]
"""Options and the files that they name; of an input also the name of something shipped, which is no file."""


def refuse_one_file_for_two(outputs: Named, inputs: Named = ()) -> None:
    """Raises InputError where a file to be written is another one to be written, or one to be read, however spelled."""
    written: list[tuple[str, Path]] = []
    for option, path in _files(outputs):
        for writer, there in written:
            if _same(path, there):
                raise InputError(
                    f"{writer} {there} and {option} {path} are one file, and only the last to be written would be "
                    f"left: give each a file of its own"
                )
        written.append((option, path))
    for reader, there in _files(inputs):
        for option, path in written:
            if _same(path, there):
                raise InputError(
                    f"{option} {path} would write over what {reader} {there} reads: give {option} a file of its own"
                )


def module_files() -> list[str]:
    """Python files that have been imported, the user's own among them."""
    modules = [module for module in list(sys.modules.values()) if isinstance(module, ModuleType)]
    return [file for module in modules if (file := vars(module).get("__file__"))]


def _files(named: Named) -> list[tuple[str, Path]]:
    """Without devices and pipes, of which nothing is lost."""
    paths = [(option, Path(path)) for option, path in named if path is not None]
    return [(option, path) for option, path in paths if os.path.isfile(path) or not os.path.exists(path)]


def _same(path: Path, second: Path) -> bool:
    """Under other spellings, through links of either kind."""
    if path == second:
        return True
    with suppress(OSError):  # the current folder may be gone
        if os.path.exists(path) and os.path.exists(second):
            return os.path.samefile(path, second)
        return os.path.realpath(path) == os.path.realpath(second)
    return False
