"""The progress bar says how many there are only where that is known."""

from __future__ import annotations

import io
import re
import sys

import pytest

from sched_sim.cli.progress import progress_bar, simulations


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def on_terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    return terminal


def counts(terminal: Terminal) -> list[str]:
    return re.findall(r"\d+/[\d?]+", terminal.getvalue())


def test_a_search_that_ends_nobody_knows_when_has_no_total(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = on_terminal(monkeypatch)
    with simulations("larsen") as on_progress:
        for runs in range(1, 32):
            on_progress(runs)
    assert "31/?" in counts(terminal)
    assert not [count for count in counts(terminal) if "/?" not in count]


def test_a_total_that_is_known_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = on_terminal(monkeypatch)
    with progress_bar("Measuring") as show:
        show(3, 7, "larsen")
    assert counts(terminal)[-1] == "3/7"
