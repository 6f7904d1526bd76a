"""Whether live runs can be made here."""

from __future__ import annotations

import shutil

import pytest

from sched_sim.errors import InputError
from studies.live.rights import check_rights


def _missing() -> str:
    try:
        check_rights()
    except InputError as error:
        return str(error)
    return "" if shutil.which("cc") or shutil.which("gcc") else "there is no C compiler here"


MISSING = _missing()
needs_real_time = pytest.mark.skipif(bool(MISSING), reason=MISSING)
