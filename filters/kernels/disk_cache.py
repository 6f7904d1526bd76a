"""A numba cache in a folder of our choice that never fails: at worst a function is compiled again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numba
from numba.core.caching import FunctionCache


class _QuietCache(FunctionCache):  # type: ignore[misc]
    """numba's cache of one function, in which an unreadable or unwritable entry counts as absent.

    An entry is unreadable when it was made for a user's own model whose module cannot be imported now.
    """

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        try:
            return super().load_overload(sig, target_context)
        except Exception:
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        try:
            super().save_overload(sig, data)
        except Exception:
            return


def keep_on_disk(dispatcher: Any, folder: Path) -> None:
    """Cache what a numba dispatcher compiles in `folder`; do nothing where the function or the folder forbids it."""
    previous = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(folder)  # read once, when a cache is made
    try:
        dispatcher._cache = _QuietCache(dispatcher.py_func)
    except (RuntimeError, OSError):  # no source file, or no folder that can be written
        return
    finally:
        numba.config.CACHE_DIR = previous
