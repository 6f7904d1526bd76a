"""A numba cache in a folder of our choice that never fails: at worst a function is compiled again."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any


class _QuietCache:
    """numba's cache of one function, in which an unreadable or unwritable entry counts as absent.

    Entries are unreadable when one of them was made for a user's own model whose module cannot be imported now.
    """

    def __init__(self, cache: Any) -> None:
        self._cache = cache

    def __getattr__(self, name: str) -> Any:
        return getattr(self._cache, name)

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        try:
            return self._cache.load_overload(signature, target_context)
        except Exception:
            with suppress(Exception):
                self._cache.flush()  # the good entries go too, or nothing could be added to them
            return None

    def save_overload(self, signature: Any, data: Any) -> None:
        with suppress(Exception):
            self._cache.save_overload(signature, data)


def keep_on_disk(dispatcher: Any, folder: Path) -> None:
    """Cache what a numba dispatcher compiles in `folder`; do nothing where the function or the folder forbids it."""
    config: Any = import_module("numba").config
    new_cache: Any = import_module("numba.core.caching").FunctionCache
    previous = config.CACHE_DIR
    config.CACHE_DIR = str(folder)  # read once, when a cache is made
    try:
        cache = new_cache(dispatcher.py_func)
    except (RuntimeError, OSError):  # no source file, or no folder that can be written
        return
    finally:
        config.CACHE_DIR = previous
    if Path(cache.cache_path).is_relative_to(folder):  # else numba chose a place where entries go stale
        dispatcher._cache = _QuietCache(cache)
