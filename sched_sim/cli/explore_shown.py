"""What `sched-sim explore` says on the terminal, and the browser that it opens."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from threading import Thread
from typing import TYPE_CHECKING

from sched_sim.cli.output import say

if TYPE_CHECKING:
    from reports.explorer.answer import Asked


def open_browser(address: str) -> None:
    """In the background, as some browsers return only when they are closed."""
    import webbrowser

    try:
        webbrowser.get()
    except webbrowser.Error:
        say("There is no browser here: open the address in one")
        return
    Thread(target=webbrowser.open, args=[address], name="browser", daemon=True).start()


def has_screen(environment: Mapping[str, str] = os.environ) -> bool:
    """Whether a browser that is opened here is seen: not over SSH, nor in a terminal without a display."""
    if environment.get("BROWSER"):
        return True
    if sys.platform == "darwin":
        return "SSH_CONNECTION" not in environment
    return bool(environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"))


def no_screen_words(port: int, environment: Mapping[str, str] = os.environ) -> str:
    """What to do instead."""
    from reports.explorer.guard import forwarding

    if "SSH_CONNECTION" not in environment:
        return "There is no display, so no browser was opened"
    return (
        f"You are here over SSH: log in once more, from where your browser is, with `{forwarding(port)} ...`, and open "
        f"the address there"
    )


def ended_words(asked: Asked, address: str, seconds: float) -> str:
    """What was, and the address of what was looked at last."""
    counts = [f"{asked.answered} answered"]
    counts += [f"{asked.refused} refused"] if asked.refused else []
    counts += [f"{asked.failed} failed"] if asked.failed else []
    slowest = f", the slowest in {asked.slowest_s:.2g} s" if asked.answered else ""
    words = f"Ended after {_duration(seconds)}: {', '.join(counts)}{slowest}"
    return words if asked.last is None else f"{words}\nThe last design was {address}?{asked.last}"


def _duration(seconds: float) -> str:
    return f"{seconds / 60:.0f} min" if seconds >= 120 else f"{seconds:.0f} s"
