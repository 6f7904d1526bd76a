"""Where the emulator and its compiler are not installed, nothing is emulated."""

from __future__ import annotations

import pytest

from sched_sim.errors import InputError
from studies.measurement.emulation.toolchain import check_installed


def _missing() -> str:
    try:
        check_installed()
    except InputError as error:
        return str(error)
    return ""


MISSING = _missing()
needs_board = pytest.mark.skipif(bool(MISSING), reason=MISSING)
