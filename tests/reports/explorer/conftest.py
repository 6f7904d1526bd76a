"""The whole explorer, once for all tests that only ask it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.reports.explorer.explored import Explorer, exploring


@pytest.fixture(scope="session")
def explorer() -> Iterator[Explorer]:
    pytest.importorskip("uvicorn", reason="the extra explore is not installed")
    with exploring("--port", "0") as explorer:
        yield explorer
