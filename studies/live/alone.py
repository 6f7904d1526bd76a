"""One live run at a time on a core."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sched_sim.errors import InputError, option

CORES = Path("/sys/devices/system/cpu")
"""Where the kernel has a folder for each core, which is locked: there is nothing to write, and nothing stays."""


@contextmanager
def alone_on(core: int) -> Iterator[None]:
    """Keeps other live runs off the core within the context, however either ends. Raises InputError if one has it."""
    import fcntl
    import os

    folder = CORES / f"cpu{core}"
    if not folder.exists():
        yield
        return
    lock = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(
                f"{option('cpu')} {core}: another live run has this core, and two disturb each other: give another, or "
                f"wait until it is done"
            ) from None
        yield
    finally:
        os.close(lock)
