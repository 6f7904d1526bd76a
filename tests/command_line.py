"""What a command line of `sched-sim` leaves behind."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple


class Result(NamedTuple):
    code: int
    out: str
    err: str


Run = Callable[[str], Result]


def is_refused(result: Result, said: list[str]) -> None:
    """Exit code 2, and one message on standard error that says all of this."""
    assert result.code == 2
    assert result.out == ""
    assert "Traceback" not in result.err
    for words in said:
        assert words in result.err
