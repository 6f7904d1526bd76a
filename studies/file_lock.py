"""At most one sweep writes a results file."""

from __future__ import annotations

import os
from pathlib import Path

from sched_sim.errors import InputError


class FileLock:
    """Held from construction to `release`, by means of a file `<path>-lock`; it goes with the process that holds it.

    Raises InputError if another process holds it, or the file cannot be made.
    """

    def __init__(self, path: Path) -> None:
        import fcntl

        self.path = path.with_name(f"{path.name}-lock")
        while True:
            try:
                self._descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT, 0o666)
            except OSError as error:
                raise InputError(
                    f"results file {path} cannot be written: {error.strerror}; give another --results"
                ) from None
            try:
                fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                os.close(self._descriptor)
                raise InputError(
                    f"results file {path} is being written by another sweep: wait for it, or give another --results"
                ) from None
            if self._is_still_there():
                return
            os.close(self._descriptor)

    def release(self) -> None:
        self.path.unlink()
        os.close(self._descriptor)

    def _is_still_there(self) -> bool:
        """Whether the file locked is the one of that name: its last holder may just have removed it."""
        try:
            return os.path.samestat(os.fstat(self._descriptor), self.path.stat())
        except FileNotFoundError:
            return False
