"""At most one sweep writes a results file."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

from sched_sim.errors import InputError, option


class FileLock:
    """Held from construction to `release`, by means of an empty file `.<name>.sched-sim-lock` in the folder of `path`;
    it goes with the process that holds it.

    Raises InputError if another process holds it, or the file cannot be made or is somebody else's.
    """

    def __init__(self, path: Path) -> None:
        self.path = path.with_name(f".{path.name}.sched-sim-lock")
        while True:
            try:
                self._descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o666)
            except OSError as error:
                raise InputError(
                    f"results file {path} cannot be written: {error.strerror}; give another {option('results')}"
                ) from None
            try:
                self._take(path)
            except BaseException:
                os.close(self._descriptor)
                raise
            if self._is_still_there():
                return
            os.close(self._descriptor)

    def release(self) -> None:
        self.path.unlink(missing_ok=True)
        os.close(self._descriptor)

    def _take(self, path: Path) -> None:
        try:
            fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(
                f"results file {path} is being written by another sweep: wait for it, or give "
                f"another {option('results')}"
            ) from None
        except OSError as error:
            raise InputError(
                f"results file {path} cannot be locked: {error.strerror}; give another {option('results')}"
            ) from None
        if os.fstat(self._descriptor).st_size:
            raise InputError(
                f"results file {path} cannot be locked: {self.path} holds something of yours; give "
                f"another {option('results')}"
            )

    def _is_still_there(self) -> bool:
        """Whether the file locked is the one of that name: its last holder may just have removed it."""
        try:
            return os.path.samestat(os.fstat(self._descriptor), self.path.stat())
        except FileNotFoundError:
            return False
