"""Where the explorer listens."""

from __future__ import annotations

import socket

import pytest

from reports.explorer import port as ports
from reports.explorer.port import HOST, listening
from sched_sim.errors import InputError


def number(there: socket.socket) -> int:
    return int(there.getsockname()[1])


def test_it_listens_on_this_machine_alone() -> None:
    with listening(0) as there:
        assert there.getsockname()[0] == HOST == "127.0.0.1"


def test_where_the_usual_port_is_in_use_it_takes_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    with listening(0) as taken:
        monkeypatch.setattr(ports, "USUAL", number(taken))
        with listening(None) as there:
            assert number(there) != number(taken)


def test_where_all_tried_are_in_use_it_takes_any(monkeypatch: pytest.MonkeyPatch) -> None:
    with listening(0) as taken:
        monkeypatch.setattr(ports, "USUAL", number(taken))
        monkeypatch.setattr(ports, "TRIED", 1)
        with listening(None) as there:
            assert number(there) != number(taken)


def test_a_port_that_was_asked_for_is_that_one_or_none() -> None:
    with listening(0) as taken:
        port = number(taken)
        with pytest.raises(InputError, match=f"--port {port}: something else listens there.*leave --port out"):
            listening(port)
    with listening(port) as again:
        assert number(again) == port
